#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""The netlists of the reference RTL against the model: each top, synthesised to Yosys's generic cells and to those of the iCE40.

    gates.py [RUN...] [--chip CHIP] [--cells CELLS] [--only KIND] [--sim PROGRAM] [--out FOLDER] [--jobs N] [-u] [--check] [--list]

KIND is scenario (cosim, in lockstep), random (rtl-random; a second netlist, with short windows) or icarus (golden traces in four states, RTL as well).
Each kind has twins with one inverted cell, or one fault of faults.txt, which must differ. Results stay in FOLDER, by default build/rtl-gates; only
what a change concerns is run again. -u writes the table of docs/rtl.md, --check compares its rows and cells, with --list its rows alone. Exit codes: 0 all as it must be, 1 something is
not, 2 wrong use or a missing tool. RUN is a run as --list names it, or a part of its name.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
import time

import figures

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "gates"))
import golden  # noqa: E402
import netlists  # noqa: E402
import page  # noqa: E402
from netlists import Failed  # noqa: E402

RTL = pathlib.Path(__file__).resolve().parent
ROOT = RTL.parent
KINDS = ("scenario", "random", "icarus")
RTL_CELLS = "rtl"  # no netlist: Icarus alone
ALL_CELLS = (RTL_CELLS, *netlists.CELLS)
BENCH = RTL / "gates" / "golden_bench.sv"

# The scenarios, and the modes of random cases; what each twin must differ in comes first
SCENARIOS = {"dsdpv1": ("bus_timing", "violations"), "dsdpv1_rsu": ("rsu_spi_timing", "rsu_uart_timing")}
RANDOM = {"dsdpv1": ("parallel",), "dsdpv1_rsu": ("spi", "uart", "parallel")}
RANDOM_CYCLES = {"generic": 1_000_000, "ice40": 100_000}  # at least, of each mode: the iCE40's are ten times slower
# Golden, slave, cycles. RTL: 82 000 cycles are data exchange, 300 000 over SPI as well. Netlists are ten to thirty times slower.
GOLDENS = {
    ("dsdpv1", RTL_CELLS): (("power_on_12m", "demo", 84_000), ("violations", "early", 960_000), ("violations", "short_writes", 960_000)),
    ("dsdpv1_rsu", RTL_CELLS): (("rsu_spi_timing", "demo", 310_000),),
    ("dsdpv1", "netlist"): (("power_on_12m", "demo", 84_000),),
    ("dsdpv1_rsu", "netlist"): (("rsu_spi_timing", "demo", 14_000),),
}
# How Verilator's files are compiled: those of the start, and a twin, which soon differs, take longer to optimise than to run
COMPILED = {True: "OPT_FAST=-O0 OPT_SLOW=-O0", False: "OPT_FAST=-O1 OPT_SLOW=-O0"}
# In the test suite
QUICK = {"dsdpv1": (("violations", "short_writes", 24_000),), "dsdpv1_rsu": (("rsu_spi_timing", "demo", 14_000),)}
FAULT = {"dsdpv1": 48, "dsdpv1_rsu": 129}  # of faults.txt, seen in the first cycles


class Refused(Exception):
    """Wrong use, or something that this needs is missing."""


def call(command, log, folder=RTL, **variables):
    """Its exit code, and seconds of processor time; all that it says is in the log. Its environment has these variables, too."""
    how = {"cwd": folder, "stderr": subprocess.STDOUT, "env": {**os.environ, **variables}}
    with open(log, "w", encoding="utf-8") as out, subprocess.Popen([str(word) for word in command], stdout=out, **how) as done:
        _, status, used = os.wait4(done.pid, 0)
        done.returncode = os.waitstatus_to_exitcode(status)
    return done.returncode, used.ru_utime + used.ru_stime


def last_lines(log, count=6):
    return "\n".join(pathlib.Path(log).read_text(encoding="utf-8", errors="replace").splitlines()[-count:])


class Step:
    """Something that is run, and kept until one of its inputs changes."""

    def __init__(self, chip, cells, name, run, inputs, needs=()):
        self.chip, self.cells, self.name, self.run, self.inputs, self.needs = chip, cells, name, run, inputs, needs
        self.kept = False
        self.result = self.parameters = None

    def __str__(self):
        return f"{self.chip} {self.cells} {self.name}"

    def folder(self, out):
        return out / self.chip / self.cells / self.name.replace(" ", "_")

    def do(self, out):
        """Its result, from the last time if nothing has changed."""
        folder = self.folder(out)
        record = folder / "result.json"
        key = checksum([self.name, *self.inputs(), *(need.result["netlist"] for need in self.needs)])
        if record.exists():
            self.result = json.loads(record.read_text(encoding="utf-8"))
            self.kept = self.result["key"] == key
        if not self.kept:
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            self.result = {**self.run(folder), "key": key}
            record.write_text(json.dumps(self.result, indent=1) + "\n", encoding="utf-8")
        return self.result


def checksum(parts):
    sums = hashlib.sha256()
    for part in parts:
        sums.update(part.read_bytes() if isinstance(part, pathlib.Path) else str(part).encode())
        sums.update(b"\0")
    return sums.hexdigest()[:16]


class Plan:
    """The steps of a call."""

    def __init__(self, out, sim, chips, cells, kinds):
        self.out, self.sim, self.kinds, self.steps = out, sim, kinds, []
        for chip in chips:
            for each in cells:
                if each != RTL_CELLS:
                    self.of_netlist(chip, each)
                elif "icarus" in kinds:
                    self.icarus(chip, RTL_CELLS, GOLDENS[chip, RTL_CELLS], None)
                    self.rtl_twins(chip, GOLDENS[chip, RTL_CELLS][0])

    def choose(self, names):
        """Only runs with one of these in their names, and what they need."""
        unknown = [name for name in names if not any(name in str(step) for step in self.steps)]
        if unknown:
            raise Refused(f"no run {unknown[0]}, see --list")
        chosen = [step for step in self.steps if not names or any(name in str(step) for name in names)]
        needed = [need for step in chosen for need in step.needs]
        self.steps = [step for step in self.steps if step in chosen or step in needed]

    def add(self, *words, **more):
        self.steps.append(Step(*words, **more))
        return self.steps[-1]

    def of_netlist(self, chip, cells):
        if "scenario" in self.kinds or "icarus" in self.kinds:
            whole = self.netlist(chip, cells, "netlist", {})
            goldens = GOLDENS[chip, "netlist"]
            if "scenario" in self.kinds:
                for name in SCENARIOS[chip]:
                    self.scenario(chip, cells, name, whole)
                self.scenario(chip, cells, SCENARIOS[chip][0], whole, twin=True)
            if "icarus" in self.kinds:
                self.icarus(chip, cells, goldens, whole)
                self.icarus(chip, cells, goldens[:1], whole, twin=True)
        if "random" in self.kinds:
            short = self.netlist(chip, cells, "short", netlists.short_windows(chip))
            for mode in RANDOM[chip]:
                self.random(chip, cells, mode, short)
            self.random(chip, cells, RANDOM[chip][0], short, twin=True)

    def netlist(self, chip, cells, name, parameters):
        def run(folder):
            count, seconds = netlists.synthesize(chip, cells, parameters, folder, call)
            return {"cells": count, "netlist": checksum([folder / "netlist.v"]), "seconds": seconds, "says": f"{count} cells"}

        step = self.add(chip, cells, name, run, lambda: [figures.checksum(chip), TOOLS.versions("yosys"), netlists.script(chip, cells, parameters)])
        step.parameters = parameters
        return step

    def rtl_folder(self, netlist, folder, twin):
        """The folder that --rtl gets: the netlist, or its twin, cells and top. The same for all runs, so that it is built once."""
        made = folder.parent / f"rtl_{netlist.name}{'_twin' * twin}"
        files = netlists.own_rtl(netlist.chip, netlist.cells, netlist.parameters, netlist.folder(self.out), twin)
        made.mkdir(exist_ok=True)
        for name, text in files.items():
            if not (made / name).exists() or (made / name).read_text(encoding="utf-8") != text:
                (made / name).write_text(text, encoding="utf-8")
        return made

    def own_rtl(self, netlist, folder, twin):
        made = self.rtl_folder(netlist, folder, twin)
        return ["--rtl", made, "--top", "gates", "--pins", made / "map.yaml"]

    def lockstep(self, command, folder, twin):
        """Plays it, and gives its result: the model's verdict is the exit code."""
        said = folder / "said.txt"
        status, seconds = call([self.sim, *command, "--result", folder / "lockstep.json"], said, folder, MAKEFLAGS=COMPILED[twin])
        if status not in (0, 1):
            raise Failed(f"{command[0]} ended with exit code {status}: {last_lines(said)}")
        result = json.loads((folder / "lockstep.json").read_text(encoding="utf-8"))
        lockstep = result.get("lockstep", result)
        differs = lockstep["difference"] is not None
        if differs != twin or (status != 0) != twin:
            raise Failed("the twin is not found" if twin and not differs else last_lines(said, 12))
        cycles = lockstep["cycles"]
        return {"cycles": cycles, "seconds": seconds, "says": f"differs at cycle {cycles}, as it must" if twin else f"{cycles} cycles equal"}

    def scenario(self, chip, cells, name, netlist, twin=False):
        def run(folder):
            build = folder.parent / ("build_twin" if twin else "build_netlist")
            return self.lockstep(["cosim", *self.own_rtl(netlist, folder, twin), "--build", build, ROOT / f"scenarios/{name}.yaml"], folder, twin)

        self.add(chip, cells, f"scenario {name}" + " twin" * twin, run, lambda: [ROOT / f"scenarios/{name}.yaml", *self.model()], needs=[netlist])

    def random(self, chip, cells, mode, netlist, twin=False):
        cycles = RANDOM_CYCLES[cells]

        def run(folder):
            build = folder.parent / ("build_short_twin" if twin else "build_short")
            how = ["--chip", chip, "--mode", mode] if chip != "dsdpv1" else []
            return self.lockstep(["rtl-random", *self.own_rtl(netlist, folder, twin), "--build", build, *how, "--cycles", cycles, "--seed", 1, "--jobs", 1], folder, twin)

        self.add(chip, cells, f"random {mode}" + " twin" * twin, run, lambda: [cycles, *self.model()], needs=[netlist])

    def model(self):
        return [self.sim, TOOLS.versions("verilator"), *netlists.SOURCES]

    def icarus(self, chip, cells, goldens, netlist, twin=False):
        for name, slave, cycles in goldens:
            def run(folder, name=name, slave=slave, cycles=cycles):
                sources = self.rtl_sources(chip) if netlist is None else self.netlist_sources(netlist, folder, twin)
                return four_states(chip, sources, (name, slave, cycles), folder, twin)

            def inputs(name=name, cycles=cycles):
                return self.bench(chip, name, cycles) + [*netlists.SOURCES] * bool(netlist)

            self.add(chip, cells, f"icarus {name} {slave}" + " twin" * twin, run, inputs, needs=[netlist] if netlist else [])

    def rtl_twins(self, chip, what):
        """One with a fault, and one that RESET never reaches, whose outputs are X."""
        def faulty(folder):
            sources = ["-DSINGLE_FAULTS", f"-Pgolden_bench.FAULT={FAULT[chip]}", *self.rtl_sources(chip)]
            return four_states(chip, sources, what, folder, twin=True)

        def unknown(folder):
            return four_states(chip, self.rtl_sources(chip), what, folder, twin=True, reset=False)

        name, slave, cycles = what
        self.add(chip, RTL_CELLS, f"icarus {name} {slave} twin", faulty, lambda: [FAULT[chip], *self.bench(chip, name, cycles)])
        self.add(chip, RTL_CELLS, f"icarus {name} {slave} no RESET twin", unknown, lambda: self.bench(chip, name, cycles))

    def bench(self, chip, name, cycles):
        return [figures.checksum(chip), TOOLS.versions("iverilog"), cycles, BENCH, RTL / "gates" / "golden.py", ROOT / f"traces/{name}.trace.xz"]

    @staticmethod
    def rtl_sources(chip):
        return ["-I.", "-I../registers", f"-DTOP={chip}", *(RTL / chip / "files.txt").read_text(encoding="utf-8").split()]

    def netlist_sources(self, netlist, folder, twin):
        made = self.rtl_folder(netlist, folder, twin)
        return ["-DTOP=netlist", f"-D{netlists.CELLS_MACRO}", *sorted(made.glob("*.v"))]


def four_states(chip, sources, what, folder, twin, reset=True):
    """A golden in Icarus: equal, or, for a twin, not, and without reset for an X."""
    name, slave, cycles = what
    trace = golden.Golden(name)
    netlists.check_parameters(chip, trace.manifest["parameters"])
    trace.write(slave, cycles, folder / "golden.txt", reset)
    macros = ["-DRSU", f"-Pgolden_bench.MISO_DELAY={trace.manifest['parameters']['spi_miso_delay']}"] if chip == "dsdpv1_rsu" else []
    status, _ = call(["iverilog", "-g2012", *macros, "-s", "golden_bench", "-o", folder / "bench.vvp", BENCH, *sources], folder / "iverilog.log")
    if status != 0:
        raise Failed(f"iverilog: {last_lines(folder / 'iverilog.log')}")
    _, seconds = call(["vvp", "-n", folder / "bench.vvp", f"+golden={folder / 'golden.txt'}"], folder / "said.txt")
    (folder / "golden.txt").unlink()
    said = (folder / "said.txt").read_text(encoding="utf-8")
    equal = re.search(r"^equal: (\d+) cycles, (\d+) ticks", said, re.M)
    differs = re.search(r"^differs at tick (\d+): golden \S+, here \S*" + "x" * (not reset), said, re.M)
    if twin and differs:
        cycles = int(differs[1]) // golden.TICKS
        return {"cycles": cycles, "seconds": seconds, "says": f"differs at cycle {cycles}, as it must"}
    if twin or not equal or int(equal[2]) < 100:
        raise Failed("the twin is not found" if twin and equal else said or "vvp says nothing")
    return {"cycles": int(equal[1]), "seconds": seconds, "says": f"{int(equal[1])} cycles equal, {equal[2]} ticks compared"}


class Tools:
    """The tools, and their versions."""

    OPTION = {"yosys": "-V", "verilator": "--version", "iverilog": "-V"}

    def __init__(self):
        self.known = {}

    def versions(self, name):
        if name not in self.known:
            if not shutil.which(name):
                raise Refused(f"{name} is missing (packages.txt names the Debian packages; ./run rtl-gates installs them)")
            self.known[name] = subprocess.run([name, self.OPTION[name]], capture_output=True, text=True, check=False).stdout.split("\n", 1)[0]
        return self.known[name]


TOOLS = Tools()


class Report:
    """A line for each step, and on a terminal what is under way."""

    def __init__(self, total):
        self.total, self.done, self.bad, self.under_way, self.lock = total, 0, 0, [], threading.Lock()

    def begins(self, step):
        with self.lock:
            self.under_way.append(step)
            self.progress()

    def ends(self, step, failure=None):
        with self.lock:
            self.under_way.remove(step)
            self.done += 1
            self.clear()
            label = f"{step.chip:10}  {step.cells:7}  {step.name:36}"
            if failure:
                self.bad += 1
                print(f"{label}  FAILED: {failure}", flush=True)
            else:
                kept = "  (kept)" if step.kept else ""
                print(f"{label}  {step.result['seconds']:6.0f} s  {step.result['says']}{kept}", flush=True)
            self.progress()

    def progress(self):
        if sys.stderr.isatty() and self.under_way:
            names = ", ".join(map(str, self.under_way))
            sys.stderr.write(f"\r\033[K{f'{self.done} of {self.total} done, now {names}'[:shutil.get_terminal_size().columns - 1]}")
            sys.stderr.flush()

    @staticmethod
    def clear():
        if sys.stderr.isatty():
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()


def run_all(plan, jobs):
    """Each step after those that it needs; how many were not as they must be. Folders of builds are shared, so a netlist's steps are one after another."""
    report = Report(len(plan.steps))
    groups = {}
    for step in plan.steps:
        groups.setdefault((step.chip, step.cells), []).append(step)

    stopped = threading.Event()  # by Ctrl-C, or a defect of this script

    def run_group(steps):
        for step in steps:
            if stopped.is_set():
                return
            report.begins(step)
            try:
                missing = [need.name for need in step.needs if need.result is None]
                if missing:
                    raise Failed(f"there is no {missing[0]}")
                step.do(plan.out)
                report.ends(step)
            except Failed as failure:
                step.result = None
                report.ends(step, failure)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        try:
            for done in [pool.submit(run_group, steps) for steps in groups.values()]:
                done.result()
        except BaseException:
            stopped.set()
            raise
    return report.bad


class Options(argparse.ArgumentParser):
    """Wrong ones are one line."""

    def error(self, message):
        raise Refused(message)


def options():
    parser = Options(prog="./run rtl-gates", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", nargs="*", help="by default each")
    parser.add_argument("--chip", action="append", choices=figures.CHIPS, help="by default each")
    parser.add_argument("--cells", action="append", choices=ALL_CELLS, help="by default each; rtl: no netlist, Icarus alone")
    parser.add_argument("--only", action="append", choices=KINDS, help="by default each")
    parser.add_argument("--quick", action="store_true", help="what the test suite runs: the RTL in four states, some seconds; nothing is kept")
    parser.add_argument("--sim", type=pathlib.Path, default=ROOT / "build/default/apps/dsdpv1-sim", help="dsdpv1-sim")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/rtl-gates", help="the folder of results")
    parser.add_argument("--jobs", type=int, default=2, help="how many netlists at the same time (2)")
    parser.add_argument("--list", action="store_true", help="the steps, without running them")
    parser.add_argument("-u", "--update", action="store_true", help="write the tables of docs/rtl.md")
    parser.add_argument("--check", action="store_true", help="compare rows and cells of docs/rtl.md; with --list nothing is run")
    given = parser.parse_args()
    if given.jobs < 1:
        parser.error("--jobs: expected 1 or more")
    if (given.update or given.check) and (given.run or given.chip or given.cells or given.only or given.quick):
        parser.error("-u and --check are for all of it, without RUN, --chip, --cells, --only and --quick")
    return given


def main():
    given = options()
    if not given.quick:
        return run_plan(given)
    GOLDENS.update({(chip, RTL_CELLS): QUICK[chip] for chip in figures.CHIPS})
    given.cells, given.only = [RTL_CELLS], ["icarus"]
    with tempfile.TemporaryDirectory(prefix="dsdpv1_gates_") as folder:
        given.out = pathlib.Path(folder)
        return run_plan(given)


def run_plan(given):
    plan = Plan(given.out.resolve(), given.sim.resolve(), given.chip or figures.CHIPS, given.cells or ALL_CELLS, given.only or KINDS)
    plan.choose(given.run)
    if given.list and given.check:
        return page.report([page.missing(plan.steps, chip) for chip in figures.CHIPS])
    if given.list:
        print("\n".join(map(str, plan.steps)))
        return 0
    if any(step.name.startswith(("scenario", "random")) for step in plan.steps) and not plan.sim.exists():
        raise Refused(f"{plan.sim} is missing: ./run build, or --sim")
    begin = time.monotonic()
    bad = run_all(plan, given.jobs)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{len(plan.steps) - bad} of {len(plan.steps)} as they must be, {time.monotonic() - begin:.0f} s, {used.ru_utime + used.ru_stime:.0f} s of processor time")
    if bad:
        return 1
    if given.update:
        for chip in figures.CHIPS:
            figures.rewrite(f"{page.counts(plan.steps, chip)}\n\n{page.table(plan.steps, chip)}", page.TOOL, chip)
    return page.report([page.missing(plan.steps, chip, measured=True) for chip in figures.CHIPS]) if given.check else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Refused as error:
        print(f"rtl-gates: {error}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
