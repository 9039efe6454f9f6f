#!/usr/bin/env python3
"""Runs each mutant of the model against the tests that its rows of docs/conformance.md name, and tells which rows do not find it. ./run mutants calls it."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import threading
import time

import faults
import lists
import mutation
import switches
from known_tests import KnownTests

EXAMPLES = """examples:
  ./run mutants                             # all; six minutes with two processors and other work on them, after the build
  ./run mutants --only syn_32 --only le_min
  ./run mutants --row S3 --row T15-Tw       # the mutants of these rows
  ./run mutants --json > mutants.json
  ./run mutants --list                      # their rows and what they alter
  ./run mutants --chip spc3                 # those of the SPC3 family, two minutes
  ./run mutants --record                    # into docs/trust/mutants.tsv, from which docs/conformance.md is made

The mutants are tests/planted/mutants.yaml. All are in one build, build/mutants, each behind a switch. A line of the tab-separated table is a mutant and
one of its rows: killed and the first test that found it, or survived. Only a failed EXPECT or ASSERT in the source of a test that the row names counts. What does
not: a crash, a time limit, an exception, a failure of the bench, a difference between the executions of the chip (twin_chip.cpp). These are named behind the result.

Exit codes: 0 each row finds its mutants, 1 one does not, 2 wrong input, a mutant whose text is no longer in its file, or a test that fails without a mutant.
"""
ROOT = lists.ROOT
TREE = ROOT / "build" / "mutants"
BUILD = TREE / "build" / "edit"
RECORD = ROOT / mutation.RECORD
PROGRAMS = {program: "tests/core" if program == "core_blocks" else "tests/conformance" for program in mutation.PROGRAMS}
COMPARING = ("RsuRandom", "Scripts", "Torture", "TwinCampaign", "UserTorture")  # suites that only compare executions of the chip
HEAD = ["mutant", "row", "result", "test", "not counted"]
SECONDS = 20   # of a program, besides ten times as long as without a mutant
LIMITS = 3     # of a row: when so many of its tests have reached it, the others would, too
STEPS = (0.02, 0.2)  # seconds: tests that take less run first
OF_A_TEST = "_test.cpp"  # where its assertions stand; those of the bench only say that it cannot go on


# -------------------------------------------------------------------------------------------------------------- tests
def matches(case, name):
    """A case as GoogleTest names it, and the suite or the test that a row names."""
    suite, test = case.split(".", 1)
    suite = [part for part in suite.split("/") if not part.isdigit()][-1]
    return name in (suite, f"{suite}.{test.split('/', 1)[0]}")


def cases_of(program):
    """The cases that a program has."""
    listed = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
    suite = ""
    for line in listed.splitlines():
        name = line.split("#", 1)[0].rstrip()
        if name.endswith(".") and not name.startswith(" "):
            suite = name
        elif name.startswith("  ") and suite:
            if not any(matches(suite + name.strip(), each) for each in COMPARING):
                yield suite + name.strip()


class Outcome:
    """What cases did: those that failed by an assertion, other ends with their kind, and those that passed, with their seconds."""

    def __init__(self):
        self.failed, self.others, self.passed = [], {}, {}
        self.places = {}  # of the first assertion of a case that has failed

    def read(self, printed):
        """Returns the case that had not ended, if any. After a failure GoogleTest skips the others (--gtest_fail_fast)."""
        running, kinds, failed = None, set(), False
        for line in printed.splitlines():
            begun = re.match(r"\[ RUN      \] (\S+)", line)
            place = re.match(r"(\S+): Failure$", line)
            ended = re.match(r"\[ +(OK|FAILED|SKIPPED) +\] (\S+?)(?:,| \()", line)
            if begun:
                running, kinds = begun.group(1), set()
            elif place:
                kinds.add(kind_of(place.group(1)))
                if kind_of(place.group(1)) == "assertion":
                    self.places.setdefault(running, place.group(1))
            elif "unknown file: Failure" in line:
                kinds.add("exception")
            elif ended and ended.group(2) == running:
                if not (failed and ended.group(1) == "SKIPPED"):
                    self.take(running, ended.group(1), kinds, float(re.search(r"\((\d+) ms\)", line).group(1)) / 1000)
                running, failed = None, failed or ended.group(1) == "FAILED"
        return running

    def take(self, case, end, kinds, seconds):
        if end != "FAILED":
            self.passed[case] = seconds
        elif "assertion" in kinds:
            self.failed.append(case)
        else:
            self.others[case] = ", ".join(sorted(kinds)) or "failed"

    def ended(self):
        return {*self.failed, *self.others, *self.passed}


def kind_of(place):
    return "assertion" if OF_A_TEST in place else "twins differ" if "twin" in place else "in the bench"


class Runner:
    """The programs of a build with mutants: {program: its folder}."""

    def __init__(self, build=BUILD, programs=None):
        self.running = faults.Running()
        self.build, self.programs = build, PROGRAMS if programs is None else programs
        self.cases = {program: list(cases_of(build / folder / program)) for program, folder in self.programs.items()}
        self.seconds = {}  # of a case, without a mutant

    def named(self, tests):
        """(program, case) that these names mean: the shortest of each program, then those that take longer."""
        found = [(program, case) for program, cases in self.cases.items() for case in cases if any(matches(case, test.name) for test in tests)]
        return sorted(found, key=lambda pair: self.order(pair[1]))

    def order(self, case):
        return sum(self.seconds.get(case, 0) > step for step in STEPS)

    def run(self, number, tests, outcome, fast=True):
        """Adds what these tests do with a mutant, until one has found it; number 0 is none."""
        left = [pair for pair in self.named(tests) if pair[1] not in outcome.ended()]
        while left and not (fast and outcome.failed and outcome.failed[-1] in [case for _, case in self.named(tests)]):
            program, first = left[0]
            group = [case for of, case in left if of == program and self.order(case) == self.order(first)]
            self.run_program(number, program, group, outcome, fast)
            if sum(outcome.others.get(case) == "time limit" for _, case in self.named(tests)) >= LIMITS:
                return
            left = [pair for pair in left if pair[1] not in outcome.ended()]

    def run_program(self, number, program, cases, outcome, fast):
        flags = self.build / f"flags_{os.getpid()}_{threading.get_ident()}"
        flags.write_text("--gtest_filter=" + ":".join(cases) + ("\n--gtest_fail_fast" if fast else "") + "\n", encoding="utf-8")
        try:
            limit = SECONDS + 10 * sum(self.seconds.get(case, 100) for case in cases)
            status, printed = self.running.call([self.build / self.programs[program] / program, f"--gtest_flagfile={flags}"], limit=limit, cwd=self.build,
                                                env={**os.environ, "DSDPV1_MUTANT": str(number)})
        finally:
            flags.unlink()
        ended = outcome.read(printed) or (cases[0] if not outcome.ended() & set(cases) else None)
        if ended:
            outcome.others[ended] = "time limit" if status is None else "crash"

    def check_without(self, tests):
        """All tests that will be run, without a mutant, and how long they take."""
        outcome = Outcome()
        self.run(0, tests, outcome, fast=False)
        bad = [*outcome.failed, *outcome.others]
        if bad:
            raise lists.BadList(f"mutants: {bad[0]} fails without a mutant")
        self.seconds = outcome.passed


# ------------------------------------------------------------------------------------------------------------ building
def step(words, **options):
    done = subprocess.run(words, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise lists.BadList("mutants: " + next((line for line in (done.stdout + done.stderr).splitlines() if "error" in line.lower()), f"{words[0]} failed"))


def build(mutants, jobs, tree=TREE, programs=tuple(PROGRAMS)):
    """One build with all of them."""
    switches.write_tree(ROOT, mutants, tree)
    print(f"mutants: building them, once, into {tree.relative_to(ROOT)}", file=sys.stderr)
    flags = f"-w -include {tree / switches.HEADER}"
    step(["cmake", "--preset", "edit", "-DDSDPV1_REFERENCE_RTL=OFF", "-DDSDPV1_TEST_PROGRAMS=OFF", "-DDSDPV1_WERROR=OFF", f"-DCMAKE_CXX_FLAGS={flags}"], cwd=tree)
    step(["ninja", "-C", tree / "build" / "edit", f"-j{jobs}", *programs])


# -------------------------------------------------------------------------------------------------------------- judging
def look(number, mutant, rows, runner):
    """A line for each row of a mutant."""
    outcome, lines = Outcome(), []
    for name in mutant.row_names:
        tests = rows[name].tests
        own = {case for _, case in runner.named(tests)}
        if not own & set(outcome.failed):
            runner.run(number, tests, outcome)
        killer = next((case for case in outcome.failed if case in own), None)
        others = [f"{case}: {kind}" for case, kind in outcome.others.items() if case in own]
        lines.append([mutant.name, name, "killed" if killer else "survived", killer or "-", "; ".join([*others[:2], *(["..."] if others[2:] else [])]) or "-"])
    return lines


def run_all(numbered, rows, arguments):
    runner, lines, begin = Runner(), [], time.monotonic()
    print("mutants: the tests without a mutant", file=sys.stderr)
    runner.check_without([test for _, mutant in numbered for name in mutant.row_names for test in rows[name].tests])
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        waiting = [pool.submit(look, number, mutant, rows, runner) for number, mutant in numbered]
        try:
            for count, done in enumerate(concurrent.futures.as_completed(waiting), 1):
                lines += done.result()
                if not arguments.json:
                    print("\n".join("\t".join(line) for line in done.result()), flush=True)
                progress(count, len(numbered), lines, begin)
        except BaseException:
            runner.running.end()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return lines


def progress(count, total, lines, begin):
    if sys.stderr.isatty() or count % 20 == 0 or count == total:
        alive = sum(line[2] == "survived" for line in lines)
        print(f"mutants: {count} of {total}, {alive} rows do not find theirs, {time.monotonic() - begin:.0f} s", file=sys.stderr)


# ------------------------------------------------------------------------------------------------------------ recording
def record(mutants, lines):
    """Of each mutant the rows that found it, and those that did not; one without a new run keeps its old line."""
    found = {name: [name, ", ".join(good) or "-", ", ".join(alive) or "-"] for name, (good, alive) in mutation.recorded(ROOT).items()}
    for name in dict.fromkeys(line[0] for line in lines):
        kept = {result: ", ".join(line[1] for line in lines if line[0] == name and line[2] == result) for result in ("killed", "survived")}
        found[name] = [name, kept["killed"] or "-", kept["survived"] or "-"]
    text = "# The mutants of tests/planted: rows of docs/conformance.md whose tests find them, and rows whose tests do not.\n# ./run mutants --record writes it.\n"
    mutation.recorded.cache_clear()
    RECORD.write_text(text + "".join("\t".join(found[mutant.name]) + "\n" for mutant in mutants if mutant.name in found), encoding="utf-8")


def wrong(mutants):
    """A line for each fault of the lists and the record. That the texts are in their files is known when they have been read."""
    found = mutation.recorded(ROOT)
    for mutant in mutants if found else ():
        if sorted(row for rows in found.get(mutant.name, ()) for row in rows) != sorted(mutant.row_names):
            yield f"{mutant.where}: {mutant.name} is not in {mutation.RECORD} with these rows; ./run mutants --only {mutant.name} --record"
    for name in set(found) - {mutant.name for mutant in mutants}:
        yield f"{mutation.RECORD}:1: there is no mutant {name}"
    data, has = lists.data.load(ROOT), {row for mutant in mutants for row in mutant.row_names}
    explained = {row for rows in mutation.reasons(ROOT, data, KnownTests(ROOT), has).values() for row in rows}
    for row in mutation.owners(data):
        if row not in explained and row not in has:
            yield f"{mutation.REASONS}:1: row {row} has no mutant; alter what it says in tests/planted/mutants.yaml, or name it here with the reason"


# -------------------------------------------------------------------------------------------------------------- command
def parse(words):
    parser = faults.Parser(prog="./run mutants", description="Runs each mutant of the model against the tests that its rows of docs/conformance.md name.",
                           epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    parser.add_argument("--chip", choices=("dsdpv1", "spc3"), default="dsdpv1", help="whose mutants; spc3: each with the test that it names, and a page, "
                        "docs/spc3_mutants.md; default: dsdpv1")
    parser.add_argument("--only", action="append", metavar="NAME", help="this mutant; may be given several times")
    parser.add_argument("--row", action="append", metavar="ROW", help="the mutants of this row; may be given several times")
    parser.add_argument("--jobs", type=faults.some_jobs, default=os.cpu_count() or 1, metavar="N", help="mutants at a time; default: as many as processors")
    parser.add_argument("--json", action="store_true", help="prints one list of JSON at the end, not the table")
    parser.add_argument("--record", action="store_true", help="writes the results into docs/trust/mutants.tsv")
    parser.add_argument("--list", action="store_true", help="prints the mutants, their rows and what they alter")
    parser.add_argument("--check", action="store_true", help="only holds lists, sources and record against each other")
    return parser.parse_args(words)


def chosen(arguments, mutants, rows):
    for name in arguments.only or []:
        if name not in {mutant.name for mutant in mutants}:
            raise lists.BadList(f"mutants: unknown mutant {name}, expected those of ./run mutants --list")
    for name in arguments.row or []:
        if name not in rows:
            raise lists.BadList(f"mutants: unknown row {name}, expected those of docs/conformance.md")
    return [(number, mutant) for number, mutant in enumerate(mutants, 1)
            if not (arguments.only or arguments.row) or mutant.name in (arguments.only or []) or set(mutant.row_names) & set(arguments.row or [])]


def tell(lines):
    alive = [line for line in lines if line[2] == "survived"]
    for line in alive:
        print(f"mutants: row {line[1]} does not find {line[0]}", file=sys.stderr)
    killed = len({line[0] for line in lines}) - len({line[0] for line in alive})
    print(f"{killed} of {len({line[0] for line in lines})} mutants are found by each of their rows, {len(lines) - len(alive)} of {len(lines)} times a row finds one",
          file=sys.stderr)
    return 1 if alive else 0


def main(words):
    arguments = parse(words)
    try:
        if arguments.chip == "spc3":
            import spc3_mutants  # it uses this module
            return spc3_mutants.main(arguments)
        mutants, rows = lists.read("mutants"), lists.conformance(ROOT)
        numbered = chosen(arguments, mutants, rows)
        if arguments.list:
            print("\n".join("\t".join([mutant.name, mutant.rows, mutant.what]) for _, mutant in numbered))
            return 0
        if arguments.check:
            switches.sources(ROOT, mutants)
            lines = list(wrong(mutants))
            print("\n".join(lines) or f"{len(mutants)} mutants fit")
            return 1 if lines else 0
        build(mutants, arguments.jobs)
        if not arguments.json:
            print("\t".join(HEAD), flush=True)
        lines = run_all(numbered, rows, arguments)
        if arguments.json:
            print(json.dumps([dict(zip(HEAD, line)) for line in lines], indent=1))
        if arguments.record:
            record(mutants, lines)
        return tell(lines)
    except lists.BadList as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
