#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Writes the registers of a chip, from registers/*.rdl, in a format that other tools read.

  ipxact   a component of IP-XACT (IEEE 1685-2014)
  ral      a SystemVerilog package with a register model of UVM
  svd      a device of CMSIS-SVD, for debuggers

Without --out it is printed. --base is the address of the chip for ipxact and svd, 0 if left out.
"""
import argparse
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

from generate import DSDPV1, ROOT, SPC3, Field, all_cells, load, write
from systemrdl import RDLCompileError

CHIPS = {  # the map of each, and what it has beside the cells of all
    "dsdpv1": (DSDPV1, ()),
    "dsdpv1_r": (DSDPV1, ()),
    "dsdpv1_rsu": (DSDPV1, ("rsu",)),
    "apc3": (SPC3, ()),
    "spc3": (SPC3, ("spc3",)),
    "vpc3": (SPC3, ("spc3", "vpc3")),
}
WHOLE = "value"  # the field of a byte or word without named bits, as in the source


def project_version():
    return re.search(r"project\(dsdpv1 VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


# ------------------------------------------------------------------------------------------------- what all of them say
def blocks_of(areas, chip):
    """(area, cells) of the areas with cells that this chip has; the reserved ones are left out."""
    for area in areas:
        cells = [cell for cell in area.cells if not cell.reserved and exists(cell, chip)]
        if cells:
            yield area, cells


def exists(part, chip):
    return part.only is None or part.only in CHIPS[chip][1]


def origin(regs):
    return f"Generated from registers/{regs.name}.rdl by ./run registers. Do not edit."


def name_in_area(cell):
    return cell.path.split(".")[-1]


def width_of(cell):
    return 8 * cell.size // (cell.count or 1)


def fields_of(cell, chip):
    """The named bits, or one field that is the whole of it."""
    if not cell.fields:
        return [Field(WHOLE, "", 0, width_of(cell), None, cell.encode, None)]
    return [f for f in cell.fields if exists(f, chip)]


def reset_of(cell, f):
    return (cell.reset & f.mask) >> f.low


def text_of(*parts):
    return " ".join(part if part.endswith(".") else part + "." for part in parts if part)


def cell_text(regs, cell):
    order = f"The {'high' if regs.high_first else 'low'} byte is first" if width_of(cell) == 16 else ""
    return text_of(cell.title, cell.text, order, "A read is a command" if cell.command else "")


def flag_text(f):
    """A flag of the handshake: what both sides do with it."""
    other = {"chip": "user", "user": "chip"}
    return f"Flag: the {f.set_by} sets it, the {other[f.set_by]} clears it" if f.set_by else ""


# ----------------------------------------------------------------------------------------------------------------- XML
def put(parent, tag, text=None):
    """Adds an element, with a text; without one the element is returned to be filled."""
    element = ElementTree.SubElement(parent, tag)
    if text is not None:
        element.text = str(text)
    return element


def put_all(parent, prefix, **texts):
    """Elements with texts, in this order; empty ones are left out."""
    for name, text in texts.items():
        if text not in (None, ""):
            put(parent, prefix + name, text)


def render_xml(regs, top):
    ElementTree.indent(top)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<!-- {origin(regs)} -->\n' + ElementTree.tostring(top, encoding="unicode") + "\n"


# ------------------------------------------------------------------------------------------------------------- IP-XACT
IPXACT = "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"
ACCESS = {"R": "read-only", "R/W": "read-write", "W": "write-only"}


def hexadecimal(number):
    return f"'h{number:X}"


def put_ipxact_field(register, cell, f):
    field = put(register, "ipxact:field")
    put_all(field, "ipxact:", name=f.name, description=text_of(f.text, flag_text(f)), bitOffset=f.low)
    put(put(put(field, "ipxact:resets"), "ipxact:reset"), "ipxact:value", hexadecimal(reset_of(cell, f)))
    put_all(field, "ipxact:", bitWidth=f.width, volatile=str("W" in cell.chip).lower(), access=ACCESS[cell.user])
    if f.encode:
        values = put(field, "ipxact:enumeratedValues")
        for name, value, text in f.encode.members:
            put_all(put(values, "ipxact:enumeratedValue"), "ipxact:", name=name, description=text, value=hexadecimal(value))
    if cell.limit is not None:
        put_all(put(field, "ipxact:writeValueConstraint"), "ipxact:", minimum=0, maximum=cell.limit)
    if cell.command:
        put(field, "ipxact:readAction", "modify")
    if f.set_by:
        put(put(field, "ipxact:vendorExtensions"), "dsdpv1:setBy", f.set_by)


def put_ipxact_register(block, area, cell, regs, chip):
    register = put(block, "ipxact:register")
    put_all(register, "ipxact:", name=name_in_area(cell), displayName=cell.title, description=cell_text(regs, cell), dim=cell.count or None,
            addressOffset=hexadecimal(cell.address - area.address), size=width_of(cell), volatile=str("W" in cell.chip).lower())
    for f in fields_of(cell, chip):
        put_ipxact_field(register, cell, f)


def block_name(area):
    """Its key, or a name for bytes outside of such areas."""
    return area.key or (area.title.lower() if area.address else "status")


def render_ipxact(regs, chip, base):
    top = ElementTree.Element("ipxact:component", {"xmlns:ipxact": IPXACT, "xmlns:dsdpv1": "urn:dsdpv1:registers"})
    put_all(top, "ipxact:", vendor="dsdpv1", library="registers", name=chip, version=project_version())
    memory = put(put(top, "ipxact:memoryMaps"), "ipxact:memoryMap")
    put_all(memory, "ipxact:", name=regs.block, description=regs.view)
    for area, cells in blocks_of(regs.areas, chip):
        block = put(memory, "ipxact:addressBlock")
        put_all(block, "ipxact:", name=block_name(area), displayName=area.title, description=text_of(area.title, area.text),
                baseAddress=hexadecimal(base + area.address), range=hexadecimal(area.cells[-1].last + 1 - area.address), width=8, usage="register", volatile="true")
        for cell in cells:
            put_ipxact_register(block, area, cell, regs, chip)
    put(memory, "ipxact:addressUnitBits", 8)
    return render_xml(regs, top)


# ----------------------------------------------------------------------------------------------------------- CMSIS-SVD
def put_svd_field(fields, cell, f):
    field = put(fields, "field")
    put_all(field, "", name=f.name, description=text_of(f.text, flag_text(f)), bitOffset=f.low, bitWidth=f.width, access=ACCESS[cell.user])
    if cell.limit is not None:
        put_all(put(put(field, "writeConstraint"), "range"), "", minimum=0, maximum=cell.limit)
    if cell.command:
        put(field, "readAction", "modifyExternal")
    if f.encode:
        values = put(field, "enumeratedValues")
        put(values, "name", f.encode.name)
        for name, value, text in f.encode.members:
            put_all(put(values, "enumeratedValue"), "", name=name, description=text, value=f"0x{value:X}")


def put_svd_register(parent, cell, offset, regs, chip):
    register = put(parent, "register")
    if cell.count:
        put_all(register, "", dim=cell.count, dimIncrement=cell.size // cell.count)
    put_all(register, "", name=name_in_area(cell) + "[%s]" * bool(cell.count), description=cell_text(regs, cell), addressOffset=f"0x{offset:X}", size=width_of(cell),
            access=ACCESS[cell.user], resetValue=f"0x{cell.reset:X}", resetMask=f"0x{(1 << width_of(cell)) - 1:X}")
    fields = put(register, "fields")
    for f in fields_of(cell, chip):
        put_svd_field(fields, cell, f)


def render_svd(regs, chip, base):
    top = ElementTree.Element("device", {"schemaVersion": "1.3", "xmlns:xs": "http://www.w3.org/2001/XMLSchema-instance",
                                         "xs:noNamespaceSchemaLocation": "CMSIS-SVD.xsd"})
    put_all(top, "", vendor="dsdpv1", name=chip.upper(), version=project_version(), description="PROFIBUS-DP slave chip. " + regs.view,
            addressUnitBits=8, width=8, size=8, access="read-write")
    peripheral = put(put(top, "peripherals"), "peripheral")
    put_all(peripheral, "", name=regs.block.upper(), description=regs.view, baseAddress=f"0x{base:X}")
    put_all(put(peripheral, "addressBlock"), "", offset="0x0", size=f"0x{max(cell.last for cell in all_cells(regs.areas) if exists(cell, chip)) + 1:X}", usage="registers")
    registers = put(peripheral, "registers")
    for area, cells in blocks_of(regs.areas, chip):
        parent, start = registers, 0
        if area.key:
            parent, start = put(registers, "cluster"), area.address
            put_all(parent, "", name=area.key, description=text_of(area.title, area.text), addressOffset=f"0x{start:X}")
        for cell in cells:
            put_svd_register(parent, cell, cell.address - start, regs, chip)
    return render_xml(regs, top)


# ------------------------------------------------------------------------------------------------------------- UVM RAL
RIGHTS = {"R": "RO", "R/W": "RW", "W": "WO"}
KEYWORDS = {"input", "output"}  # names in the source that SystemVerilog has taken: the variable gets a _, the name in UVM does not

RAL_HEAD = """// {origin}
// A register model for UVM. {view} {words}
package {chip}_ral_pkg;
  import uvm_pkg::*;
  `include "uvm_macros.svh"
"""
RAL_FLAG = """
  // A flag of the handshake: one side sets it, the other clears it. Its value after a write is not what was written.
  class {chip}_flag extends uvm_reg_field;
    `uvm_object_utils({chip}_flag)
    string set_by;  // "chip" or "user"
    function new(string name = "{chip}_flag");
      super.new(name);
    endfunction
  endclass
"""


def variable(name):
    return name + "_" * (name in KEYWORDS)


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def ral_class(name, base, members, build, arguments=""):
    """A class whose build() has these lines."""
    lines = [f"  class {name} extends {base};", f"    `uvm_object_utils({name})", *("    " + line for line in members)]
    lines += [f"    function new(string name = {quoted(name)});", f"      super.new(name, {arguments}UVM_NO_COVERAGE);", "    endfunction"]
    return ["", *lines, "    virtual function void build();", *("      " + line for line in build), "    endfunction", "  endclass"]


def ral_field(cell, f, chip):
    """(member, lines of build)"""
    kind, name = (f"{chip}_flag" if f.set_by else "uvm_reg_field"), variable(f.name)
    volatile, written = int("W" in cell.chip), int("W" in cell.user)
    build = [f"{name} = {kind}::type_id::create({quoted(f.name)});",
             f'{name}.configure(this, {f.width}, {f.low}, "{RIGHTS[cell.user]}", {volatile}, {f.width}\'h{reset_of(cell, f):X}, 1, {written}, 0);']
    if f.set_by:
        build.append(f"{name}.set_by = {quoted(f.set_by)};")
    remark = text_of(f.text, flag_text(f))
    return f"rand {kind} {name};" + (f"  // {remark}" if remark else ""), build


def ral_register_class(cell, name, regs, chip):
    members, build = zip(*(ral_field(cell, f, chip) for f in fields_of(cell, chip)))
    head = [f"// {regs.byte}{cell.address:03X}: {cell_text(regs, cell)}"]
    return ral_class(name, "uvm_reg", [*head, *members], sum(build, []), f"{width_of(cell)}, ")


def ral_register(cell, name, kind, offset):
    """(member, lines of build) of a register or an array of them in its block"""
    rights, own = RIGHTS[cell.user], variable(name)
    if not cell.count:
        return f"rand {kind} {own};", [f"{own} = {kind}::type_id::create({quoted(name)});", f"{own}.configure(this);", f"{own}.build();",
                                       f'default_map.add_reg({own}, \'h{offset:X}, "{rights}");']
    return f"rand {kind} {own}[{cell.count}];", [
        f"foreach ({own}[i]) begin", f"  {own}[i] = {kind}::type_id::create($sformatf(\"{name}[%0d]\", i));", f"  {own}[i].configure(this);",
        f"  {own}[i].build();", f'  default_map.add_reg({own}[i], \'h{offset:X} + {cell.size // cell.count} * i, "{rights}");', "end"]


def ral_block(regs, build):
    order = "BIG" if regs.high_first else "LITTLE"
    return [f'default_map = create_map("map", 0, 1, UVM_{order}_ENDIAN, 1);', *sum(build, [])]


def ral_blocks(regs, chip):
    """The lines of all register classes and blocks of areas, and (member, lines of build) of what the top block has."""
    classes, parts = [], []
    for area, cells in blocks_of(regs.areas, chip):
        start = area.address if area.key else 0
        registers = []
        for cell in cells:
            kind = f"{chip}_{cell.path.replace('.', '_')}"
            classes += ral_register_class(cell, kind, regs, chip)
            registers.append(ral_register(cell, name_in_area(cell), kind, cell.address - start))
        if not area.key:
            parts += registers
            continue
        kind, own = f"{chip}_{area.key}_block", variable(area.key)
        classes += ral_class(kind, "uvm_reg_block", [f"// {text_of(area.title, area.text)}", *(member for member, _ in registers)],
                             ral_block(regs, (build for _, build in registers)))
        parts.append((f"rand {kind} {own};", [f"{own} = {kind}::type_id::create({quoted(area.key)});", f"{own}.configure(this);", f"{own}.build();",
                                              f"default_map.add_submap({own}.default_map, 'h{start:X});"]))
    return classes, parts


def render_ral(regs, chip, _base):
    classes, parts = ral_blocks(regs, chip)
    top = ral_class(f"{chip}_{regs.block}", "uvm_reg_block", [f"// {len(parts)} registers and areas, at their addresses", *(member for member, _ in parts)],
                    [*ral_block(regs, (build for _, build in parts)), "lock_model();"])
    has_flags = any(f.set_by for cell in all_cells(regs.areas) for f in cell.fields)
    head = RAL_HEAD + RAL_FLAG * has_flags
    return head.format(origin=origin(regs), chip=chip, view=regs.view, words=regs.words) + "\n".join([*classes, *top, "endpackage"]) + "\n"


# ---------------------------------------------------------------------------------------------------------------- main
FORMATS = {"ipxact": render_ipxact, "ral": render_ral, "svd": render_svd}


def address(text):
    number = int(text, 0)
    if not 0 <= number <= 0xFFFF_F800:
        raise ValueError(text)
    return number


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"registers: {message}\n")  # one line, as every command of ./run


def main():
    parser = Parser(prog="./run registers", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--format", choices=FORMATS, required=True)
    parser.add_argument("--chip", choices=CHIPS, default="dsdpv1", help="whose cells and bits: dsdpv1, if left out")
    parser.add_argument("--base", type=address, default=0, metavar="ADDRESS", help="of the chip, up to 0xFFFFF800")
    parser.add_argument("--out", type=Path, metavar="FILE")
    given = parser.parse_args()
    try:
        regs = load(CHIPS[given.chip][0])
    except RDLCompileError:
        return 2  # the compiler has reported place and reason
    text = FORMATS[given.format](regs, given.chip, given.base)
    if given.out is None:
        print(text, end="")
        return 0
    try:
        write(given.out, text)
    except OSError as error:
        print(f"registers: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
