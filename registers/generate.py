#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Writes the constants and the page of each map of registers: dsdpv1.rdl, spc3.rdl.

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
# REUSE-IgnoreStart
LICENCE = ("SPDX-FileCopyrightText: 2026 the dsdpv1 authors", "SPDX-License-Identifier: Apache-2.0 OR MIT")
# REUSE-IgnoreEnd


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
    only: str  # the chips that have it, None: all

    @property
    def mask(self):
        return ((1 << self.width) - 1) << self.low

    @property
    def bits(self):
        return str(self.low) if self.width == 1 else f"{self.low + self.width - 1}..{self.low}"


@dataclass
class Cell:
    """A byte, a word, or an array of bytes. One that is read and one that is written may have the same address."""

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
    bits: str  # key of the bits, when other cells have the same
    heading: str  # of the part that begins here
    command: bool  # a read acts

    @property
    def last(self):
        return self.address + self.size - 1

    @property
    def reserved(self):
        return self.chip == "-"

    @property
    def wide(self):
        return not self.count and self.size == 2

    @property
    def bits_key(self):
        return self.bits or self.key

    def shares_address_of(self, other):
        return (self.address, self.size, {self.user, other.user}) == (other.address, other.size, {"R", "W"})


@dataclass
class Area:
    """Bytes that are announced and checked together. key is empty for the loose bytes at the front and between areas."""

    key: str
    title: str
    text: str
    crc_covers: str  # None: no CRC
    address: int
    size: int  # without the CRC
    cells: list = field(default_factory=list)


@dataclass
class Map:
    """A source, and what its files say beside it."""

    name: str  # of the source, and of the files made from it
    namespace: str
    title: str  # of the memory
    memory: str  # key of its size
    block: str  # name in other tools' formats
    view: str  # their description of it
    high_first: bool  # words
    words: str
    members: dict  # of a cell in the C++ table, name to its value
    cell_text: str
    table_text: str
    headers: dict  # ending to writer
    page: str
    introduction: str
    byte: str  # what stands before an address in headings
    chips: dict  # only to text
    areas: list = field(default_factory=list)

    @property
    def source(self):
        return ROOT / "registers" / f"{self.name}.rdl"

    @property
    def origin(self):
        return f"Generated from registers/{self.name}.rdl by registers/generate.py. Do not edit."


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
        bits=reg.get_property("bits"),
        heading=reg.get_property("heading"),
        command=any(f.get_property("onread") for f in fields),
    )


def read_area(node):
    cells = [read_cell(reg, node.inst_name + "_") for reg in node.registers(unroll=False)]
    crc_covers = node.get_property("crc_covers")
    return Area(
        key=node.inst_name,
        title=node.get_property("name"),
        text=node.get_property("desc", default=""),
        crc_covers=crc_covers,
        address=node.raw_absolute_address,
        size=(cells[-1].address if crc_covers else cells[-1].last + 1) - node.raw_absolute_address,
        cells=cells,
    )


def read_map(source):
    """The areas in order of their addresses; together they name every byte once."""
    compiler = RDLCompiler()
    compiler.compile_file(str(source))
    top = compiler.elaborate().top
    areas = []
    for node in sorted(top.children(unroll=False), key=lambda child: child.raw_absolute_address):
        if isinstance(node, RegfileNode):
            areas.append(read_area(node))
            continue
        cell = read_cell(node, "")
        if not areas or areas[-1].key or cell.heading:
            areas.append(Area("", cell.heading or "Reserved", "", None, node.raw_absolute_address, 0))
        areas[-1].cells.append(cell)
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
    wide: bool = False  # of a word


def bit_constants(cell):
    for f in cell.fields:
        yield Constant(f"{cell.bits_key}_{f.name}", "mask", f.mask, f.text, cell.wide)
        if f.width > 1:
            yield Constant(f"{cell.bits_key}_{f.name}_shift", "shift", f.low, "lowest bit")


def cell_constants(cell):
    yield Constant(cell.key, "address", cell.address, cell.title)
    if cell.count:
        yield Constant(cell.key + "_size", "size", cell.count, "bytes")
    if cell.limit is not None:
        yield Constant(cell.key + "_limit", "limit", cell.limit, "largest value accepted")
    if cell.reset:
        yield Constant(cell.key + "_reset", "value", cell.reset, "value after reset", cell.wide)
    if not cell.bits:
        yield from bit_constants(cell)


def area_constants(area):
    if area.key:
        yield Constant(area.key, "address", area.address, "first byte")
        yield Constant(area.key + "_size", "size", area.size, "bytes, without the CRC" if area.crc_covers else "bytes")
    for cell in area.cells:
        if not cell.reserved:
            yield from cell_constants(cell)


def enumeration_constants(encode):
    for name, value, text in encode.members:
        yield Constant(f"{encode.name}_{name}", "value", value, text)


def shared_bits(areas):
    """The first cell with each set of bits that several have."""
    found = {}
    for cell in all_cells(areas):
        if cell.bits:
            found.setdefault(cell.bits, cell)
    return found


def constant_groups(regs):
    """(heading, constants) in the order of the addresses, the values of the enumerations last."""
    areas = regs.areas
    size = Constant(regs.memory, "size", max(cell.last for cell in all_cells(areas) if not cell.only) + 1, "bytes")
    groups = [(regs.title, [size])]
    groups += [(area.title, list(area_constants(area))) for area in areas]
    groups += [("Bits of " + bits, list(bit_constants(cell))) for bits, cell in shared_bits(areas).items()]
    groups += [("Values of " + e.name, list(enumeration_constants(e))) for e in all_enumerations(areas)]
    return [(heading, constants) for heading, constants in groups if constants]


def verify(regs):
    """The map names each address once, or once for reads and once for writes; and each constant has a unique name."""
    expected, before, source = 0, None, regs.source.name
    for cell in all_cells(regs.areas):
        if cell.address != expected and not (before and cell.shares_address_of(before)):
            raise SystemExit(f"{source}: {cell.path} is at 0x{cell.address:03X}, expected 0x{expected:03X}: no gap")
        expected, before = cell.last + 1, cell
        for f in cell.fields:
            if f.set_by not in (None, "chip", "user"):
                raise SystemExit(f'{source}: {cell.path}.{f.name}: set_by is "{f.set_by}", expected chip and user')
    seen = set()
    for _, constants in constant_groups(regs):
        for constant in constants:
            if constant.key in seen:
                raise SystemExit(f"{source}: two constants are called {constant.key}")
            seen.add(constant.key)


def load(regs):
    """The same with its areas."""
    regs.areas = read_map(regs.source)
    verify(regs)
    return regs


# ------------------------------------------------------------------------------------------------------------- writers
DECIMAL = ("size", "shift", "limit")


def camel(key):
    return "".join(word[:1].upper() + word[1:] for word in key.split("_"))


def hexadecimal(constant):
    if constant.kind in DECIMAL:
        return str(constant.value)
    digits = 3 if constant.kind == "address" else 4 if constant.wide else 2
    return f"0x{constant.value:0{digits}X}"


def render_groups(regs, line):
    """The constants as lines; line(constant) gives the code, its comment follows it."""
    lines = []
    for heading, constants in constant_groups(regs):
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

def cpp_head(regs):
    return [
        f"// {regs.origin}",
        "#pragma once",
        f"// Addresses, bits and values of the {regs.title}. {regs.words}",
        "#include <cstdint>",
        "",
        "// clang-format off",
        f"namespace {regs.namespace} {{",
        "",
        "using Address = std::uint16_t;  ///< 0x000..0x7FF",
        "",
        f"/// {regs.cell_text}",
        "struct Cell {",
        "  Address first;",
        "  Address last;",
        *(f"  bool {name};" for name in regs.members),
        "  const char* name;",
        "};",
    ]


def cpp_cell(regs, cell):
    values = ", ".join(str(value(cell)).lower() for value in regs.members.values())
    return f'    {{0x{cell.address:03X}, 0x{cell.last:03X}, {values}, "{cell.path}"}},'


def render_cpp(regs):
    def line(constant):
        kind = "std::uint16_t" if constant.wide else CPP_TYPES[constant.kind]
        return f"inline constexpr {kind} k{camel(constant.key)} = {hexadecimal(constant)};"

    table = ["", f"/// {regs.table_text}", "inline constexpr Cell kMap[] = {"]
    table += [cpp_cell(regs, cell) for cell in all_cells(regs.areas)]
    table += ["};", "", f"}}  // namespace {regs.namespace}", "// clang-format on"]
    return "\n".join(cpp_head(regs) + render_groups(regs, line) + table) + "\n"


def render_c(regs):
    name = regs.name.upper()

    def line(constant):
        return f"#define {name}_REG_{constant.key.upper()} {hexadecimal(constant)}U"

    head = [
        *licence("/* {} */"),
        f"/* {regs.origin} */",
        f"/* Addresses, bits and values of the {regs.title}. {regs.words} */",
        f"#ifndef {name}_REGS_H",
        f"#define {name}_REGS_H",
        "/* clang-format off */",
    ]
    return "\n".join(head + render_groups(regs, line) + ["", "#endif"]) + "\n"


SV_WIDTHS = {"address": 11, "size": 12, "mask": 8, "shift": 3, "value": 8, "limit": 8}


def render_sv(regs):
    name = regs.name.upper()

    def line(constant):
        width = SV_WIDTHS[constant.kind]
        number = f"d{constant.value}" if constant.kind in DECIMAL else f"h{constant.value:X}"
        return f"localparam logic [{width - 1}:0] {name}_REG_{constant.key.upper()} = {width}'{number};"

    head = [
        *licence("// {}"),
        f"// {regs.origin}",
        f"// Addresses, bits and values of the {regs.title}. {regs.words}",
        f"`ifndef {name}_REGS_SVH",
        f"`define {name}_REGS_SVH",
        "/* verilator lint_off UNUSED */",
    ]
    return "\n".join(head + render_groups(regs, line) + ["", "/* verilator lint_on UNUSED */", "`endif"]) + "\n"


def table(header, rows):
    return ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)] + ["| " + " | ".join(row) + " |" for row in rows]


def address_range(cell):
    return f"`0x{cell.address:03X}`" if cell.size == 1 else f"`0x{cell.address:03X}`..`0x{cell.last:03X}`"


def cell_meaning(cell):
    parts = [cell.title + ("." if cell.text else ""), cell.text]
    if cell.limit is not None:
        parts.append(f"At most {cell.limit}.")
    return " ".join(part for part in parts if part)


def cell_row(regs, cell):
    constant = "" if cell.reserved else f"`k{camel(cell.key)}`"
    reset = f"0x{cell.reset:02X}" if cell.reset else "0"
    user = cell.user + ", command" * cell.command
    return [address_range(cell), constant, regs.chips[cell.only], cell.chip, user, reset, cell_meaning(cell)]


def field_row(regs, cell, f):
    meaning = f.text
    if f.set_by:
        other = {"chip": "user", "user": "chip"}[f.set_by]
        meaning += f" The {f.set_by} sets it, the {other} clears it."
    if f.encode:
        meaning += f" Values: [{f.encode.name}](#{f.encode.name})."
    mask = f"`0x{f.mask:0{4 if cell.wide else 2}X}`"
    return [f.bits, f"`k{camel(cell.bits_key + '_' + f.name)}`", mask, regs.chips[f.only], meaning]


def render_cell_bits(regs, cell):
    first = shared_bits(regs.areas).get(cell.bits, cell)
    lines = ["", f"### {regs.byte}{cell.address:03X}: {cell.title[:1].lower() + cell.title[1:]}", "", cell.text, ""]
    if first is not cell:
        return lines + [f"Its bits are those of {regs.byte}{first.address:03X}."]
    lines += table(["bits", "constant", "mask", "chips", "meaning"], [field_row(regs, cell, f) for f in cell.fields])
    return lines + ["", "Bits that are not listed are reserved."]


def render_area(regs, area):
    lines = ["", f"## {area.title}"]
    if area.key:
        with_crc = " and the CRC" if area.crc_covers else ""
        lines += ["", f"{area.text} `k{camel(area.key)}` = `0x{area.address:03X}`, {area.size} bytes{with_crc}."]
    if area.crc_covers:
        lines += [f"The CRC covers: {area.crc_covers}"]
    lines += [""] + table(["address", "constant", "chips", "chip", "user", "reset", "meaning"], [cell_row(regs, c) for c in area.cells])
    for cell in area.cells:
        if cell.fields:
            lines += render_cell_bits(regs, cell)
        if cell.encode:
            lines += ["", f"Values of {regs.byte}{cell.address:03X}: [{cell.encode.name}](#{cell.encode.name})."]
    return lines


def render_enumeration(encode):
    rows = [[f"`0x{value:02X}`", f"`k{camel(encode.name + '_' + name)}`", text] for name, value, text in encode.members]
    return ["", f"### {encode.name}", ""] + table(["value", "constant", "meaning"], rows)


def render_doc(regs):
    lines = [f"<!-- {regs.origin} -->", regs.introduction]
    for area in regs.areas:
        lines += render_area(regs, area)
    lines += ["", "## Values"]
    for encode in all_enumerations(regs.areas):
        lines += render_enumeration(encode)
    return "\n".join(lines) + "\n"


# ------------------------------------------------------------------------------------------------------------ the maps
DSDPV1 = Map(
    name="dsdpv1",
    namespace="dsdpv1::regs",
    title="DPRAM",
    memory="dpram_size",
    block="dpram",
    view="The DPRAM as the user CPU sees it.",
    high_first=True,
    words="A word (CRC, count) is at its high byte, the low byte follows.",
    members={"chip_writes": lambda cell: "W" in cell.chip and not cell.only, "user_writes": lambda cell: "W" in cell.user and not cell.only},
    cell_text="A part of the DPRAM and its writers (ruling P6); without a writer if only some modes of the DSDPV1-RSU have it.",
    table_text="Every address once, ascending, without a gap.",
    headers={"hpp": render_cpp, "h": render_c, "svh": render_sv},
    page="registers.md",
    introduction="""# Registers

The DPRAM between the chip and the user CPU: every address from 0x000 to 0x7FF. "B010.2" is bit 2 of the byte at 0x010. The columns
"chip" and "user" show who reads (R) and writes (W); the memory itself does not enforce it (ruling P6). Words (CRC, count) have their
high byte first. The column "chips" names the chips that have it: all, or only the DSDPV1-RSU, whose B014 to B01F are plain RAM in the modes
that do not use them ([chip_rsu.md](chip_rsu.md)). The constants are those of `registers/dsdpv1_regs.hpp` (namespace `dsdpv1::regs`); in `registers/dsdpv1_regs.h` and
`registers/dsdpv1_regs.svh` `kUserCommand1Init` is called `DSDPV1_REG_USER_COMMAND_1_INIT`. A field of several bits also has `k...Shift`,
the number of its lowest bit; an array `k...Size`, its number of bytes; a byte with a largest value `k...Limit`; one that is not zero
after reset `k...Reset`. Rulings are those of [chip.md](chip.md) and [chip_rsu.md](chip_rsu.md), tables those of the datasheet.""",
    byte="B",
    chips={None: "all", "rsu": "-RSU"},
)
SPC3 = Map(
    name="spc3",
    namespace="dsdpv1::spc3::regs",
    title="SPC3 family",
    memory="ram_size",
    block="map",
    view="Registers and RAM as the user CPU sees them.",
    high_first=False,
    words="A word is at its low byte, the high byte follows.",
    members={"user_reads": lambda cell: "R" in cell.user, "user_writes": lambda cell: "W" in cell.user, "command": lambda cell: cell.command},
    cell_text="A part of the address space; command: a read acts (ruling A16).",
    table_text="Every address once for reads, and once for writes that are not ignored; ascending.",
    headers={"hpp": render_cpp, "h": render_c},
    page="registers_spc3.md",
    introduction="""# Registers of the SPC3 family

The addresses of apc3, spc3 and vpc3 in the order of an Intel bus. Below 0x016 a read and a write of one address are two registers, and a read may
be a command: it acts. The columns "chip" and "user" show who reads (R) and writes (W). A word has its low byte first; a Motorola bus has the two
bytes of 0x000 to 0x007, and of 0x018, exchanged. Writes to addresses below 0x016 without a register are ignored. The column "chips" names the chips
that have it. The constants are those of `registers/spc3_regs.hpp` (namespace `dsdpv1::spc3::regs`); in `registers/spc3_regs.h`
`kOrgUserWd` is called `SPC3_REG_ORG_USER_WD`. A field of several bits also has `k...Shift`, the number of its lowest bit; an array `k...Size`,
its number of bytes; a byte with a largest useful value `k...Limit`; one that is not zero after reset `k...Reset`. Rulings are those of
[spc3.md](spc3.md), tables those of the APC3 manual.""",
    byte="0x",
    chips={None: "all", "spc3": "spc3, vpc3", "vpc3": "vpc3"},
)
MAPS = (DSDPV1, SPC3)


# ---------------------------------------------------------------------------------------------------------------- main
def outputs(regs):
    files = {ROOT / "registers" / f"{regs.name}_regs.{ending}": render(regs) for ending, render in regs.headers.items()}
    return {**files, ROOT / "docs" / regs.page: render_doc(regs)}


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
        texts = {path: text for regs in MAPS for path, text in outputs(load(regs)).items()}
    except RDLCompileError:
        return 2  # the compiler has reported place and reason
    stale = {path: text for path, text in texts.items() if not is_current(path, text)}
    for path, text in stale.items():
        if check:
            print(f"{path.relative_to(ROOT)}: stale, run registers/generate.py")
        else:
            write(path, text)
            print(f"{path.relative_to(ROOT)}: written")
    return 1 if check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
