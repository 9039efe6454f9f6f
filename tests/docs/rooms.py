#!/usr/bin/env python3
"""The names that a room of the project must not contain: one line a fault, exit 1 when there is any. For includes see arrows.py.

    rooms.py    looks for the words of FORBIDDEN in the source of each room

--root FOLDER: another project than the one this file is in. Python's standard library only.
"""
import argparse
import pathlib
import re
import sys

SOURCES = {".c", ".cpp", ".h", ".hpp", ".inc", ".sv", ".svh"}

# Room, what it must not name, and why. Names are regular expressions; comments and texts count as well.
FORBIDDEN = [
    ("model/profibus", r"\bB[0-7][0-9A-F]{2}\b", "no address of a chip's cells"),
    ("model/profibus", r"(?i)(?<!namespace )dsdpv1|dpram", "no chip, no family"),
    ("model/profibus", r"registers/|\bregs::", "no register"),
    ("model/profibus", r"\b(CSR|RD|WR|R_REQ|R_STA|L_REQ|L_STA|INTR0|PBF|BR|READY)\b", "no pin of the user's side"),
    ("model/dpram", r"\b(CSR|RD|WR|R_REQ|R_STA|L_REQ|L_STA|INTR0)\b", "no pin of a port"),
    ("model/dpram", r"\b(HostPort|Handshake|Interrupt|Chip)\b", "no block of a chip that has it"),
    ("model/dpram", r"\bstation_|\b(Station|DpSlave)\b|profibus/(station|dp_slave)", "the slave by its user side only"),
    ("rtl_ref/profibus", r"\bB[0-7][0-9A-F]{2}\b", "no address of a chip's cells"),
    ("rtl_ref/profibus", r"(?i)dsdpv1|dpram", "no chip, no family"),
    ("rtl_ref/dpram", r"(?i)\b(csr|rd|wr|r_req|r_sta|l_req|l_sta|intr0)(_[io])?\b", "no pin of a port"),
]

# These serve any kind of chip: they name no chip's types, pins or registers. CHIP_ROOMS may.
CHIP_ROOMS = ["kinds", "capi", "driver", "examples", "bindings", "include", "model", "registers"]
GENERAL_ROOMS = ["board", "bus", "cosim", "io", "lab", "tb", "apps"]
NO_ROOMS = ["build", "out", "rtl_ref", "tests"]
A_CHIP = r"\bdsdpv1::(?=k?[A-Z])|\bdpram::|\bmailbox::|model/(dsdpv1|dpram)|\bPin::k|\bAccessTiming|\bregs::|registers/(dsdpv1|spc3)"
ITS_CELLS = r"\bB[0-7][0-9A-F]{2}\b|\b(CSR|RD|WR|R_REQ|R_STA|L_REQ|L_STA|INTR0)\b"
# Files of these rooms that name the DSDPV1 for now, by the step that ends it (docs/architecture.md); and those that may for good.
NAME_A_CHIP = {
    "the mailbox is the kind's": """
        board/firmware/mailbox.h
    """.split(),
    "for good: RCC_CSR is a register of the STM32": """
        board/stm32/rcc.cpp
    """.split(),
}
FORBIDDEN += [(room, A_CHIP, "no chip by name") for room in GENERAL_ROOMS]
FORBIDDEN += [(room, ITS_CELLS, "no chip's pins and cells") for room in GENERAL_ROOMS]
# REUSE-IgnoreStart
COPYRIGHT = r"(//|/\*) SPDX-FileCopyrightText: "  # names the authors, who are those of the whole project
# REUSE-IgnoreEnd


def named_for_now():
    return {name for names in NAME_A_CHIP.values() for name in names}


def sources(root, room):
    return sorted(path for path in (root / room).rglob("*") if path.suffix in SOURCES)


def faults(root, forbidden):
    for room, pattern, why in forbidden:
        files = sources(root, room)
        if not files:
            yield f"{room}: no such room, correct the table in tests/docs/rooms.py"
        for path in files:
            if pattern in (A_CHIP, ITS_CELLS) and path.relative_to(root).as_posix() in named_for_now():
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if not re.match(COPYRIGHT, line) and (found := re.search(pattern, line)):
                    yield f"{path.relative_to(root)}:{number}: {found.group()}, but {room} knows {why}"


def names_no_chip_any_more(root):
    """Files of NAME_A_CHIP that need not stand there."""
    for name in sorted(named_for_now()):
        path = root / name
        if not path.is_file() or not re.search(f"{A_CHIP}|{ITS_CELLS}", path.read_text(encoding="utf-8")):
            yield f"{name}: names no chip, take it out of NAME_A_CHIP of tests/docs/rooms.py"


def unknown_rooms(root):
    """Rooms in neither list, and those whose headers clang-tidy would skip silently."""
    tidied = re.search(r"^HeaderFilterRegex: '(.*)'$", (root / ".clang-tidy").read_text(encoding="utf-8"), re.M).group(1)
    for room in sorted(path.name for path in root.iterdir() if path.is_dir()):
        if room in NO_ROOMS or room.startswith(".") or not sources(root, room):
            continue
        if not re.search(tidied, f"/{room}/dsdpv1/"):
            yield f"{room}: HeaderFilterRegex of .clang-tidy leaves it out"
        if room not in GENERAL_ROOMS + CHIP_ROOMS:
            yield f"{room}: neither in GENERAL_ROOMS nor in CHIP_ROOMS of tests/docs/rooms.py"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    root = parser.parse_args().root
    found = [*faults(root, FORBIDDEN), *names_no_chip_any_more(root), *unknown_rooms(root)]
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
