#!/usr/bin/env python3
"""The walks of docs/architecture.md against the sources.

    walks.py [--root FOLDER]

A walk is a numbered list between `<!-- walk: NAME -->` and `<!-- /walk -->`. Each line begins with a file in backquotes; what else stands in backquotes
are identifiers, or words of the command line, that the file contains. Two lines that follow each other are connected: one of the files, or its header,
includes the other or its header, or an identifier that one of the lines names is in both. At the end stands how many rooms (folders) and types (classes,
structs) the lines name.
One line a fault, exit 1 when there is any.
"""
import argparse
import itertools
import re
import sys

import faults

PAGE = "docs/architecture.md"
WALK = re.compile(r"<!-- walk: ([\w ]+) -->\n(.*?)<!-- /walk -->", re.S)
NAMES = ["a key", "an output byte", "a violation", "an option"]
MOST_LINES = 10
COUNTS = re.compile(r"^(\d+) rooms, (\d+) types\.$", re.M)
HEADERS = [".hpp", ".h"]
SOURCES = {*HEADERS, ".c", ".cpp"}
NO_ROOMS = ("build", "out", "tests")


class Line:
    """A line of a walk: the file and the words that it names."""

    def __init__(self, root, number, text):
        self.number = number
        self.file, *words = re.findall(r"`([^`]+)`", text) or [""]
        self.words = [word for each in words for word in each.split("::")]
        self.exists = bool(self.file) and (root / self.file).is_file()
        self.headers = [name for ending in HEADERS if (root / (name := self.file.rpartition(".")[0] + ending)).is_file()]
        self.source, *texts = [(root / name).read_text(encoding="utf-8") for name in [self.file, *self.headers]] if self.exists else [""]
        self.included = set(re.findall(r'^#include "([^"]+)"', "\n".join([self.source, *texts]), re.M))

    @property
    def room(self):
        return self.file.rpartition("/")[0]

    def contains(self, word):
        return re.search(rf"(?<!\w){re.escape(word)}(?!\w)", self.source) is not None

    def includes(self, other):
        return bool(self.included & {other.file, *other.headers})


def lines_of(root, page, walk):
    start = page.count("\n", 0, walk.start(2)) + 1
    for number, text in enumerate(walk.group(2).splitlines(), start):
        if re.match(r"\d+\. ", text):
            yield Line(root, number, text)


def connected(one, other):
    shared = any(one.contains(word) and other.contains(word) for word in one.words + other.words)
    return shared or one.includes(other) or other.includes(one)


def types_of(root):
    """The names of all classes and structs."""
    rooms = [each for each in root.iterdir() if each.is_dir() and each.name not in NO_ROOMS and not each.name.startswith(".")]
    sources = [path for room in rooms for path in room.rglob("*") if path.suffix in SOURCES]
    return {name for path in sources for name in re.findall(r"\b(?:class|struct) (\w+)", path.read_text(encoding="utf-8"))}


def check_lines(lines):
    for line in lines:
        if not line.exists:
            yield line.number, f"there is no file {line.file}"
        for word in line.words if line.exists else []:
            if not line.contains(word):
                yield line.number, f"{line.file} does not contain {word}"
    for one, other in itertools.pairwise(lines):
        if one.exists and other.exists and not connected(one, other):
            yield other.number, f"{other.file} and {one.file} neither include each other nor share an identifier that is named"


def check_walk(lines, text, types):
    if len(lines) > MOST_LINES:
        yield lines[MOST_LINES].number, f"the walk has {len(lines)} lines, expected {MOST_LINES}"
    yield from check_lines(lines)
    rooms = {line.room for line in lines}
    named = {word for line in lines for word in line.words} & types
    counts = COUNTS.search(text)
    if counts is None or [int(each) for each in counts.groups()] != [len(rooms), len(named)]:
        yield lines[-1].number, f"below the walk must stand: {len(rooms)} rooms, {len(named)} types."


def check(root):
    page, types = (root / PAGE).read_text(encoding="utf-8"), types_of(root)
    walks = {walk.group(1): walk for walk in WALK.finditer(page)}
    for name in NAMES:
        lines = list(lines_of(root, page, walks[name])) if name in walks else []
        if not lines:
            yield f"{PAGE}:1: the walk of {name} is missing"
            continue
        for number, fault in check_walk(lines, walks[name].group(2), types):
            yield f"{PAGE}:{number}: {fault}"


if __name__ == "__main__":
    sys.exit(faults.main(__doc__, check, "walks: right"))
