#!/usr/bin/env python3
"""Lists failed tests at the end of a long output: the last lines of the first ones, then the names of all.

    failures.py BUILD_FOLDER...      each has the tests.xml of its ctest; the folder's name is the preset's
"""
import re
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

IN_FULL = 10          # tests whose output is shown
LEAST, MOST = 15, 60  # lines of it: from the first that mentions a failure, within these bounds
WIDTH = 300
SPEAKS = re.compile("fail|error|attempt 1:|traceback", re.IGNORECASE)


def not_passed(folder):
    """(words, last lines) of each test that failed or was skipped; nothing for a missing report."""
    for report in folder.glob("tests.xml"):
        for test in xml.parse(report).iter("testcase"):
            skipped = test.find("skipped")
            if skipped is not None or test.find("failure") is not None:
                reason = "failed" if skipped is None else "skipped: " + skipped.get("message")
                yield f"{test.get('name')} ({folder.name}, {float(test.get('time')):.0f} s) {reason}", last_lines(test)


def last_lines(test):
    lines = test.findtext("system-out", "").rstrip().splitlines()[-MOST:]
    speaks = (number for number, line in enumerate(lines) if SPEAKS.search(line))
    first = min(next(speaks, len(lines)), max(0, len(lines) - LEAST))
    return [line[:WIDTH] for line in lines[first:]]


def main(folders):
    tests = [test for folder in folders for test in not_passed(Path(folder))]
    for words, lines in tests[:IN_FULL]:
        print("", "--- " + words, *lines, sep="\n")
    if tests:
        print("", "Did not pass:", *("  " + words for words, _ in tests), sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
