#!/usr/bin/env python3
"""The arrows between the rooms: what docs/architecture.md allows against what the sources include.

    arrows.py [--root FOLDER]

A row of the page's table is a room (a folder with C or C++ files) and the rooms that it includes; `bus/*` is bus and all rooms in it. A row
`apps/*` is one room of several folders, whose arrows among each other are not checked. A room includes only rooms that stand above it, so there
is no circle. One line a fault, exit 1 when there is any.
"""
import re
import sys

import faults

PAGE = "docs/architecture.md"
TABLE = re.compile(r"<!-- arrows -->\n(.*?)<!-- /arrows -->", re.S)
ROW = re.compile(r"^\| `([^`]+)` \| (.*?) ?\|", re.M)
ENDINGS = {".c", ".cpp", ".h", ".hpp", ".inc"}
NO_ROOMS = ("build/", "out/", "tests/", "rtl_ref/", ".")  # tests may look at everything; the RTL includes nothing of C++


def rows_of(text):
    """Room to the words of its cell, in the order of the page."""
    rows, table = {}, TABLE.search(text)
    for room, cell in ROW.findall(table.group(1)) if table else []:
        rows.setdefault(room, []).extend(re.findall(r"`([^`]+)`", cell))
    return rows


def includes_of(root):
    """Room to {room that it includes: one place where it does}."""
    found = {}
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if path.suffix not in ENDINGS or name.startswith(NO_ROOMS) or not path.is_file():
            continue
        room = found.setdefault(name.rpartition("/")[0], {})
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            included = re.match(r'#include "([^"]+)/[^"/]+"', line)
            for other in [included.group(1), "include/" + included.group(1)] if included else []:
                if (root / other).is_dir() and other != name.rpartition("/")[0]:
                    room.setdefault(other, f"{name}:{number}")
    return found


def stands_for(word, room):
    return word == room or (word.endswith("/*") and (room + "/").startswith(word[:-1]))


def joined(found, rows):
    """The same by the rows: folders that have one together are one room."""
    def room_of(folder):
        return next((row for row in rows if stands_for(row, folder)), folder)

    rooms = {}
    for folder, others in found.items():
        room = rooms.setdefault(room_of(folder), {})
        for other, place in others.items():
            if room_of(other) != room_of(folder):
                room.setdefault(other, place)
    return rooms, room_of


def check(root):
    text = (root / PAGE).read_text(encoding="utf-8")
    rows = rows_of(text)
    found, room_of = joined(includes_of(root), rows)
    order = list(rows)
    for room in found:
        if room not in rows:
            yield f"{PAGE}:1: the table of arrows has no row for {room}"
            continue
        for other, place in found[room].items():
            if not any(stands_for(word, other) for word in rows[room]):
                yield f"{place}: {room} includes {other}, which {PAGE} does not allow"
            elif room_of(other) in order and order.index(room_of(other)) > order.index(room):
                yield f"{place}: {room} includes {other}, which stands below it in {PAGE}"
        for word in rows[room]:
            if not any(stands_for(word, other) for other in found[room]):
                yield f"{PAGE}:1: {room} includes nothing of {word} any more"
    for room in rows:
        if room not in found:
            yield f"{PAGE}:1: there is no room {room}"


if __name__ == "__main__":
    sys.exit(faults.main(__doc__, check, "arrows: right"))
