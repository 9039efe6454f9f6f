#!/usr/bin/env python3
"""Builds and runs only the tests that a changed file concerns: ./run edit.

    edit.py [--list] [--all] [FILE...]

FILE: a changed file; default: all files that git reports as changed since the last commit.

Which tests a file concerns:
  a source of tests              its suites
  a file with rulings            the tests that docs/conformance/rulings.yaml names for it
  any other C or C++ file        the suites of the sources of tests that include it or its header, only those in the folder of its room if there
                                 are any; without such sources, those that include them indirectly; else the suites in the folder of tests
                                 named by a word of the file's name
  a scenario                     its runs in step, skip and TLM
  the reference RTL              its lint
  a file with planted faults or  whether their lists still fit; whether the tests find them: ./run faults, ./run mutants
  mutants, or a list of them
  a document                     links, names, rulings, rooms and arrows
  a file on a ctest command line that test

All are built in the preset edit. If the times of tests are known from an earlier call, only the shortest are run, up to 8 s in total; --all runs
them all. ./run test shows what else a file may break. Exit codes: 0 all passed, 1 a test failed or does not compile, 2 wrong input, 3 the files
concern no test.
"""
import argparse
import collections
import concurrent.futures
import dataclasses
import fnmatch
import itertools
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "edit"
ENDINGS = (".c", ".cpp", ".h", ".hpp", ".inc")
HEADERS = (".hpp", ".h")
NO_SOURCES = ("build", "out", "share")
SUITE = re.compile(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST)\((\w+),", re.M)
SECONDS = 600  # of a program: for what hangs
CALLS_SIM = "tests/app/program.hpp"  # what a test includes that calls the built dsdpv1-sim
BUDGET = 8  # s of tests in total
TIMES = BUILD / "edit_times.json"  # program to its tests to s, of earlier calls


@dataclasses.dataclass
class Sources:
    """All C and C++ files by path: the files that include them, and their suites."""
    includers: dict
    suites: dict

    @classmethod
    def read(cls, root):
        found = cls(collections.defaultdict(set), {})
        for folder in sorted(path for path in root.iterdir() if path.is_dir() and path.name[0] != "." and path.name not in NO_SOURCES):
            for path in folder.rglob("*"):
                if path.suffix in ENDINGS:
                    found.add(path.relative_to(root).as_posix(), path.read_text(encoding="utf-8", errors="replace"))
        return found

    def add(self, name, text):
        self.suites[name] = set(SUITE.findall(text)) if name.startswith("tests/") else set()
        for included in re.findall(r'^#include "([^"]+)"', text, re.M):
            self.includers[included].add(name)

    def header_of(self, name):
        """The file's header, or the file itself without one."""
        stem = name.rpartition(".")[0]
        return next((stem + ending for ending in HEADERS if stem + ending in self.suites), name)

    def nearest_tests(self, name):
        """Sources with suites that include the file: directly, or through the fewest others; only those in the folder of its room, if there are
        any."""
        level, seen = {self.header_of(name)}, set()
        while level:
            seen |= level
            reached = set().union(*(self.includers[each] for each in level))
            tests = {each for each in reached if self.suites[each]}
            if tests:
                rooms = set(name.split("/")[:-1])
                return {each for each in tests if rooms & set(each.split("/")[1:-1])} or tests
            level = {self.header_of(each) for each in reached} - seen
        return set()

    def reaching(self, header):
        """All files that include a header, directly or through others."""
        found, open_names = set(), [header]
        while open_names:
            new = self.includers[open_names.pop()] - found
            found |= new
            open_names += new
        return found

    def tests_of_words(self, text):
        """Sources in the folders of tests whose name begins with a word of `text`."""
        words = re.split(r"[/_.]", text)
        return {each for each, suites in self.suites.items() if suites and
                any(folder.startswith(word) or word.startswith(folder) for folder in each.split("/")[1:-1] for word in words if len(word) > 2)}


def ruled(file):
    """Names of the tests of the rulings that concern the file."""
    rulings = yaml.load((ROOT / "docs/conformance/rulings.yaml").read_text(encoding="utf-8"), getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    return {test.split(" ")[0] for ruling in rulings.values() if {file, file.removeprefix("model/")} & set(ruling.get("model") or [])
            for test in ruling["tests"]}


def planted(file):
    """The tests whether the lists of faults and mutants still fit, if one alters the file or the file is one."""
    lists = {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "tests/planted").glob("*.yaml")}
    tests = {"mutants": "Mutants.FitTheSourcesAndTheRows", "spc3_mutants": "Mutants.OfTheSpc3FitTheSourcesAndThePage"}
    return {tests.get(name, "PlantedFaults.FitTheSources") for name, text in lists.items()
            if file == f"tests/planted/{name}.yaml" or re.search(rf"\bfile: {re.escape(file)}[,\n]", text)}


def patterns(name):
    """The --gtest_filter for a suite, or one of its tests, with parameters or without."""
    suite, _, test = name.partition(".")
    return {f"{suite}.{test or '*'}", f"*/{suite}.{test or ''}*", f"{suite}/*.{test or '*'}"}


class Concern:
    """The tests to run: programs of GoogleTest with their filters, and tests of ctest."""

    def __init__(self, sources, programs):
        self._sources, self._programs = sources, programs
        self.filters, self.ctest, self.targets = collections.defaultdict(set), set(), set()
        self._callers = sources.reaching(CALLS_SIM)

    def add(self, file, named):
        """Whether the file concerns any test; `named`: tests of ctest by the files on their command lines."""
        tests = named(file) | planted(file) | ({"Rtl.LintFindsNothing"} if file.startswith("rtl_ref/") else set())
        self.ctest |= tests
        suites = self._suites_of(file)
        for source, filters in suites.items():
            for program in self._programs.get(source, ()):
                self.filters[program] |= filters
                self.targets |= {program, "dsdpv1-sim"} if source in self._callers else {program}
        return bool(tests or suites)

    def _suites_of(self, file):
        """Sources of tests, and the filters for the suites in them that the file concerns."""
        suites = self._sources.suites
        if re.fullmatch(r"scenarios/\w+\.yaml", file):
            return {"tests/app/scenarios_test.cpp": {f"*/{pathlib.Path(file).stem}"}}
        if file not in suites:
            return {}
        if names := set() if suites[file] else ruled(file):
            chosen = {source: {pattern for name in names if name.split(".")[0] in theirs for pattern in patterns(name)} for source, theirs in suites.items()}
            return {source: filters for source, filters in chosen.items() if filters}
        folder, _, stem = file.rpartition("/")
        near = {file} if suites[file] else self._sources.nearest_tests(file)
        return {source: {pattern for suite in suites[source] for pattern in patterns(suite)}
                for source in near or self._sources.tests_of_words(stem) or self._sources.tests_of_words(folder)}


def programs_of_tests(ninja):
    """Maps each source to the programs that it is compiled into."""
    built = set(re.findall(r"^build (\S+): CXX_EXECUTABLE_LINKER__", ninja, re.M))
    found = collections.defaultdict(set)
    for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8")):
        folder, _, rest = re.search(r" -o (\S+)", entry["command"]).group(1).partition("/CMakeFiles/")
        program = f"{folder}/{rest.split('.dir/')[0]}"
        if program in built:
            found[os.path.relpath(entry["file"], ROOT)].add(program)
    return found


def tests_by_file(ninja):
    """A function: file to the tests of ctest that have it on their command line, documents to those that need nothing built. And what of the build a test
    has on it."""
    outputs = set(re.findall(r"^build (\S+): ", ninja, re.M))
    told = subprocess.run(["ctest", "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True, check=True).stdout
    commands = {test["name"]: test.get("command", []) for test in json.loads(told)["tests"] if "--gtest_brief=1" not in test.get("command", [])}
    needs = {name: {os.path.relpath(word, BUILD) for word in command} & outputs for name, command in commands.items()}

    def named(file):
        found = {name for name, command in commands.items() if str(ROOT / file) in command}
        if file.endswith(".md") or file.startswith(("docs/", "tests/docs/")):
            found |= {name for name in commands if name.startswith("Docs.") and not needs[name]}
        return found
    return named, needs


def changed_files():
    """Files that differ from the last commit, including new ones."""
    told = subprocess.run(["git", "-C", ROOT, "status", "--porcelain", "--untracked-files=all", "--no-renames"], capture_output=True, text=True, check=True).stdout
    return [line[3:] for line in told.splitlines() if "D" not in line[:2]]


def build(targets, jobs):
    return subprocess.run(["cmake", "--build", BUILD, "-j", str(jobs), "--target", *sorted(targets), "--", "--quiet"], stdout=sys.stderr, check=False).returncode


def known_times():
    return json.loads(TIMES.read_text(encoding="utf-8")) if TIMES.exists() else {}


def too_long(filters, times, budget):
    """Of the tests selected by the filters, those beyond the shortest that fit the budget: program to names; and their total time in s."""
    known = sorted((seconds, program, name) for program, chosen in filters.items() for name, seconds in times.get(program, {}).items()
                   if any(fnmatch.fnmatchcase(name, each) for each in chosen))
    sums = itertools.accumulate(seconds for seconds, _, _ in known)
    left = [each for each, total in zip(known, sums) if total > budget]
    names = collections.defaultdict(set)
    for _, program, name in left:
        names[program].add(name)
    return names, sum(seconds for seconds, _, _ in left)


def run_shard(program, chosen, shard, shards):
    """Passed and failed tests, the output if any failed, and the time of each."""
    with tempfile.TemporaryDirectory(prefix="edit-") as folder:
        report = pathlib.Path(folder, "tests.json")
        environment = {**os.environ, "GTEST_TOTAL_SHARDS": str(shards), "GTEST_SHARD_INDEX": str(shard), "GTEST_BRIEF": "1"}
        command = [BUILD / program, f"--gtest_filter={chosen}", f"--gtest_output=json:{report}"]
        try:
            done = subprocess.run(command, env=environment, cwd=(BUILD / program).parent, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  errors="replace", timeout=SECONDS, check=False)
        except subprocess.TimeoutExpired:
            return 0, 1, f"{program}: not at its end after {SECONDS} s\n", {}
        told = json.loads(report.read_text(encoding="utf-8")) if report.exists() else {"testsuites": []}
    tests = [test for suite in told["testsuites"] for test in suite["testsuite"] if test["result"] == "COMPLETED"]
    failed = sum("failures" in test for test in tests) or (done.returncode != 0)
    times = {f"{test['classname']}.{test['name']}": float(test["time"].rstrip("s")) for test in tests}
    return len(tests) - min(failed, len(tests)), failed, done.stdout if failed else "", times


def run_ctest(names, jobs):
    expression = "^(" + "|".join(map(re.escape, sorted(names))) + ")$"
    done = subprocess.run(["ctest", "--test-dir", BUILD, "-j", str(jobs), "-R", expression, "--output-on-failure", "--timeout", str(SECONDS)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    failed = re.search(r"(\d+) tests failed out of (\d+)", done.stdout)
    bad, total = (int(failed[1]), int(failed[2])) if failed else (int(done.returncode != 0), 0)
    return total - bad, bad, done.stdout if bad else ""


def run(concern, left_out, times, jobs):
    """Passed and failed tests; prints their output and keeps the times."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        runs = {}
        for program, filters in sorted(concern.filters.items()):
            chosen = ":".join(sorted(filters)) + "-" + ":".join(sorted(left_out.get(program, ())))
            runs[program] = [pool.submit(run_shard, program, chosen, shard, jobs) for shard in range(jobs)]
        results = {program: [each.result() for each in shards] for program, shards in runs.items()}
    for program, shards in results.items():
        for *_, seconds in shards:
            times.setdefault(program, {}).update(seconds)
    TIMES.write_text(json.dumps(times), encoding="utf-8")
    told = [shard[:3] for shards in results.values() for shard in shards]
    if concern.ctest:
        told.append(run_ctest(concern.ctest, jobs))
    print("".join(text for _, _, text in told), end="")
    return sum(passed for passed, _, _ in told), sum(failed for _, failed, _ in told)


def parsed(arguments):
    parser = argparse.ArgumentParser(prog="./run edit", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", metavar="FILE")
    parser.add_argument("--list", action="store_true", help="names what would be run")
    parser.add_argument("--all", action="store_true", help="also the tests that take long")
    parser.add_argument("--check", action="store_true", help=argparse.SUPPRESS)  # for ./run: the arguments only
    parser.add_argument("-j", type=int, default=os.cpu_count() or 2, dest="jobs", help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def files_of(given):
    for name in given:
        path = pathlib.Path(name).resolve()
        if not path.is_file() or not path.is_relative_to(ROOT):
            print(f"edit: {name} is no file of the project, expected what stands below {ROOT}", file=sys.stderr)
            sys.exit(2)
        yield path.relative_to(ROOT).as_posix()


def main():
    arguments, begin = parsed(sys.argv[1:]), time.monotonic()
    files = sorted(files_of(arguments.files)) if arguments.files else changed_files()
    if arguments.check:
        return 0
    ninja = (BUILD / "build.ninja").read_text(encoding="utf-8")
    named, needs = tests_by_file(ninja)
    concern = Concern(Sources.read(ROOT), programs_of_tests(ninja))
    for file in files:
        if not concern.add(file, named):
            print(f"edit: {file} concerns no test by what includes or names it", file=sys.stderr)
    if not concern.filters and not concern.ctest:
        print("edit: nothing to be run" if files else "edit: nothing has changed since the last commit", file=sys.stderr)
        return 3
    if arguments.list:
        print("".join(f"{program} {':'.join(sorted(filters))}\n" for program, filters in sorted(concern.filters.items())) + "".join(f"{name}\n" for name in sorted(concern.ctest)), end="")
        return 0
    targets = concern.targets.union(*(needs[name] for name in concern.ctest))
    if targets and build(targets, arguments.jobs):
        return 1
    times = known_times()
    left_out, seconds = too_long(concern.filters, times, math.inf if arguments.all else BUDGET)
    passed, failed = run(concern, left_out, times, arguments.jobs)
    longer = f"; {sum(map(len, left_out.values()))} more, which take {seconds:.0f} s: --all" if left_out else ""
    print(f"{passed} passed, {failed} failed in {time.monotonic() - begin:.1f} s{longer}; all others: ./run test")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
