#!/usr/bin/env python3
"""Builds and runs just the tests that a changed file concerns: ./run edit.

    edit.py [--list] [FILE...]

FILE: what has changed; without one, what git says has changed since the last commit. --list names the tests and runs none.

Which tests a file concerns:
  a source of tests              its suites
  a file that rulings are in     the tests that docs/conformance/rulings.yaml names for it
  any other C or C++ file        the suites of the sources of tests that include it, or its header; where there are none, of those that
                                 include what includes it; else those of the folder of tests whose name is a word of the file's
  a scenario                     its runs in step, skip and TLM
  the reference RTL              its lint
  a document                     links, names, rulings, rooms and arrows
  what a test of ctest names     that test

All are built in the preset edit. What else a file may break, ./run test says. Exit codes: 0 all passed, 1 a test failed or does not compile,
2 wrong input, 3 the files concern no test.
"""
import argparse
import collections
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import re
import subprocess
import sys
import time

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "edit"
ENDINGS = (".c", ".cpp", ".h", ".hpp", ".inc")
HEADERS = (".hpp", ".h")
NO_SOURCES = ("build", "out", "share")
SUITE = re.compile(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST)\((\w+),", re.M)
SECONDS = 600  # of a program: for what hangs


@dataclasses.dataclass
class Sources:
    """All C and C++ files by their paths: who includes them, and their suites."""
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
        """The file's header, itself where there is none."""
        stem = name.rpartition(".")[0]
        return next((stem + ending for ending in HEADERS if stem + ending in self.suites), name)

    def nearest_tests(self, name):
        """Sources with suites that include the file: directly, else through the fewest others."""
        level, seen = {self.header_of(name)}, set()
        while level:
            seen |= level
            reached = set().union(*(self.includers[each] for each in level))
            tests = {each for each in reached if self.suites[each]}
            if tests:
                return tests
            level = {self.header_of(each) for each in reached} - seen
        return set()

    def tests_of_words(self, name):
        """Sources of the folders of tests whose name begins as a word of the file's does."""
        words = re.split(r"[/_.]", name)
        return {each for each, suites in self.suites.items() if suites and
                any(folder.startswith(word) or word.startswith(folder) for folder in each.split("/")[1:-1] for word in words if len(word) > 2)}


def ruled(file):
    """Names of the tests of the rulings that are in the file."""
    rulings = yaml.load((ROOT / "docs/conformance/rulings.yaml").read_text(encoding="utf-8"), getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    return {test.split(" ")[0] for ruling in rulings.values() if {file, file.removeprefix("model/")} & set(ruling.get("model") or [])
            for test in ruling["tests"]}


def patterns(name):
    """Of a suite, or one test of it, those of --gtest_filter, with parameters or without."""
    suite, _, test = name.partition(".")
    return {f"{suite}.{test or '*'}", f"*/{suite}.{test or ''}*", f"{suite}/*.{test or '*'}"}


class Concern:
    """What is to be run: programs of GoogleTest with their filters, and tests of ctest."""

    def __init__(self, sources, programs):
        self._sources, self._programs = sources, programs
        self.filters, self.ctest = collections.defaultdict(set), set()

    def add(self, file, named):
        """Whether the file concerns any test; `named`: tests of ctest by the files on their command lines."""
        before = sum(map(len, self.filters.values())) + len(self.ctest)
        self.ctest |= named(file)
        if file in self._sources.suites:
            self._add_source(file)
        elif re.fullmatch(r"scenarios/\w+\.yaml", file):
            self._add_tests("tests/app/scenarios_test.cpp", {f"*/{pathlib.Path(file).stem}"})
        elif file.startswith("rtl_ref/"):
            self.ctest.add("Rtl.LintFindsNothing")
        return sum(map(len, self.filters.values())) + len(self.ctest) > before

    def _add_source(self, file):
        suites = self._sources.suites
        tests = {file} if suites[file] else set()
        names = set() if tests else ruled(file)
        if names:
            for source, theirs in suites.items():
                self._add_tests(source, {pattern for name in names if name.split(".")[0] in theirs for pattern in patterns(name)})
            return
        for source in tests or self._sources.nearest_tests(file) or self._sources.tests_of_words(file):
            self._add_tests(source, {pattern for suite in suites[source] for pattern in patterns(suite)})

    def _add_tests(self, source, filters):
        for program in self._programs.get(source, ()) if filters else ():
            self.filters[program] |= filters


def programs_of_tests():
    """Source to the programs that it is compiled into."""
    ninja = (BUILD / "build.ninja").read_text(encoding="utf-8")
    built = set(re.findall(r"^build (\S+): CXX_EXECUTABLE_LINKER__", ninja, re.M))
    found = collections.defaultdict(set)
    for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8")):
        folder, _, rest = re.search(r" -o (\S+)", entry["command"]).group(1).partition("/CMakeFiles/")
        program = f"{folder}/{rest.split('.dir/')[0]}"
        if program in built:
            found[os.path.relpath(entry["file"], ROOT)].add(program)
    return found


def tests_by_file():
    """A function: file to the tests of ctest that have it on their command line, documents to those that need nothing built. And what a test needs."""
    told = subprocess.run(["ctest", "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True, check=True).stdout
    commands = {test["name"]: test.get("command", []) for test in json.loads(told)["tests"] if "--gtest_brief=1" not in test.get("command", [])}
    needs = {name: {os.path.relpath(word, BUILD) for word in command if word.startswith(f"{BUILD}/")} for name, command in commands.items()}

    def named(file):
        found = {name for name, command in commands.items() if str(ROOT / file) in command}
        if file.endswith(".md") or file.startswith(("docs/", "tests/docs/")) or file in needs:
            found |= {name for name in commands if name.startswith("Docs.") and not needs[name]}
        return found
    return named, needs


def changed_files():
    """What differs from the last commit, new files too."""
    told = subprocess.run(["git", "-C", ROOT, "status", "--porcelain", "--untracked-files=all", "--no-renames"], capture_output=True, text=True, check=True).stdout
    return [line[3:] for line in told.splitlines() if "D" not in line[:2]]


def build(targets, jobs):
    return subprocess.run(["cmake", "--build", BUILD, "-j", str(jobs), "--target", *sorted(targets), "--", "--quiet"], stdout=sys.stderr, check=False).returncode


def run_shard(program, filters, shard, shards):
    """Passed and failed tests, and what the program said when any failed."""
    environment = {**os.environ, "GTEST_TOTAL_SHARDS": str(shards), "GTEST_SHARD_INDEX": str(shard), "GTEST_BRIEF": "1"}
    try:
        done = subprocess.run([BUILD / program, "--gtest_filter=" + ":".join(sorted(filters))], env=environment, cwd=(BUILD / program).parent,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return 0, 1, f"{program}: not at its end after {SECONDS} s\n"
    passed = re.findall(r"^\[  PASSED  \] (\d+) test", done.stdout, re.M)
    failed = re.findall(r"^\[  FAILED  \] (\d+) test", done.stdout, re.M)
    bad = sum(map(int, failed)) or (done.returncode != 0)
    return sum(map(int, passed)), bad, done.stdout if bad else ""


def run_ctest(names, jobs):
    expression = "^(" + "|".join(map(re.escape, sorted(names))) + ")$"
    done = subprocess.run(["ctest", "--test-dir", BUILD, "-j", str(jobs), "-R", expression, "--output-on-failure", "--timeout", str(SECONDS)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    failed = re.search(r"(\d+) tests failed out of (\d+)", done.stdout)
    bad, total = (int(failed[1]), int(failed[2])) if failed else (int(done.returncode != 0), 0)
    return total - bad, bad, done.stdout if bad else ""


def run(concern, jobs):
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        runs = [pool.submit(run_shard, program, filters, shard, jobs) for program, filters in sorted(concern.filters.items()) for shard in range(jobs)]
        results = [each.result() for each in runs]
    if concern.ctest:
        results.append(run_ctest(concern.ctest, jobs))
    print("".join(text for _, _, text in results), end="")
    return sum(passed for passed, _, _ in results), sum(bad for _, bad, _ in results)


def parsed(arguments):
    parser = argparse.ArgumentParser(prog="./run edit", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", metavar="FILE")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--check", action="store_true", help=argparse.SUPPRESS)  # for ./run: the arguments only
    parser.add_argument("-j", type=int, default=os.cpu_count() or 2, dest="jobs", help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def files_of(given):
    for name in given:
        path = pathlib.Path(name).resolve()
        if not path.is_file() or not path.is_relative_to(ROOT):
            print(f"edit: {name} is no file of the project, allowed is what stands below {ROOT}", file=sys.stderr)
            sys.exit(2)
        yield path.relative_to(ROOT).as_posix()


def main():
    arguments, begin = parsed(sys.argv[1:]), time.monotonic()
    files = sorted(files_of(arguments.files)) if arguments.files else changed_files()
    if arguments.check:
        return 0
    named, needs = tests_by_file()
    concern = Concern(Sources.read(ROOT), programs_of_tests())
    for file in files:
        if not concern.add(file, named):
            print(f"edit: {file} concerns no test by what includes or names it", file=sys.stderr)
    if not concern.filters and not concern.ctest:
        print("edit: nothing to be run" if files else "edit: nothing has changed since the last commit", file=sys.stderr)
        return 3
    if arguments.list:
        print("".join(f"{program} {':'.join(sorted(filters))}\n" for program, filters in sorted(concern.filters.items())) + "".join(f"{name}\n" for name in sorted(concern.ctest)), end="")
        return 0
    if build(set(concern.filters) | set().union(*(needs[name] for name in concern.ctest), set()), arguments.jobs):
        return 1
    passed, failed = run(concern, arguments.jobs)
    print(f"{passed} passed, {failed} failed in {time.monotonic() - begin:.1f} s; the rest of the tests: ./run test")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
