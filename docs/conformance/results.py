"""The last run's results of the tests that the data name: read from ctest's JUnit report, or from the recorded run.

The record (last_run.txt) has one line a name, its parts divided by tabs: the name, how many tests of it passed, how many there were, and the
names of those that did not pass. docs/conformance.md is made from it, so that the page is a function of files under version control alone.
"""
import re
import xml.etree.ElementTree
from dataclasses import dataclass, field

RECORD = "docs/conformance/last_run.txt"
HEADER = "# The last recorded run of ./run test. Written by ./run conformance --record; not to be edited.\n"


@dataclass
class Result:
    passed: int
    total: int
    failed: list = field(default_factory=list)


@dataclass
class Run:
    """Results by the names of the data. Without a commit nothing is known."""

    commit: str = ""
    date: str = ""
    passed: int = 0
    total: int = 0
    results: dict = field(default_factory=dict)

    def of(self, tests):
        """One result for several names; None when one of them is not in the run. A test of a suite that is named too counts once."""
        names = {test.name for test in tests}
        found = [self.results.get(name) for name in sorted(names) if name.split(".")[0] not in names - {name}]
        if not found or any(result is None or result.total == 0 for result in found):
            return None
        return Result(sum(each.passed for each in found), sum(each.total for each in found),
                      [name for each in found for name in each.failed])

    def newer(self, names):
        """Of these names those that the run does not know. A suite that has grown since is not among them."""
        return [name for name in names if self.results.get(name, Result(0, 0)).total == 0]


# -------------------------------------------------------------------------------------------------------- JUnit reports
def short_name(case):
    """CMake puts the parameter's value after the name of a test."""
    return re.sub(r"\s*# GetParam\(\) = .*", "", case.get("name"), flags=re.S)


def test_cases(report):
    """name -> passed. A test that was skipped or disabled has not passed: all that tests need is installed."""
    return {short_name(case): case.get("status") == "run" for case in xml.etree.ElementTree.parse(report).iter("testcase")}


def words(case):
    """By what a test case may be named: instance/Suite.Test/parameter has Suite, Suite.Test and /parameter."""
    parts = case.split("/")
    for number, part in enumerate(parts):
        suite, dot, _ = part.partition(".")
        if dot:
            yield from [part, suite]
            yield from (f"/{parameter}" for parameter in parts[number + 1:])
            return
    yield case


def wanted(name):
    """A scenario is the parameter of tests, named by its file without the ending."""
    return re.sub(r"\.\w+$", "", name[name.rindex("/"):]) if "/" in name else name


def run_of(report, names, commit, date):
    cases = test_cases(report)
    by_word = {}
    for case in cases:
        for word in set(words(case)):
            by_word.setdefault(word, []).append(case)
    run = Run(commit, date, sum(cases.values()), len(cases))
    for name in names:
        mine = by_word.get(wanted(name), [])
        run.results[name] = Result(sum(cases[case] for case in mine), len(mine), sorted(case for case in mine if not cases[case]))
    return run


# ------------------------------------------------------------------------------------------------------------ the record
def write_record(path, run):
    rows = [["run", run.commit, run.date, str(run.passed), str(run.total)]]
    rows += [[name, str(each.passed), str(each.total), *each.failed] for name, each in sorted(run.results.items())]
    path.write_text(HEADER + "".join("\t".join(row) + "\n" for row in rows), encoding="utf-8")


def read_record(path):
    if not path.exists():
        return Run()
    rows = [line.split("\t") for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    _, commit, date, passed, total = rows[0]
    run = Run(commit, date, int(passed), int(total))
    for name, good, count, *failed in rows[1:]:
        run.results[name] = Result(int(good), int(count), failed)
    return run
