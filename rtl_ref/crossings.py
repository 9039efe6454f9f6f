#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Signals of the reference RTL that cross from one clock to another, found in the source by Yosys and compared with the table in docs/rtl.md.

A crossing is a register or an input pin from which combinational logic leads to a register of another clock: to its data, its
asynchronous reset or its clock; or from an input pin to an output pin. Each input is its own domain. Both edges of a clock are one domain.
"""
import argparse
import dataclasses
import fnmatch
import functools
import json
import pathlib
import re
import subprocess
import sys
import tempfile

RTL = pathlib.Path(__file__).resolve().parent
PAGE = RTL.parent / "docs" / "rtl.md"
TOPS = ("dsdpv1", "dsdpv1_rsu")
CLOCKS = {"clk_i": "CLK", "wr_i": "WR", "sck_i": "SCK", "u_host_port.reads": "reads"}
BITWISE = {"$mux", "$and", "$or", "$xor", "$xnor", "$not"}
SCRIPT = ("read_verilog -sv -I{rtl} -I{registers} {files}; hierarchy -check -top {top}; proc; flatten; opt_clean; memory_collect; opt_clean; "
          "write_json {json}")
ROW = re.compile(r"^\| `([^|`]*)` \| ([^|]*) to ([^|]*) \| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", re.M)
BEGIN, END = "<!-- crossings: begin -->", "<!-- crossings: end -->"
TWO = "two flip-flops"


def netlist(top, root):
    """The flattened module, as Yosys writes it."""
    names = (root / top / "files.txt").read_text(encoding="utf-8").split()
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "netlist.json"
        script = SCRIPT.format(rtl=root, registers=RTL.parent / "registers", files=" ".join(str(root / name) for name in names), top=top, json=output)
        subprocess.run(["yosys", "-q", "-p", script], check=True)
        return json.loads(output.read_text(encoding="utf-8"))["modules"][top]


def rank(name, hidden):
    """Sorts the names of a net: that of its register first (it ends in _q), then that nearest to the top."""
    return hidden, not name.endswith("_q"), name.count("."), name


class Design:
    """Registers, pins and the logic between them. A bit is an integer; constants are not bits."""

    def __init__(self, module):
        self.names = {}
        for name, net in sorted(module["netnames"].items(), key=lambda item: rank(item[0], item[1]["hide_name"])):
            for bit in net["bits"]:
                self.names.setdefault(bit, name)
        self.inputs, self.outputs = ({bit: name for name, port in module["ports"].items() if port["direction"] == way for bit in port["bits"]}
                                     for way in ("input", "output"))
        self.fanin = {}     # bit: the bits that its logic reads
        self.registers = {}  # bit of Q: (name, clock)
        self.takers = []     # name, clock, kind, bits that it reads
        for name, cell in module["cells"].items():
            self.add(name, cell, cell["connections"])

    def add(self, name, cell, wires):
        kind = cell["type"]
        if kind in ("$dff", "$adff"):
            register, clock = self.names[wires["Q"][0]], self.clock(wires["CLK"])
            self.registers.update({bit: (register, clock) for bit in wires["Q"]})
            self.takers.append((register, clock, "", wires["D"]))
            self.takers.append((register, clock, "reset of ", wires.get("ARST", [])))
            self.takers.append((register, clock, "clock of ", wires["CLK"] if clock not in ("CLK", "WR", "SCK") else []))
        elif kind == "$mem_v2":
            memory = re.sub(r"\\", "", cell["parameters"]["MEMID"])
            clock = self.clock(wires["WR_CLK"]) if wires["WR_CLK"] else None
            if clock:
                self.takers.append((memory, clock, "", wires["WR_ADDR"] + wires["WR_DATA"] + wires["WR_EN"]))
            source = [(memory, clock)] if clock else []
            self.fanin.update({bit: wires["RD_ADDR"] + source for bit in wires["RD_DATA"]})
        else:
            outputs = [port for port, way in cell["port_directions"].items() if way == "output"]
            if outputs != ["Y"] or kind.startswith(("$dff", "$adff", "$sdff", "$dlatch", "$aldff", "$sr", "$mem")):
                sys.exit(f"crossings.py: a cell {kind} is not expected ({name})")
            read = [bit for port, bits in wires.items() if port != "Y" for bit in bits]
            for index, bit in enumerate(wires["Y"]):
                self.fanin[bit] = self.same_bit(wires, index) if kind in BITWISE else read

    @staticmethod
    def same_bit(wires, index):
        return [bits[0] if port == "S" else bits[index] for port, bits in wires.items() if port != "Y" and (port == "S" or index < len(bits))]

    def clock(self, bits):
        names = {CLOCKS.get(self.names[bit], self.names[bit]) for bit in bits}
        if len(names) != 1:
            sys.exit(f"crossings.py: more than one clock: {sorted(names)}")
        return names.pop()

    def sources(self, bits):
        """Registers and pins that feed the logic of these bits: pairs of name and domain."""
        found, seen, left = set(), set(), list(bits)
        while left:
            bit = left.pop()
            if isinstance(bit, tuple):
                found.add(bit)
            elif bit in self.registers:
                found.add(self.registers[bit])
            elif bit in self.inputs:
                found.add((self.inputs[bit], "pin"))
            elif isinstance(bit, int) and bit not in seen:
                seen.add(bit)
                left += self.fanin.get(bit, [])
        return found

    @functools.cached_property
    def crossings(self):
        """Those of the design: {(signal, domain it comes from, domain it goes to): names of what takes it}."""
        found = {}
        for register, clock, kind, bits in self.takers:
            for source, domain in self.sources(bits):
                if domain != clock:
                    found.setdefault((source, domain, clock), set()).add(kind + register)
        for bit, name in self.outputs.items():
            for source, domain in self.sources([bit]):
                if domain == "pin":
                    found.setdefault((source, domain, "pin"), set()).add(name)
        return found


    def readers(self, register):
        """Names of the registers and pins that logic leads to from this one."""
        return sorted(self.readers_of_all.get(register, ()))

    @functools.cached_property
    def readers_of_all(self):
        found = {}
        for name, bits in [(name, bits) for name, _, _, bits in self.takers] + [(name, [bit]) for bit, name in self.outputs.items()]:
            for source, _ in self.sources(bits):
                found.setdefault(source, set()).add(name)
        return found


@dataclasses.dataclass(frozen=True)
class Row:
    """A row of the table. Names are patterns of a shell."""
    signals: str
    source: str
    target: str
    takers: tuple
    means: str

    def covers(self, crossing):
        signal, source, target = crossing
        return any(fnmatch.fnmatchcase(signal, each) for each in self.signals.split(", ")) and (source, target) == (self.source, self.target)

    def title(self):
        return f"{self.signals} from {self.source} to {self.target}"


def table(page):
    """The rows between the markers of the page."""
    text = page.read_text(encoding="utf-8").split(BEGIN)[1].split(END)[0]
    rows = [Row(signals, source, target, tuple(re.findall(r"(?:clock of |reset of )?[^ `,][^`,]*", takers.replace("`", ""))), means)
            for signals, source, target, takers, means, _ in ROW.findall(text)]
    if len(rows) != text.count("\n|") - 2:
        sys.exit(f"{page.name}: {text.count(chr(10) + '|') - 2 - len(rows)} rows of the crossings have not six columns")
    return rows


def faults(designs, rows):
    """Differences between the designs and the table, and first flip-flops of a synchroniser that more than one reads."""
    used = set()
    for top, design in designs.items():
        for crossing, takers in sorted(design.crossings.items()):
            row = next((each for each in rows if each.covers(crossing)), None)
            if row is None:
                yield f"{top}: {crossing[0]} crosses from {crossing[1]} to {crossing[2]}, taken by {', '.join(sorted(takers))}; the table does not have it"
                continue
            used.add(row)
            for taker in sorted(takers):
                matching = [each for each in row.takers if fnmatch.fnmatchcase(taker, each)]
                used.update((row, each) for each in matching)
                if not matching:
                    yield f"{top}: {row.title()} is taken by {taker}, too; the table does not have it"
                register = taker.split(" ")[-1]
                if TWO in row.means and len(design.readers(register)) != 1:
                    yield f"{top}: {register} is the first of {TWO} and is read by {', '.join(design.readers(register))}"
    for row in rows:
        if row not in used:
            yield f"the table has {row.title()}; the RTL has not"
        yield from (f"the table has {row.title()} taken by {each}; the RTL has not" for each in row.takers if row in used and (row, each) not in used)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, default=RTL, help="folder of the RTL")
    parser.add_argument("--page", type=pathlib.Path, default=PAGE, help="page with the table")
    parser.add_argument("--list", action="store_true", help="print the crossings of the RTL instead")
    arguments = parser.parse_args()
    designs = {top: Design(netlist(top, arguments.root)) for top in TOPS}
    if arguments.list:
        for top, design in designs.items():
            for (signal, source, target), takers in sorted(design.crossings.items()):
                print(f"{top}: {signal} | {source} to {target} | {', '.join(sorted(takers))}")
        return 0
    found = list(faults(designs, table(arguments.page)))
    print("\n".join(found) if found else f"{sum(len(design.crossings) for design in designs.values())} crossings of {len(TOPS)} tops, all in the table")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
