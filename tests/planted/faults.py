#!/usr/bin/env python3
"""Plants one fault after the other into SystemC modules, driver, checks and board, and asks the test suite whether it notices. ./run faults builds and calls it."""
import argparse
import concurrent.futures
import datetime
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

import lists
import overlay
import suite

EXAMPLES = """examples:
  ./run faults                              # all four lists
  ./run faults driver --jobs 4
  ./run faults driver --only crc_polynomial --only crc_start
  ./run faults checks --record              # into docs/trust/faults.tsv, from which docs/trust.md is made
  ./run faults --list

A list is tests/planted/systemc.yaml, driver.yaml, checks.yaml or board.yaml. The table is tab-separated: list, fault, the test that found it, seconds of building and
testing; none_LIST is no fault, which no test may find (not with --only). A fault is built beside build/default, which is not written; its folder, build/faults/NAME, stays only when nothing found it. Exit codes: 0 all
were found, 1 one was not, 2 wrong input, or a fault whose text is no longer in its file.
"""
ROOT = lists.ROOT
BUILD = ROOT / "build" / "default"
PLACE = ROOT / "build" / "faults"
RECORD = ROOT / "docs" / "trust" / "faults.tsv"
HEAD = ["list", "fault", "found by", "seconds"]
NOBODY = "-"


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"faults: {message}\n")


def some_list(text):
    if text not in lists.NAMES:
        raise argparse.ArgumentTypeError(f"unknown list {text}, expected {', '.join(lists.NAMES)}")
    return text


def some_jobs(text):
    if not re.fullmatch(r"[0-9]{1,3}", text) or not 1 <= int(text) <= 512:
        raise argparse.ArgumentTypeError(f"{text} is no number of jobs, expected 1 to 512")
    return int(text)


def parse(words):
    parser = Parser(prog="./run faults", description="Plants faults into SystemC modules, driver, checks and board; the test suite has to find each.",
                    epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    parser.add_argument("lists", nargs="*", type=some_list, metavar="systemc|driver|checks|board", help="which lists; default all")
    parser.add_argument("--only", action="append", metavar="NAME", help="this fault; may be given several times")
    parser.add_argument("--jobs", type=some_jobs, default=os.cpu_count() or 1, metavar="N", help="faults at a time; default: as many as processors")
    parser.add_argument("--record", action="store_true", help="writes what was found into docs/trust/faults.tsv")
    parser.add_argument("--list", action="store_true", help="prints the faults and what they do")
    parser.add_argument("--check", action="store_true", help="only holds the lists against the sources")
    parser.add_argument("--targets", action="store_true", help=argparse.SUPPRESS)  # for ./run: what to build
    arguments = parser.parse_args(words)
    arguments.lists = arguments.lists or list(lists.NAMES)
    return arguments


def chosen(arguments):
    faults = [fault for name in arguments.lists for fault in lists.read(name)]
    if not arguments.only:
        return faults
    known = {fault.name for fault in faults}
    unknown = [name for name in arguments.only if name not in known]
    if unknown:
        raise lists.BadList(f"faults: unknown fault {unknown[0]}, expected those of ./run faults --list")
    return [fault for fault in faults if fault.name in arguments.only]


def targets(names):
    """The targets that a list's faults need."""
    stages = {stage for name in names for stage in suite.STAGES[name]}
    return sorted({stage.program for stage in stages} | {"dsdpv1-sim"} | ({"dsdpv1_rtl_libraries", "dsdpv1_firmware"} if stages else set()))


# -------------------------------------------------------------------------------------------------------------- looking
class Running:
    """The running tests, each with its children in a process group that an interrupted command ends."""

    def __init__(self):
        self.lock, self.groups, self.ended = threading.Lock(), set(), False

    def call(self, words, limit=suite.SECONDS, **options):
        """The test's exit code and output; None when it did not end in time."""
        with self.lock:
            if self.ended:
                raise KeyboardInterrupt
            child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                                     start_new_session=True, **options)
            self.groups.add(child.pid)
        try:
            printed = child.communicate(timeout=limit)[0]
            return child.returncode, printed
        except subprocess.TimeoutExpired:
            self.kill(child.pid)
            return None, child.communicate()[0]
        finally:
            with self.lock:
                self.groups.discard(child.pid)
            self.kill(child.pid)
            child.wait()

    @staticmethod
    def kill(group):
        try:
            os.killpg(group, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def end(self):
        with self.lock:
            self.ended = True
            for group in self.groups:
                self.kill(group)


def failed_test(printed):
    """The first case that failed, or that was running when the program ended."""
    for pattern in (r"^\[  FAILED  \] (\S+?),? ", r"^\[  FAILED  \] (\S+)"):
        found = re.search(pattern, printed, re.M)
        if found:
            return found.group(1).rstrip(",")
    begun = re.findall(r"^\[ RUN      \] (\S+)", printed, re.M)
    return begun[-1] if begun else "?"


class Hunt:
    """Searches for faults of some lists with the tests of one finished build."""

    def __init__(self, names):
        self.build = overlay.Build(BUILD, ROOT)
        self.cases = suite.read(BUILD)
        self.running = Running()
        for stage in {stage for name in names for stage in suite.STAGES[name]}:
            self.build.know(self.build.program(stage.program))
        self.build.know(suite.SIM)

    def look(self, fault):
        """The test that finds the fault, and the seconds until then."""
        folder = PLACE / fault.name
        shutil.rmtree(folder, ignore_errors=True)
        begin = time.monotonic()
        built = overlay.Overlay(self.build, fault, folder)
        found = next(filter(None, (self.stage(built, stage) for stage in suite.STAGES[fault.list])), NOBODY)
        if (found != NOBODY) != fault.name.startswith("none_"):
            shutil.rmtree(folder)
        return found, time.monotonic() - begin

    def stage(self, built, stage):
        """The test of this stage that fails; None when none does."""
        name = self.build.program(stage.program)
        sim = built.link(suite.SIM) if stage.calls_sim else None
        program = built.link(name) or (sim and BUILD / name)
        names = suite.names_of(self.cases, stage)
        if not program or not names:
            return None
        environment = {**os.environ, **({"DSDPV1_SIM": sim} if sim else {})}
        flags = built.folder / "flags"
        flags.write_text("--gtest_filter=" + ":".join(names) + "\n--gtest_fail_fast\n", encoding="utf-8")
        status, printed = self.running.call([program, f"--gtest_flagfile={flags}"], cwd=(BUILD / name).parent, env=environment)
        if status == 0:
            return None
        (built.folder / "log").write_text(printed, encoding="utf-8")
        return failed_test(printed) if status is not None else f"{stage.program}, time limit"


# ------------------------------------------------------------------------------------------------------------ recording
def read_record():
    if not RECORD.is_file():
        return {}
    rows = [line.split("\t") for line in RECORD.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    return {(row[1], row[2]): row for row in rows}


def record(outcomes):
    """The latest outcome of each listed fault, in the lists' order; a fault without a new search keeps its old outcome."""
    today = datetime.date.today().isoformat()
    rows = read_record()
    rows.update({(fault.list, fault.name): [today, fault.list, fault.name, found, f"{seconds:.0f}"] for fault, found, seconds in outcomes})
    order = [(name, fault.name) for name in lists.NAMES for fault in lists.read(name)]
    text = "# when, list, fault, the test that found it, seconds of building and testing\n"
    text += "".join("\t".join(rows[key]) + "\n" for key in order if key in rows)
    part = RECORD.with_suffix(".part")
    part.write_text(text, encoding="utf-8")
    part.replace(RECORD)


def controls(faults):
    """A control for each list: it changes nothing."""
    return [lists.control(fault) for fault in {fault.list: fault for fault in faults}.values()]


def hunt_all(faults, jobs, controlled):
    """The result of each fault; BadList when a test fails without one."""
    hunt = Hunt({fault.list for fault in faults})
    outcomes = []
    print("\t".join(HEAD), flush=True)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        waiting = {pool.submit(hunt.look, fault): fault for fault in [*(controls(faults) if controlled else []), *faults]}
        try:
            for done in concurrent.futures.as_completed(waiting):
                found, seconds = done.result()
                outcomes.append((waiting[done], found, seconds))
                print("\t".join([waiting[done].list, waiting[done].name, found, f"{seconds:.0f}"]), flush=True)
                if waiting[done].name.startswith("none_") and found != NOBODY:
                    raise lists.BadList(f"faults: {found} fails without a fault, its output is {(PLACE / waiting[done].name / 'log').relative_to(ROOT)}")
        except BaseException:
            hunt.running.end()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return [outcome for outcome in outcomes if not outcome[0].name.startswith("none_")]


def tell_survivors(outcomes):
    survivors = [fault for fault, found, _ in outcomes if found == NOBODY]
    for fault in survivors:
        print(f"faults: {fault.where}: no test finds {fault.name}: {fault.what}", file=sys.stderr)
    print(f"{len(outcomes) - len(survivors)} of {len(outcomes)} faults were found")
    return 1 if survivors else 0


def main(words):
    arguments = parse(words)
    if arguments.targets:
        print(" ".join(targets(arguments.lists)))
        return 0
    try:
        faults = chosen(arguments)
        if arguments.list:
            for fault in faults:
                print("\t".join([fault.list, fault.name, fault.what]))
        if arguments.list or arguments.check:
            return 0
        outcomes = hunt_all(faults, arguments.jobs, controlled=not arguments.only)
        if arguments.record:
            record(outcomes)
        return tell_survivors(outcomes)
    except (lists.BadList, overlay.Failed) as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
