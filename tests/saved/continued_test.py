#!/usr/bin/env python3
"""A run that is saved at any tick and restored in another process and folder equals the unbroken one from there on: log, wave, trace and capture
from that tick, the whole result. And saving does not change a run.

usage: continued_test.py DSDPV1_SIM [--firmware ELF] [--ticks N] [--seed N] [--record]

Without --ticks a few scenarios, in each engine and view of the model; with it all of them, at N random ticks
in total or a few more, so that each has the same number; --record makes that a row of docs/trust.md."""
import argparse
import filecmp
import os
import pathlib
import random
import re
import sys
import tempfile

import runs

sys.path.insert(0, str(runs.PROJECT / "docs" / "trust"))
import records  # noqa: E402

TICKS = {"ms": 12_000_000, "us": 12_000, "s": 12_000_000_000}
TICKS_PER_CYCLE = 250
# Scenario and options.
FEW = (("bus_timing", ("--set", "masters.0.slaves.0.outputs=random")), ("two_slaves", ("--checks", "off")), ("rsu_spi_limits", ("--engine", "step")),
       ("rsu_uart_1m8432", ()), ("rsu_uart_460k8", ("--view", "tlm")), ("violations", ()), ("spc3_services", ()), ("arm_board_12m", ()), ("arm_board_12m", ("--view", "tlm")))


def ticks_of(text):
    number, unit = re.fullmatch(r"([\d.]+)(\w+)", text).groups()
    return round(float(number) * TICKS[unit])


def end_of(scenario):
    text = (runs.PROJECT / "scenarios" / f"{scenario}.yaml").read_text(encoding="utf-8")
    return re.search(r"^end: *(\S+)", text, re.MULTILINE).group(1)


def has_board(scenario):
    return "kind: arm" in (runs.PROJECT / "scenarios" / f"{scenario}.yaml").read_text(encoding="utf-8")


def random_time(chance, end):
    """A tick and its notation: any tick of 1/12 ns, or an edge of a cycle."""
    tick = chance.randrange(end)
    if chance.random() < 0.5:
        cycle = tick // TICKS_PER_CYCLE
        return cycle * TICKS_PER_CYCLE, f"{cycle}cycles"
    return tick, runs.time_of(tick)


class Scenario:
    """The unbroken run, saved at some ticks, and one that is not saved."""

    def __init__(self, program, name, options, folder, times):
        self.program, self.name, self.folder, self.times = program, name, folder, times
        self.options = [f"scenarios/{name}.yaml", *options]
        self.failures = []
        self.saved = [folder / f"{number}.run" for number in range(len(times))]
        saves = [word for (_, text), file in zip(times, self.saved) for word in ("--save-at", text, file)]
        unsaved = self.run("plain", *self.options)
        if self.run("whole", *self.options, *saves).returncode != unsaved.returncode:
            self.fail("exits otherwise when it is saved")
        self.status = unsaved.returncode
        for ending in ("log", "txt", "pcapng"):
            if not self.same("plain", "whole", ending):
                self.fail(f"has another .{ending} when it is saved")

    def run(self, name, *arguments, folder=runs.PROJECT):
        outputs = [word for option, ending in (("--log", "log"), ("--result", "json"), ("--trace", "txt"), ("--capture", "pcapng"))
                   for word in (option, self.folder / f"{name}.{ending}")]
        return runs.call(self.program, *arguments, *outputs, folder=folder)

    def same(self, one, other, ending):
        return filecmp.cmp(self.folder / f"{one}.{ending}", self.folder / f"{other}.{ending}", shallow=False)

    def fail(self, what):
        self.failures.append(f"{' '.join(self.options)}: {what}")

    def trace_from(self, tick):
        """Lines "cycle+ticks ..."."""
        for line in (self.folder / "whole.txt").read_text(encoding="utf-8").splitlines():
            cycle, _, rest = line.split(maxsplit=1)[0].partition("+")
            if int(cycle) * TICKS_PER_CYCLE + int(rest or 0) >= tick:
                yield line

    def continue_from(self, number):
        tick, text = self.times[number]
        done = self.run("rest", "--restore", self.saved[number], folder=self.folder)
        if done.returncode != self.status:
            return self.fail(f"restored at {text} it exits with {done.returncode}, not {self.status}: {done.stderr}")
        if (self.folder / "rest.log").read_text(encoding="utf-8").splitlines() != runs.log_from(self.folder / "whole.log", tick):
            self.fail(f"restored at {text} it has another log")
        if runs.result(self.folder / "rest.json") != runs.result(self.folder / "whole.json"):
            self.fail(f"restored at {text} it has another result")
        if (self.folder / "rest.txt").read_text(encoding="utf-8").splitlines() != list(self.trace_from(tick)):
            self.fail(f"restored at {text} it has another trace")
        return self.waves_from(number)

    def waves_from(self, number):
        """Alone, so that no other observer needs each change."""
        text, wave, rest = self.times[number][1], self.folder / "wave.vcd", self.folder / "rest.vcd"
        runs.call(self.program, *self.options, "--wave", wave, "--wave-from", text)
        done = runs.call(self.program, "--restore", self.saved[number], "--wave", rest, folder=self.folder)
        if done.returncode != self.status or not filecmp.cmp(wave, rest, shallow=False):
            self.fail(f"restored at {text} it has another wave: {done.stderr}")


def check(program, name, options, count, seed):
    end = ticks_of(end_of(name))
    chance = random.Random(f"{seed} {name} {options}")
    with tempfile.TemporaryDirectory() as folder:
        scenario = Scenario(program, name, options, pathlib.Path(folder), [random_time(chance, end) for _ in range(count)])
        for number in range(count):
            scenario.continue_from(number)
    return scenario.failures


def campaign(program, names, ticks, seed):
    """Failures in all scenarios, with `ticks` ticks each."""
    failures = []
    for name in names:
        failures += check(program, name, (), ticks, seed)
        print(f"{name}: {len(failures)} failures so far", flush=True)
    return failures


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--firmware")
    parser.add_argument("--ticks", type=int)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--record", action="store_true")
    arguments = parser.parse_args()
    failures = []
    if arguments.ticks is None:
        for name, options in FEW:
            if arguments.firmware or not has_board(name):
                failures += check(arguments.program, name, options, 1, arguments.seed)
        return runs.report(failures)
    names = sorted(path.stem for path in (runs.PROJECT / "scenarios").glob("*.yaml"))
    names = [name for name in names if arguments.firmware or not has_board(name)]
    each = -(-arguments.ticks // len(names))
    failures = campaign(arguments.program, names, each, arguments.seed)
    if arguments.record:
        records.add("saved.tsv", arguments.seed, len(names), each * len(names), len(failures))
    return runs.report(failures)


if __name__ == "__main__":
    raise SystemExit(main())
