#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Compares the constraints (*.sdc) with the RTL, as Yosys reads it: each name is there, the clocks are those that Yosys finds, every crossing of clocks
has a line, and every exception a reason ahead of it. With TOP and the netlist that synth_ice40 has written, also its clocks and their edges."""
import argparse
import fnmatch
import json
import pathlib
import re
import sys

from crossings import RTL, TOPS, Design, netlist

EXCEPTIONS = ("set_false_path", "set_max_delay")
HALF_CYCLE = ("u_host_port.d_q", "u_host_port.driven_q")  # registers of CLK's falling edge
NAMES = re.compile(r"\[get_(\w+) (?:\{([^}]*)\}|\[list ([^\]]*)\]|([^\]\s]+))\]")


class Line:
    """A command of an SDC file."""

    def __init__(self, where, text, reason):
        self.where, self.text, self.reason = where, text, reason
        self.command = text.split()[0]

    def names(self, option=""):
        """(kind, pattern) of what stands after an option, or of everything named."""
        text = self.text
        if option:
            found = re.search(rf"{option} {NAMES.pattern}", text)
            text = found[0] if found else ""
        return [(kind, pattern.replace("${h}", ".")) for kind, *lists in NAMES.findall(text) for pattern in "".join(lists).split()]

    def covers(self, signal, target, taker):
        """True where this constrains the crossing of a signal to a register or pin."""
        register = taker.split(" ")[-1]
        if self.command == "set_input_delay":
            return f"-clock {target} " in self.text and fits(signal, self.names())
        if self.command not in EXCEPTIONS or " -hold " in self.text:
            return False
        return all(fits(name, self.names(option)) for name, option in ((signal, "-from"), (register, "-to")) if option in self.text)


def fits(name, patterns):
    return any(fnmatch.fnmatchcase(name, pattern) or fnmatch.fnmatchcase(name + "[0]", pattern) for _, pattern in patterns)


def read(top):
    """The commands of a top's file, and of the file that comes first."""
    reason, lines = False, read("dsdpv1") if top == "dsdpv1_rsu" else []
    for number, text in enumerate((RTL / f"{top}.sdc").read_text(encoding="utf-8").splitlines(), 1):
        if re.match(r"(create|set)_", text):
            lines.append(Line(f"{top}.sdc:{number}", text, reason))
        reason = text.startswith("#") and not text.startswith("# ----")
    return lines


def faults(top, lines, design, ports):
    known = {"cells": {name for name, _ in design.registers.values()} | {name for name, *_ in design.takers},
             "ports": ports, "nets": set(design.names.values())}
    for line in lines:
        for kind, pattern in line.names():
            if not any(fits(name, [(kind, pattern)]) for name in known[kind]):
                yield f"{line.where}: {top} has no {pattern}"
        if line.command in EXCEPTIONS and not line.reason:
            yield f"{line.where}: no reason in the line before it"
    said = {re.search(r"-name (\w+)", line.text)[1] for line in lines if line.command == "create_clock"}
    found = {clock for _, clock, _, _ in design.takers}
    if said != found:
        yield f"{top}.sdc: clocks {', '.join(sorted(said))}; Yosys finds {', '.join(sorted(found))}"
    for (signal, source, target), takers in sorted(design.crossings.items()):
        for taker in sorted(takers):
            if not any(line.covers(signal, target, taker) for line in lines):
                yield f"{top}.sdc: nothing is said of {signal} from {source} to {target}, taken by {taker}"


def netlist_faults(top, lines, module):
    """Clocks of the iCE40's registers and RAMs, and the registers of the falling edge."""
    names = {}
    for name, net in sorted(module["netnames"].items(), key=lambda item: (not item[0].endswith("_q"), item[0])):
        for bit in net["bits"]:
            names.setdefault(bit, set()).add(name)
    clocks, falling = set(), set()
    for cell in module["cells"].values():
        for pin, bits in cell["connections"].items():
            if pin in ("C", "RCLK", "WCLK") and re.match(r"SB_(DFF|RAM)", cell["type"]) and isinstance(bits[0], int):
                clocks.add(bits[0])
        if cell["type"].startswith("SB_DFFN"):
            falling |= names[cell["connections"]["Q"][0]]
    said = [line.names()[0][1] for line in lines if line.command == "create_clock"]
    for clock in clocks:
        if not names[clock] & set(said):
            yield f"{top}: the netlist has the clock {min(names[clock], key=len)}; {top}.sdc has not"
    if len(clocks) != len(said):
        yield f"{top}: the netlist has {len(clocks)} clocks; {top}.sdc has {len(said)}"
    yield from (f"{top}: {name} is not at CLK's falling edge in the netlist" for name in HALF_CYCLE if name not in falling)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("top", nargs="?", choices=TOPS)
    parser.add_argument("netlist", nargs="?", type=pathlib.Path)
    arguments = parser.parse_args()
    found = []
    for top in [arguments.top] if arguments.top else TOPS:
        lines = read(top)
        if arguments.netlist:
            found += netlist_faults(top, lines, json.loads(arguments.netlist.read_text(encoding="utf-8"))["modules"][top])
        else:
            module = netlist(top, RTL)
            found += faults(top, lines, Design(module), set(module["ports"]))
    sys.exit("\n".join(found) or 0)


if __name__ == "__main__":
    main()
