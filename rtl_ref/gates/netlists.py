# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Netlists of the tops with Yosys, the top around one that a harness gets, and twins with an inverted cell."""
import json
import pathlib
import re
import shutil


class Failed(Exception):
    """Not as it must be; the text is one line, and what was said."""


RTL = pathlib.Path(__file__).resolve().parents[1]
RESETS = RTL / "gates" / "ice40_resets.v"
SOURCES = (pathlib.Path(__file__).resolve(), RESETS)  # of what own_rtl makes of a netlist
CELLS = ("generic", "ice40")
CELLS_MACRO = "NO_ICE40_DEFAULT_ASSIGNMENTS"  # of cells_sim.v: Verilator takes no default of an input

# As `synth -flatten`, but memories do not become flip-flops: they stay memories, as those of a compiler of RAMs.
GENERIC = """synth -flatten -top {top} -run begin:fine
opt -fast -full
opt -undriven -fine
techmap
opt -fast
abc -fast
opt -fast
hierarchy -check
check -assert"""
ICE40 = """synth_ice40 {option} -top {top}
check -assert"""
OPTION = {"dsdpv1": "", "dsdpv1_rsu": "-abc9"}  # as in synth.sh

# The windows of random cases: docs/rtl.md, Gates
SHORT = {"search_window_ms": 1, "search_window_bits": 150, "baud_control_ms": 2}
SHORT_OF_RSU = {"u_timer": 20_000}

# The flip-flop that a twin inverts: its register, which the first access, or the first reply over SPI, shows
INVERTED = {"dsdpv1": r"\u_handshake.u_r_req.second_q ", "dsdpv1_rsu": r"\u_serial_port.u_spi.u_shift.any_q "}


def short_windows(chip):
    return {**SHORT, **(SHORT_OF_RSU if chip == "dsdpv1_rsu" else {})}


def script(chip, cells, parameters):
    """The commands of Yosys except the last, which writes the netlist."""
    names = " ".join((RTL / chip / "files.txt").read_text(encoding="utf-8").split())
    values = " ".join(f"-chparam {name.upper()} {value}" for name, value in parameters.items())
    steps = {"generic": GENERIC, "ice40": ICE40}[cells].format(top=chip, option=OPTION[chip])
    return f"read_verilog -sv -I. -I../registers {names}\nhierarchy -check -top {chip} {values}\n{steps}\nrename {chip} netlist\n"


def synthesize(chip, cells, parameters, folder, call):
    """Writes folder/netlist.v. Returns the number of cells, and seconds of processor time."""
    (folder / "synth.ys").write_text(f"{script(chip, cells, parameters)}tee -q -o {folder}/cells.json stat -json\nwrite_verilog -noattr {folder}/netlist.v\n", encoding="utf-8")
    status, seconds = call(["yosys", "-Q", "-e", "implicitly declared", "-s", folder / "synth.ys"], folder / "yosys.log")
    if status != 0:
        raise Failed(f"yosys: see {folder}/yosys.log")
    return json.loads((folder / "cells.json").read_text(encoding="utf-8"))["design"]["num_cells"], seconds


def own_rtl(chip, cells, parameters, folder, twin):
    """The files that a harness gets for the netlist of this folder: netlist, its cells, the top `gates`, the map. A twin has an inverted cell."""
    netlist = (folder / "netlist.v").read_text(encoding="utf-8")
    files = {"gates.sv": top(netlist, parameters), "map.yaml": f"defines: {{{CELLS_MACRO}: 1}}\n{chip_map(parameters)}"}
    if cells == "ice40":
        files |= {"cells_sim.v": unknown_cells(), RESETS.name: RESETS.read_text(encoding="utf-8")}
    return {"netlist.v": inverted(netlist, chip) if twin else netlist, **files}


def unknown_cells():
    """The iCE40's simulation models without those of RESETS. Their flip-flops begin unknown: those of the device begin with 0, which hides a missing reset."""
    models = pathlib.Path(shutil.which("yosys")).resolve().parents[1] / "share/yosys/ice40/cells_sim.v"
    text, begins = re.subn(r"^`define SB_DFF_INIT initial Q = 0;$", "`define SB_DFF_INIT", models.read_text(encoding="utf-8"), flags=re.M)
    text, resets = re.subn(r"^module SB_DFFN?E?[RS] .*?^endmodule$", "", text, flags=re.M | re.S)
    if (begins, resets) != (1, 8):
        raise Failed(f"{models} has {begins} SB_DFF_INIT and {resets} flip-flops with asynchronous reset, expected 1 and 8")
    return text


def top(netlist, parameters):
    """A top around the netlist, with the parameters that it was made for: others are refused when it is built."""
    header, body = re.search(r"^module netlist\((.*?)\);(.*?)^endmodule", netlist, re.M | re.S).groups()
    ports = re.split(r"\s*,\s*", header)
    found = {port[3]: port[1] + port[2] for port in re.finditer(r"^  (input|output)( \[\d+:0\]|) (\w+);", body, re.M)}
    declared = ", ".join(f"{found[name]} {name}" for name in ports)
    names = ", ".join(f"parameter integer {name.upper()} = {value}" for name, value in parameters.items())
    checks = "".join(f'  if ({name.upper()} != {value}) $error("the netlist was made for {name} {value}");\n' for name, value in parameters.items())
    wired = ", ".join(f".{name}({name})" for name in ports)
    return f"module gates {f'#({names}) ' if names else ''}({declared});\n{checks}  netlist u_netlist ({wired});\nendmodule\n"


def chip_map(parameters):
    return f"chip: {{{', '.join(f'{name}: {name.upper()}' for name in parameters)}}}\n" if parameters else ""


def inverted(netlist, chip):
    """With the inverse of what one flip-flop takes, in a netlist of generic cells or of the iCE40's."""
    register = re.escape(INVERTED[chip])
    twin, found = re.subn(rf"({register} *<= )([^;\n]*[^;\n0]);", r"\1~(\2);", netlist)
    if not found:
        twin, found = re.subn(rf"(SB_DFF\w* [^;]*?\.D\()([^\n]*)(\),\n(?:    \.[^\n]*\n)*?    \.Q\({register}\))", r"\1~(\2)\3", netlist)
    if found != 1:
        raise Failed(f"the netlist has {found} flip-flops {INVERTED[chip]}, expected one: netlists.py names another")
    return twin


def check_parameters(chip, used):
    """A netlist has the default parameters, and so must the golden."""
    text = (RTL / chip / f"{chip}.sv").read_text(encoding="utf-8")
    for name, value in re.findall(r"parameter integer (\w+) = (\d+)", text):
        here = {"letter": "0", "content": "1"}.get(used[name.lower()], used[name.lower()])
        if here != value:
            raise Failed(f"the golden has {name.lower()} {here}, the top {value}")
