#!/usr/bin/env python3
"""The examples in docs/captures.md match the output of tshark and dsdpv1-sim.

    docs_example.py SIM [update]
"""
import pathlib
import re
import shlex
import sys
import tempfile

from wireshark import ROOT, capture, sim, tshark

PAGE = ROOT / "docs/captures.md"
# A block of output after its command; "..." replaces omitted lines.
SHOWN = re.compile(r"(<!-- printed by (.*?) -->\n```\n)(.*?)(```)", re.S)


def printed(folder, packets, command):
    program, *arguments = shlex.split(command)
    if program == "tshark":
        return tshark(folder, packets, *arguments)
    return sim(folder, *arguments, status=None).stdout


def shortened(text, lines=24):
    rows = [line.rstrip() for line in text.splitlines()]
    return "\n".join(rows if len(rows) <= lines else [*rows[:lines - 1], "..."]) + "\n"


def main():
    with tempfile.TemporaryDirectory(prefix="dsdpv1_captures_") as name:
        folder = pathlib.Path(name)
        packets, _ = capture(folder, ROOT / "scenarios/dpv1_c1.yaml")
        text = PAGE.read_text(encoding="utf-8")
        made = SHOWN.sub(lambda shown: shown[1] + shortened(printed(folder, packets, shown[2])) + shown[4], text)
    if sys.argv[2:] == ["update"]:
        PAGE.write_text(made, encoding="utf-8")
    elif made != text or not SHOWN.search(text):
        print(f"docs/captures.md does not show what is printed now, which is\n{made}\n./run generate writes it")
        return 1
    return 0


sys.exit(main())
