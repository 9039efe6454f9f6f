#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""The tops of rtl_ref/ have the parameters and pins of the model's rows: names, defaults, widths, directions; docs/rtl.md their ranges."""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PARAMETER = re.compile(r'^DSDPV1_(PARAMETER|RSU_PARAMETER|RSU_LIST)\((\w+), \(?([\d, ]+)\)?, (\d+), (\d+), ', re.MULTILINE)
PIN = re.compile(r'^DSDPV1_(PIN|BUS|RSU_PIN)\(\w+, "(\w+)", (\d+), k(In|Out)put, (\w+), "\w+", \d+, (\w+)\)', re.MULTILINE)
PORT = re.compile(r"^  (input|output) +logic +(?:\[(\d+):0\] +)?(\w+),?(?: *//.*)?$", re.MULTILINE)


def read(name):
    return (ROOT / name).read_text(encoding="utf-8")


def parameters(rsu):
    return [row for row in PARAMETER.findall(read("model/dsdpv1/parameters.inc")) if rsu or row[0] == "PARAMETER"]


def ports_of_pins(rsu):
    """(direction, highest bit, name), as in table 1 and R2; D and releasable pins have a side for each direction."""
    for kind, _, width, direction, level, name in PIN.findall(read("model/dsdpv1/pins.inc")):
        if kind != "RSU_PIN" or rsu:
            yield direction.lower() + "put", "" if width == "1" else str(int(width) - 1), name + ("_i" if direction == "In" else "_o")
            if level == "kLevelZ" and direction == "Out":
                yield "output", "", name + "_oe_o"


class Tops(unittest.TestCase):
    def test_have_the_parameters(self):
        for top in ("dsdpv1", "dsdpv1_rsu"):
            source, rows = re.sub("//.*", "", read(f"rtl_ref/{top}/{top}.sv")), parameters(top == "dsdpv1_rsu")
            found = re.findall(r"^  parameter (?:integer|logic \[127:0\]) (\w+) = (\d+|{[^}]*})", source, re.MULTILINE)
            defaults = {name: ", ".join(reversed(re.findall(r"16'd(\d+)", value))) or value for name, value in found}
            self.assertEqual(defaults, {name.upper(): initial for _, name, initial, _, _ in rows}, top)
            for _, name, *_ in rows:
                self.assertIn(f"assign {name} = `LIMIT({name.upper()}, {name}_i);", source)

    def test_have_the_inputs_and_pins(self):
        for top in ("dsdpv1", "dsdpv1_rsu"):
            rsu = top == "dsdpv1_rsu"
            inputs = {("input", "127" if kind == "RSU_LIST" else "31", name + "_i") for kind, name, *_ in parameters(rsu)}
            expected = inputs | set(ports_of_pins(rsu)) | {("input", "", "clk_i")}
            self.assertEqual(set(PORT.findall(read(f"rtl_ref/{top}/{top}.sv"))), expected, top)

    def test_have_their_ranges_in_the_page(self):
        lines = [line for line in read("docs/rtl.md").splitlines() if line.startswith("| `")]
        for _, name, _, least, most in parameters(rsu=True):
            (line,) = [line for line in lines if f"`{name}_i`" in line]
            values = re.findall(r"\d+", re.sub(r"(?<=\d) (?=\d{3})", "", line.split("|")[-2]))
            self.assertEqual((values[0], values[-1]), (least, most), line)


if __name__ == "__main__":
    sys.exit(unittest.main())
