#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Writes the constants of the DPRAM and docs/registers.md from dsdpv1.rdl.

    generate.py           writes the files
    generate.py --check   exit 1, and one line for each file that is not what it should be
"""
import argparse
import os
import sys
from dataclasses import dataclass, field
from pathlib import Path

from systemrdl import RDLCompileError, RDLCompiler
from systemrdl.node import RegfileNode

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "registers" / "dsdpv1.rdl"
# REUSE-IgnoreStart
LICENCE = ("SPDX-FileCopyrightText: 2026 the dsdpv1 authors", "SPDX-License-Identifier: Apache-2.0 OR MIT")
# REUSE-IgnoreEnd
ORIGIN = "Generated from registers/dsdpv1.rdl by registers/generate.py. Do not edit."


def licence(comment):
    """The first lines of a file that is copied alone."""
    return [comment.format(text) for text in LICENCE]


# ------------------------------------------------------------------------------------------------- what the map says
@dataclass
class Enumeration:
    name: str
    members: list  # (name, value, description)


@dataclass
class Field:
    name: str
    text: str
    low: int
    width: int
    set_by: str
    encode: Enumeration
    only: str  # "rsu": cells and bits that only the DSDPV1-RSU has

    @property
    def mask(self):
        return ((1 << self.width) - 1) << self.low

    @property
    def bits(self):
        return str(self.low) if self.width == 1 else f"{self.low + self.width - 1}..{self.low}"


@dataclass
class Cell:
    """A byte, a word (high byte first), or an array of bytes."""

    key: str  # snake case name of the constant, without prefix
    path: str  # instance path
    title: str
    text: str
    address: int
    size: int  # bytes altogether
    count: int  # elements, 0 when it is not an array
    chip: str  # "R", "W", "R/W" or "-"
    user: str
    reset: int
    limit: int
    fields: list
    encode: Enumeration  # of the whole byte
    only: str

    @property
    def last(self):
        return self.address + self.size - 1

    @property
    def reserved(self):
        return self.chip == "-"


@dataclass
class Area:
    """Bytes that are announced and checked together. key is empty for the loose bytes at the front and between areas."""

    key: str
    title: str
    text: str
    crc_covers: str
    address: int
    size: int  # without the CRC
    cells: list = field(default_factory=list)


def access_text(readable, writable):
    return "/".join(letter for letter, given in (("R", readable), ("W", writable)) if given) or "-"


def read_enumeration(node):
    encode = node.get_property("encode")
    if encode is None:
        return None
    return Enumeration(encode.type_name, [(m.name, m.value, m.rdl_desc) for m in encode])


def read_fields(reg):
    """The named bits of a register; none when one field is the whole of it."""
    fields = list(reg.fields())
    if len(fields) == 1 and fields[0].width == reg.get_property("regwidth"):
        return []
    return [
        Field(f.inst_name, f.get_property("desc", default=""), f.low, f.width, f.get_property("set_by"), read_enumeration(f), f.get_property("only"))
        for f in fields
    ]


def read_cell(reg, prefix):
    fields = list(reg.fields())
    path = reg.get_path(hier_separator=".", array_suffix="", empty_array_suffix="").split(".", 1)[1]
    named = read_fields(reg)
    count = reg.array_dimensions[0] if reg.is_array else 0
    return Cell(
        key=reg.get_property("constant") or prefix + reg.inst_name,
        path=path,
        title=reg.get_property("name"),
        text=reg.get_property("desc", default=""),
        address=reg.raw_absolute_address,
        size=reg.total_size,
        count=count,
        chip=access_text(any(f.is_hw_readable for f in fields), any(f.is_hw_writable for f in fields)),
        user=access_text(any(f.is_sw_readable for f in fields), any(f.is_sw_writable for f in fields)),
        reset=sum((f.get_property("reset") or 0) << f.low for f in fields),
        limit=reg.get_property("limit"),
        fields=named,
        encode=None if named else read_enumeration(fields[0]),
        only=reg.get_property("only"),
    )


def read_area(node):
    cells = [read_cell(reg, node.inst_name + "_") for reg in node.registers(unroll=False)]
    return Area(
        key=node.inst_name,
        title=node.get_property("name"),
        text=node.get_property("desc", default=""),
        crc_covers=node.get_property("crc_covers"),
        address=node.raw_absolute_address,
        size=cells[-1].address - node.raw_absolute_address,
        cells=cells,
    )


def read_map(source):
    """The areas of the DPRAM in order of their addresses; together they name every byte once."""
    compiler = RDLCompiler()
    compiler.compile_file(str(source))
    top = compiler.elaborate().top
    areas = []
    for node in sorted(top.children(unroll=False), key=lambda child: child.raw_absolute_address):
        if isinstance(node, RegfileNode):
            areas.append(read_area(node))
            continue
        if not areas or areas[-1].key:
            title = "Reserved" if areas else "Status and command bytes"
            areas.append(Area("", title, "", "", node.raw_absolute_address, 0))
        areas[-1].cells.append(read_cell(node, ""))
    return areas


def all_cells(areas):
    return [cell for area in areas for cell in area.cells]


def all_enumerations(areas):
    found = {}
    for cell in all_cells(areas):
        for encode in [cell.encode] + [f.encode for f in cell.fields]:
            if encode:
                found.setdefault(encode.name, encode)
    return list(found.values())


# ------------------------------------------------------------------------------------------------------- the constants
@dataclass
class Constant:
    key: str
    kind: str  # a key of CPP_TYPES
    value: int
    text: str


def cell_constants(cell):
    yield Constant(cell.key, "address", cell.address, cell.title)
    if cell.count:
        yield Constant(cell.key + "_size", "size", cell.count, "bytes")
    if cell.limit is not None:
        yield Constant(cell.key + "_limit", "limit", cell.limit, "largest value accepted")
    if cell.reset:
        yield Constant(cell.key + "_reset", "value", cell.reset, "value after reset")
    for f in cell.fields:
        yield Constant(f"{cell.key}_{f.name}", "mask", f.mask, f.text)
        if f.width > 1:
            yield Constant(f"{cell.key}_{f.name}_shift", "shift", f.low, "lowest bit")


def area_constants(area):
    if area.key:
        yield Constant(area.key, "address", area.address, "first byte")
        yield Constant(area.key + "_size", "size", area.size, "bytes, without the CRC")
    for cell in area.cells:
        if not cell.reserved:
            yield from cell_constants(cell)


def enumeration_constants(encode):
    for name, value, text in encode.members:
        yield Constant(f"{encode.name}_{name}", "value", value, text)


def constant_groups(areas):
    """(heading, constants) in the order of the addresses, the values of the enumerations last."""
    size = Constant("dpram_size", "size", max(cell.last for cell in all_cells(areas)) + 1, "bytes")
    groups = [("DPRAM", [size])]
    groups += [(area.title, list(area_constants(area))) for area in areas]
    groups += [("Values of " + e.name, list(enumeration_constants(e))) for e in all_enumerations(areas)]
    return [(heading, constants) for heading, constants in groups if constants]


def verify(areas):
    """The map names each address once, and each constant has a unique name."""
    expected = 0
    for cell in all_cells(areas):
        if cell.address != expected:
            raise SystemExit(f"{SOURCE.name}: {cell.path} is at 0x{cell.address:03X}, expected 0x{expected:03X}: no gap")
        expected = cell.last + 1
        for f in cell.fields:
            if f.set_by not in (None, "chip", "user"):
                raise SystemExit(f'{SOURCE.name}: {cell.path}.{f.name}: set_by is "{f.set_by}", expected chip and user')
    seen = set()
    for _, constants in constant_groups(areas):
        for constant in constants:
            if constant.key in seen:
                raise SystemExit(f"{SOURCE.name}: two constants are called {constant.key}")
            seen.add(constant.key)


# ------------------------------------------------------------------------------------------------------------- writers
DECIMAL = ("size", "shift", "limit")


def camel(key):
    return "".join(word[:1].upper() + word[1:] for word in key.split("_"))


def hexadecimal(constant):
    if constant.kind in DECIMAL:
        return str(constant.value)
    return f"0x{constant.value:0{3 if constant.kind == 'address' else 2}X}"


def render_groups(areas, line):
    """The constants as lines; line(constant) gives the code, its comment follows it."""
    lines = []
    for heading, constants in constant_groups(areas):
        lines += ["", f"// {heading}"]
        for constant in constants:
            lines.append(line(constant) + (f"  // {constant.text}" if constant.text else ""))
    return lines


CPP_TYPES = {
    "address": "Address",
    "size": "std::uint16_t",
    "mask": "std::uint8_t",
    "shift": "int",
    "value": "std::uint8_t",
    "limit": "std::uint8_t",
}

CPP_HEAD = f"""// {ORIGIN}
#pragma once
// Addresses, bits and values of the DPRAM. A word (CRC, count) is at its high byte, the low byte follows.
#include <cstdint>

// clang-format off
namespace dsdpv1::regs {{

using Address = std::uint16_t;  ///< 0x000..0x7FF

/// A part of the DPRAM and its writers (ruling P6); without a writer if only some modes of the DSDPV1-RSU have it.
struct Cell {{
  Address first;
  Address last;
  bool chip_writes;
  bool user_writes;
  const char* name;
}};"""


def cpp_cell(cell):
    chip, user = (str("W" in access and not cell.only).lower() for access in (cell.chip, cell.user))
    return f'    {{0x{cell.address:03X}, 0x{cell.last:03X}, {chip}, {user}, "{cell.path}"}},'


def render_cpp(areas):
    def line(constant):
        return f"inline constexpr {CPP_TYPES[constant.kind]} k{camel(constant.key)} = {hexadecimal(constant)};"

    table = ["", "/// Every address once, ascending, without a gap.", "inline constexpr Cell kMap[] = {"]
    table += [cpp_cell(cell) for cell in all_cells(areas)]
    table += ["};", "", "}  // namespace dsdpv1::regs", "// clang-format on"]
    return "\n".join([CPP_HEAD] + render_groups(areas, line) + table) + "\n"


def render_c(areas):
    def line(constant):
        return f"#define DSDPV1_REG_{constant.key.upper()} {hexadecimal(constant)}U"

    head = [
        *licence("/* {} */"),
        f"/* {ORIGIN} */",
        "/* Addresses, bits and values of the DPRAM. A word (CRC, count) is at its high byte, the low byte follows. */",
        "#ifndef DSDPV1_REGS_H",
        "#define DSDPV1_REGS_H",
        "/* clang-format off */",
    ]
    return "\n".join(head + render_groups(areas, line) + ["", "#endif"]) + "\n"


SV_WIDTHS = {"address": 11, "size": 12, "mask": 8, "shift": 3, "value": 8, "limit": 8}


def render_sv(areas):
    def line(constant):
        width = SV_WIDTHS[constant.kind]
        number = f"d{constant.value}" if constant.kind in DECIMAL else f"h{constant.value:X}"
        return f"localparam logic [{width - 1}:0] DSDPV1_REG_{constant.key.upper()} = {width}'{number};"

    head = [
        *licence("// {}"),
        f"// {ORIGIN}",
        "// Addresses, bits and values of the DPRAM. A word (CRC, count) is at its high byte, the low byte follows.",
        "`ifndef DSDPV1_REGS_SVH",
        "`define DSDPV1_REGS_SVH",
        "/* verilator lint_off UNUSED */",
    ]
    return "\n".join(head + render_groups(areas, line) + ["", "/* verilator lint_on UNUSED */", "`endif"]) + "\n"


def table(header, rows):
    return ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)] + ["| " + " | ".join(row) + " |" for row in rows]


def address_range(cell):
    return f"`0x{cell.address:03X}`" if cell.size == 1 else f"`0x{cell.address:03X}`..`0x{cell.last:03X}`"


def cell_meaning(cell):
    parts = [cell.title + ("." if cell.text else ""), cell.text]
    if cell.limit is not None:
        parts.append(f"At most {cell.limit}.")
    return " ".join(part for part in parts if part)


def chips(part):
    """The chips that have the cell or bits."""
    return {None: "all", "rsu": "-RSU"}[part.only]


def cell_row(cell):
    constant = "" if cell.reserved else f"`k{camel(cell.key)}`"
    reset = f"0x{cell.reset:02X}" if cell.reset else "0"
    return [address_range(cell), constant, chips(cell), cell.chip, cell.user, reset, cell_meaning(cell)]


def field_row(cell, f):
    meaning = f.text
    if f.set_by:
        other = {"chip": "user", "user": "chip"}[f.set_by]
        meaning += f" The {f.set_by} sets it, the {other} clears it."
    if f.encode:
        meaning += f" Values: [{f.encode.name}](#{f.encode.name})."
    return [f.bits, f"`k{camel(cell.key + '_' + f.name)}`", f"`0x{f.mask:02X}`", chips(f), meaning]


def render_cell_bits(cell):
    lines = ["", f"### B{cell.address:03X}: {cell.title[:1].lower() + cell.title[1:]}", "", cell.text, ""]
    lines += table(["bits", "constant", "mask", "chips", "meaning"], [field_row(cell, f) for f in cell.fields])
    return lines + ["", "Bits that are not listed are reserved."]


def render_area(area):
    lines = ["", f"## {area.title}"]
    if area.key:
        lines += ["", f"{area.text} `k{camel(area.key)}` = `0x{area.address:03X}`, {area.size} bytes and the CRC."]
        lines += [f"The CRC covers: {area.crc_covers}"]
    lines += [""] + table(["address", "constant", "chips", "chip", "user", "reset", "meaning"], [cell_row(c) for c in area.cells])
    for cell in area.cells:
        if cell.fields:
            lines += render_cell_bits(cell)
        if cell.encode:
            lines += ["", f"Values of B{cell.address:03X}: [{cell.encode.name}](#{cell.encode.name})."]
    return lines


def render_enumeration(encode):
    rows = [[f"`0x{value:02X}`", f"`k{camel(encode.name + '_' + name)}`", text] for name, value, text in encode.members]
    return ["", f"### {encode.name}", ""] + table(["value", "constant", "meaning"], rows)


DOC_HEAD = f"""<!-- {ORIGIN} -->
# Registers

The DPRAM between the chip and the user CPU: every address from 0x000 to 0x7FF. "B010.2" is bit 2 of the byte at 0x010. The columns
"chip" and "user" show who reads (R) and writes (W); the memory itself does not enforce it (ruling P6). Words (CRC, count) have their
high byte first. The column "chips" names the chips that have it: all, or only the DSDPV1-RSU, whose B014 to B01F are plain RAM in the modes
that do not use them ([chip_rsu.md](chip_rsu.md)). The constants are those of `registers/dsdpv1_regs.hpp` (namespace `dsdpv1::regs`); in `registers/dsdpv1_regs.h` and
`registers/dsdpv1_regs.svh` `kUserCommand1Init` is called `DSDPV1_REG_USER_COMMAND_1_INIT`. A field of several bits also has `k...Shift`,
the number of its lowest bit; an array `k...Size`, its number of bytes; a byte with a largest value `k...Limit`; one that is not zero
after reset `k...Reset`. Rulings are those of [chip.md](chip.md) and [chip_rsu.md](chip_rsu.md), tables those of the datasheet."""


def render_doc(areas):
    lines = [DOC_HEAD]
    for area in areas:
        lines += render_area(area)
    lines += ["", "## Values"]
    for encode in all_enumerations(areas):
        lines += render_enumeration(encode)
    return "\n".join(lines) + "\n"


# ---------------------------------------------------------------------------------------------------------------- main
def outputs(areas):
    return {
        ROOT / "registers" / "dsdpv1_regs.hpp": render_cpp(areas),
        ROOT / "registers" / "dsdpv1_regs.h": render_c(areas),
        ROOT / "registers" / "dsdpv1_regs.svh": render_sv(areas),
        ROOT / "docs" / "registers.md": render_doc(areas),
    }


def is_current(path, text):
    return path.exists() and path.read_text(encoding="utf-8") == text


def write(path, text):
    unfinished = path.with_name(path.name + ".new")
    unfinished.write_text(text, encoding="utf-8")
    os.replace(unfinished, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 when a file is stale")
    check = parser.parse_args().check
    try:
        areas = read_map(SOURCE)
    except RDLCompileError:
        return 2  # the compiler has reported place and reason
    verify(areas)
    stale = {path: text for path, text in outputs(areas).items() if not is_current(path, text)}
    for path, text in stale.items():
        if check:
            print(f"{path.relative_to(ROOT)}: stale, run registers/generate.py")
        else:
            write(path, text)
            print(f"{path.relative_to(ROOT)}: written")
    return 1 if check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
