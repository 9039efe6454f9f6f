#!/usr/bin/env python3
"""accept of right firmware with many seeds: the example firmware at -O0, -O2 and -Os, the same device as a process of this computer, and the native CPU,
over each port. No run may have a violation.

    campaign.py SIM CC FIRMWARE_FOLDER [--seeds N] [--first SEED] [--only O2:spi,...] [--jobs N]

Prints a row for each kind and port, and how many runs have met what accept leaves to chance; after Ctrl-C, of the runs so far.
"""
import argparse
import collections
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

TREE = pathlib.Path(__file__).resolve().parents[3]
KINDS = ("O0", "O2", "Os", "process", "native")
PORTS = ("parallel", "spi", "uart")
# Over SPI the firmware asks for 244 outputs whatever their length, so that two tries last longer than the Min_Slave_Intervall of the GSD. Not optimised, it is
# too slow for a character each 6 us.
INTERVAL = ["masters.plc.bus.min_slave_interval=2500"]
SLOW = {("O0", "spi"): INTERVAL, ("O2", "spi"): INTERVAL, ("Os", "spi"): INTERVAL, ("O0", "uart"): ["chip.uart_rate=460.8k"]}
# The time in which they serve what comes: pauses between stimuli are most of a run.
WITHIN = {("O0", "uart"): "8ms", ("O0", "spi"): "3ms", ("O2", "spi"): "3ms", ("Os", "spi"): "3ms"}
VIOLATIONS = re.compile(r"^  violations +(\d+) that the scenario does not allow", re.M)


def build_process(cc, folder):
    device, rest, program = TREE / "tests/app/host_process", folder / "rest.o", folder / "device"
    subprocess.run([cc, "-x", "c++", "-fno-exceptions", "-O1", "-I", TREE, "-c", device / "rest.cpp", "-o", rest], check=True)
    sources = [*sorted((TREE / "driver").glob("dsdpv1*.c")), TREE / "driver/host/dsdpv1_bench.c", device / "device.c"]
    subprocess.run([cc, "-std=c99", "-g", "-O1", "-I", TREE, *sources, rest, "-o", program], check=True)
    return program


class Campaign:
    def __init__(self, arguments, process):
        self.arguments, self.process = arguments, process

    def command(self, kind, port, seed):
        settings = list(SLOW.get((kind, port), []))
        if kind == "process":
            settings.append(f"user_cpu.arguments=[{port}]")
            program = [self.process]
        else:
            program = ["--native"] if kind == "native" else [pathlib.Path(self.arguments.firmware) / f"device_{kind}.elf"]
        return [self.arguments.sim, "accept", *program, "--mode", port, "--seed", str(seed), "--within", WITHIN.get((kind, port), "2ms"), "--no-progress",
                *(word for each in settings for word in ("--set", each))]

    def run(self, job):
        began = time.monotonic()
        done = subprocess.run(self.command(*job), capture_output=True, text=True, check=False)
        return job, done, time.monotonic() - began


def chances(printed):
    """(what, count) of the rows of the table without a verdict of their own."""
    table = printed.split("\n\n")[0].splitlines()
    stimulus = ""
    for line in table:
        cells = re.split(r"  +", line.rstrip())
        if line.startswith("  ") and line[2:3].strip():
            stimulus = cells[1]
            cells = cells[2:]
        else:
            cells = cells[1:]
        if len(cells) >= 2 and cells[1].isdigit():
            yield f"{stimulus}: {cells[0]}", int(cells[1])


class Row:
    def __init__(self):
        self.runs = self.failed = self.violations = 0
        self.seconds = 0.0

    def add(self, done, seconds):
        self.runs += 1
        self.failed += done.returncode != 0
        self.seconds += seconds
        found = VIOLATIONS.search(done.stdout)
        self.violations += int(found[1]) if found else 0


def wanted(arguments):
    only = [tuple(name.split(":")) for name in arguments.only.split(",") if name]
    return [(kind, port) for kind in KINDS for port in PORTS if not only or (kind, port) in only or (kind,) in only]


def print_chances(met, pairs):
    print("\nmet in how many runs, of each kind and port:\n" + " " * 66 + " ".join(f"{kind}:{port[0]}" for kind, port in pairs))
    for what, counts in met.items():
        print(f"{what:<66}" + " ".join(f"{counts[pair]:>{len(pair[0]) + 2}}" for pair in pairs))


def note(results, rows, met):
    for (kind, port, seed), done, seconds in results:
        rows[kind, port].add(done, seconds)
        for what, count in chances(done.stdout):
            met[what][kind, port] += count != 0
        if done.returncode != 0:
            print(f"{kind} {port}, seed {seed}: exit {done.returncode}\n{done.stdout}{done.stderr}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sim")
    parser.add_argument("cc")
    parser.add_argument("firmware")
    parser.add_argument("--seeds", type=int, default=200)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    pairs = wanted(arguments)
    rows, met = {pair: Row() for pair in pairs}, collections.defaultdict(collections.Counter)
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        campaign = Campaign(arguments, build_process(arguments.cc, pathlib.Path(name)))
        jobs = [(*pair, seed) for seed in range(arguments.first, arguments.first + arguments.seeds) for pair in pairs]
        try:
            note(pool.map(campaign.run, jobs), rows, met)
        except KeyboardInterrupt:
            pool.shutdown(wait=False, cancel_futures=True)
    print("kind     port      runs  failed  violations  s a run")
    for (kind, port), row in rows.items():
        print(f"{kind:<8} {port:<8} {row.runs:>5} {row.failed:>7} {row.violations:>11} {row.seconds / max(row.runs, 1):>8.1f}")
    print_chances(met, pairs)
    runs, failed, violations = (sum(getattr(row, name) for row in rows.values()) for name in ("runs", "failed", "violations"))
    print(f"\n{runs} runs, {failed} failed, {violations} violations" + ("" if runs == len(jobs) else f"; interrupted, {len(jobs) - runs} runs are missing"))
    return 0 if failed == 0 and runs == len(jobs) else 1


if __name__ == "__main__":
    sys.exit(main())
