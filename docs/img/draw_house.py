#!/usr/bin/env python3
"""Draws docs/img/house.svg: the rooms of the project and which of them includes which, from the table of arrows in docs/architecture.md.

    docs/img/draw_house.py docs/architecture.md docs/img/house.svg

An arrow is left out where a longer way leads to the same room. Python's standard library only. The tests draw it again and compare (tests/docs).
"""
import pathlib
import re
import sys
import textwrap

# Column and row of each room, and what it is.
ROOMS = {
    "include": (0, 0, "headers of the C API"), "registers": (2.3, 0, "the DPRAM map"), "bus": (4, 0, "line, telegrams, masters, GSD"),
    "bindings": (1, 1, "Verilog simulators, Python"), "driver": (2, 1, "the C driver"), "model": (3, 1, "the chip"), "io": (4, 1, "files, keys, waves"),
    "tb": (3.5, 2, "one run: the bench"), "board": (3.05, 3, "an STM32F103"), "lab": (4, 3, "many runs, recordings"), "cosim": (4, 4, "RTL beside the model"),
    "capi": (0, 5, "libdsdpv1.so"), "kinds": (3, 5, "all that is a chip's own"), "examples": (1.5, 6, "programs of one's own"), "apps": (3, 6, "dsdpv1-sim"),
}
ROWS = 7
LEFT, TOP, COLUMN, ROW, WIDTH, HEIGHT = 12, 12, 214, 122, 196, 82
STYLE = """
text { font: 11px "DejaVu Sans", Arial, sans-serif; fill: #24292f; text-anchor: middle }
.room { font-weight: bold; font-size: 14px } .rooms { font: 9.5px "DejaVu Sans Mono", monospace; fill: #57606a }
rect { fill: #ddf4ff; stroke: #57606a; stroke-width: .8 } .kinds { fill: #fff8c5 } .model, .driver, .registers { fill: #dafbe1 }
.arrow { fill: none; stroke: #57606a; stroke-width: 1.2 }
"""


def arrows_of(page):
    """Top folder to the top folders that it includes, and to the rooms in it."""
    table = re.search(r"<!-- arrows -->\n(.*?)<!-- /arrows -->", page, re.S).group(1)
    arrows, inside = {}, {}
    for room, cell in re.findall(r"^\| `([^`]+)` \| (.*?) ?\|", table, re.M):
        top, _, rest = room.partition("/")
        arrows.setdefault(top, set()).update(word.split("/")[0] for word in re.findall(r"`([^`]+)`", cell))
        inside.setdefault(top, []).extend([rest] if rest not in ("", "*") else [])
    return {room: others - {room} for room, others in arrows.items()}, inside


def reached(arrows, room):
    return arrows[room] | {each for other in arrows[room] for each in reached(arrows, other)}


def least(arrows):
    """Without those that a longer way makes superfluous."""
    return {room: {each for each in others if not any(each in reached(arrows, other) for other in others)} for room, others in arrows.items()}


def names_inside(rooms):
    """The rooms of the first floor; of the only one, what is in it."""
    first = list(dict.fromkeys(room.split("/")[0] for room in rooms))
    deeper = [room.split("/")[1] for room in rooms if "/" in room]
    return f"{first[0]}: {' '.join(deeper)}" if len(first) == 1 and len(deeper) > 1 else " ".join(first)


def corner(room):
    column, row, _ = ROOMS[room]
    return LEFT + COLUMN * column, TOP + ROW * (ROWS - 1 - row)


def box(room, rooms):
    x, y = corner(room)
    yield f'<rect class="{room}" x="{x:g}" y="{y:g}" width="{WIDTH}" height="{HEIGHT}" rx="5"/>'
    lines = [("room", f"{room}/"), ("", ROOMS[room][2])] + [("rooms", line) for line in textwrap.wrap(names_inside(rooms), 32)]
    for number, (kind, words) in enumerate(lines):
        yield f'<text class="{kind}" x="{x + WIDTH / 2:g}" y="{y + 19 + 16 * number - 2 * max(0, number - 1):g}">{words}</text>'


def arrow(room, other):
    (x, y), (to_x, to_y) = corner(room), corner(other)
    x, y, to_x = x + WIDTH / 2, y + HEIGHT, to_x + WIDTH / 2
    shift = max(-72, min(72, (to_x - x) / 4))
    x, to_x, bend = x + shift, to_x - shift, min(60, (to_y - y) / 2)
    yield f'<path class="arrow" marker-end="url(#tip)" d="M{x:.0f} {y:.0f}C{x:.0f} {y + bend:.0f} {to_x:.0f} {to_y - bend:.0f} {to_x:.0f} {to_y - 2:.0f}"/>'


def drawn(page):
    arrows, inside = arrows_of(page)
    if set(arrows) != set(ROOMS):
        raise SystemExit(f"draw_house: give {', '.join(sorted(set(arrows) ^ set(ROOMS)))} a place in ROOMS, or take it out")
    parts = [line for room, others in least(arrows).items() for other in sorted(others) for line in arrow(room, other)]
    parts += [line for room in ROOMS for line in box(room, inside[room])]
    width, height = LEFT + COLUMN * 5, TOP + ROW * (ROWS - 1) + HEIGHT + 12
    size = f'width="{width}" height="{height}"'
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" {size}>\n<title>The rooms of the project; drawn by docs/img/draw_house.py</title>\n'
            f'<style>{STYLE}</style>\n<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
            f'<path d="M0 0L8 4L0 8z" style="fill:#57606a"/></marker></defs>\n<rect {size} style="fill:#fff;stroke:none"/>\n' + "\n".join(parts) + "\n</svg>\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit("usage: draw_house.py docs/architecture.md PICTURE.svg")
    pathlib.Path(sys.argv[2]).write_text(drawn(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")), encoding="utf-8")
