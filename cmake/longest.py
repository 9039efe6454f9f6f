#!/usr/bin/env python3
"""Lists the slowest tests: seconds, preset and name, one per line.

    longest.py BUILD_FOLDER...      each has the tests.xml of its ctest; the folder's name is the preset's
"""
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

SHOWN = 25


def times(folder):
    for report in folder.glob("tests.xml"):
        for test in xml.parse(report).iter("testcase"):
            yield float(test.get("time")), folder.name, test.get("name")


def main(folders):
    longest = sorted((each for folder in folders for each in times(Path(folder))), reverse=True)[:SHOWN]
    if longest:
        print("", "Longest tests:", *(f"{seconds:6.1f} s  {preset}  {name}" for seconds, preset, name in longest), "", sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
