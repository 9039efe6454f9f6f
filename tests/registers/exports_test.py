"""What ./run registers writes, read by programs of others and compared with the source as PeakRDL's compiler reads it: names, addresses, widths, rights,
resets, flags, and the bits of each chip.

    exports_test.py PYTHON ROOT
"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from typing import NamedTuple

import cmsis_svd
from cmsis_svd.parser import SVDParser
from ipyxact.ipyxact import Component
from lxml import etree
from pyslang import ast, driver
from systemrdl import RDLCompiler

HERE, ROOT = Path(__file__).resolve().parent, Path(sys.argv.pop())
PYTHON = sys.argv.pop()
CHIPS = {"dsdpv1": (), "dsdpv1_r": (), "dsdpv1_rsu": ("rsu",), "apc3": (), "spc3": ("spc3",), "vpc3": ("spc3", "vpc3")}  # what each has beside all
BASE = 0x6000_0000


class Bits(NamedTuple):
    low: int
    width: int
    reset: int
    set_by: str = ""  # of a flag


class Register(NamedTuple):
    address: int
    width: int
    count: int  # of an array, else 0
    rights: str  # the user's: R, W, RW
    command: bool  # a read is one
    bits: dict  # by name


def run(*words):
    return subprocess.run([PYTHON, "-B", ROOT / "registers" / "export.py", *words], capture_output=True, text=True, check=False)


def export(kind, chip, *words):
    done = run("--format", kind, "--chip", chip, *words)
    assert done.returncode == 0 and not done.stderr, done.stderr
    return done.stdout


def source(chip):
    """The registers by path."""
    compiler = RDLCompiler()
    compiler.compile_file(str(ROOT / "registers" / ("dsdpv1.rdl" if chip.startswith("dsdpv1") else "spc3.rdl")))
    found, has = {}, lambda node: node.get_property("only") in (None, *CHIPS[chip])
    for register in compiler.elaborate().top.descendants(unroll=False):
        if type(register).__name__ != "RegNode" or not has(register) or not any(f.is_hw_readable or f.is_hw_writable for f in register.fields()):
            continue
        bits = {f.inst_name: Bits(f.low, f.width, f.get_property("reset"), f.get_property("set_by") or "") for f in register.fields() if has(f)}
        path = register.get_path(array_suffix="", empty_array_suffix="").split(".", 1)[1]
        found[path] = Register(register.raw_absolute_address, register.get_property("regwidth"), register.array_dimensions[0] if register.is_array else 0,
                               rights_in(register), any(f.get_property("onread") for f in register.fields()), bits)
    return found


def rights_in(register):
    fields = list(register.fields())
    return "R" * any(f.is_sw_readable for f in fields) + "W" * any(f.is_sw_writable for f in fields)


def flag_of(description):
    found = re.search(r"Flag: the (\w+) sets it", description or "")
    return found[1] if found else ""


RIGHTS = {"read-only": "R", "write-only": "W", "read-write": "RW", "RO": "R", "WO": "W", "RW": "RW"}


def of_all(values):
    """The only value."""
    value, = set(values)
    return value


# ------------------------------------------------------------------------------------------------------------- IP-XACT
def from_file(text, read):
    """What a reader of files makes of a text."""
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(text)
        file.flush()
        return read(file.name)


def from_ipxact(text):
    component = Component()
    from_file(text, component.load)
    found = {}
    for block in component.memoryMaps.memoryMap[0].addressBlock:
        for register in block.register:
            bits = {f.name: Bits(f.bitOffset, f.bitWidth, f.resets.reset.value, flag_of(f.description)) for f in register.field}
            path = ("" if block.name in ("status", "buffers") else block.name + ".") + register.name
            found[path] = Register(block.baseAddress + register.addressOffset, register.size, int(register.dim or 0),
                                   of_all((RIGHTS[f.access] for f in register.field)), of_all((f.readAction == "modify" for f in register.field)), bits)
            assert register.addressOffset + max(1, found[path].count) * register.size // 8 <= block.range, path
    return found


# ----------------------------------------------------------------------------------------------------------- CMSIS-SVD
def is_valid_svd(text):
    schema = etree.XMLSchema(etree.parse(str(Path(cmsis_svd.__file__).parent / "schemas" / "CMSIS-SVD_1_3_11.xsd")))
    schema.assertValid(etree.fromstring(text.encode()))


def svd_register(item, path, base):
    """Of an array the first element, with their number."""
    elements = getattr(item, "registers", None) or [item]
    first = elements[0]
    assert [each.address_offset - first.address_offset for each in elements] == [index * first.size // 8 for index in range(len(elements))], path
    bits = {f.name: Bits(f.bit_offset, f.bit_width, first.reset_value >> f.bit_offset & (1 << f.bit_width) - 1, flag_of(f.description)) for f in first.fields}
    return Register(base + first.address_offset, first.size, len(elements) if elements != [item] else 0,
                    of_all(RIGHTS[f.access.value] for f in first.fields), of_all(f.read_action is not None for f in first.fields), bits)


def from_svd(text):
    peripheral = from_file(text, SVDParser.for_xml_file).get_device().peripherals[0]
    found = {}
    for each in peripheral.registers:
        inside = None if hasattr(each, "meta_register") else getattr(each, "registers", None)  # of a cluster, whose name the reader puts in front of theirs
        for item in inside or [each]:
            name = getattr(item, "meta_register", item).name.removeprefix(each.name + "_" if inside else "").removesuffix("[%s]")
            path = f"{each.name}.{name}" if inside else name
            found[path] = svd_register(item, path, peripheral.base_address)
    return found


# ------------------------------------------------------------------------------------------------------------- UVM RAL
def compiled(text, *more):
    """The package, compiled by slang, with other files; a warning is an error."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "ral.sv"
        file.write_text(text, encoding="utf-8")
        slang = driver.Driver()
        slang.addStandardArgs()
        assert slang.parseCommandLine(f"slang -Wextra -Werror -I{HERE} {HERE / 'uvm_stub.sv'} {file} " + " ".join(map(str, more)))
        assert slang.processOptions() and slang.parseAllSources()
        compilation = slang.createCompilation()
        slang.reportCompilation(compilation, True)
        assert slang.reportDiagnostics(False), "slang has reported something"
        return next(each for each in compilation.getPackages() if each.name.endswith("_ral_pkg")), (slang, compilation)


def unwrapped(expression):
    """Without conversions and the element of an array."""
    while expression.kind in (ast.ExpressionKind.Conversion, ast.ExpressionKind.ElementSelect):
        expression = expression.operand if expression.kind == ast.ExpressionKind.Conversion else expression.value
    return expression


def text_in(expression):
    expression = unwrapped(expression)
    return expression.value if expression.kind == ast.ExpressionKind.StringLiteral else text_in(expression.arguments[0])  # $sformatf


def name_in(expression):
    return unwrapped(expression).symbol.name


def number_in(expression):
    """With an index of an array as 0."""
    if expression.constant is not None:
        return int(expression.constant.value)
    return number_in(unwrapped(expression).left)


class Build:
    """What the build() of a class does: of each variable its name and class in UVM, and the calls that configure it."""

    def __init__(self, of):
        self.names, self.fields, self.places, self.sizes = {}, {}, {}, {}
        for each in of:
            if each.kind == ast.SymbolKind.ClassProperty and each.type.isFixedSize and each.type.isUnpackedArray:
                self.sizes[each.name] = each.type.range.width
        next(each for each in of if each.kind == ast.SymbolKind.Subroutine and each.name == "build").body.visit(self._see)

    def _see(self, node):
        if isinstance(node, ast.AssignmentExpression):
            self._assigned(node.left, node.right)
        elif isinstance(node, ast.CallExpression):
            self._called(node.subroutineName, node.thisClass, node.arguments)

    def _assigned(self, left, right):
        if left.kind == ast.ExpressionKind.MemberAccess:
            variable = name_in(left.value)
            self.fields[variable] = self.fields[variable]._replace(set_by=text_in(right))
        elif unwrapped(right).subroutineName == "create":
            self.names[name_in(left)] = text_in(unwrapped(right).arguments[0]), left.type.name

    def _called(self, name, this, arguments):
        if name == "configure" and len(arguments) == 9:
            self.fields[name_in(this)] = Bits(number_in(arguments[2]), number_in(arguments[1]), number_in(arguments[5]))
            self.places[name_in(this)] = text_in(arguments[3])
        elif name == "add_reg":
            self.places[name_in(arguments[0])] = number_in(arguments[1]), text_in(arguments[2])
        elif name == "add_submap":
            self.places[name_in(unwrapped(arguments[0]).value)] = number_in(arguments[1]), ""


def width_of(register):
    """What its new() hands to uvm_reg."""
    found = []
    new = next(each for each in register if each.kind == ast.SymbolKind.Subroutine and each.name == "new")
    new.body.visit(lambda node: found.append(number_in(node.arguments[1])) if isinstance(node, ast.CallExpression) and len(node.arguments) == 3 else None)
    return found[0]


def from_ral(text, chip):
    package, _kept = compiled(text)
    classes = {each.name: each for each in package if isinstance(each, ast.ClassType)}
    found = {}

    def add(block, prefix, base):
        build = Build(classes[block])
        for variable, (name, kind) in build.names.items():
            offset, rights = build.places[variable]
            if classes[kind].baseClass.name == "uvm_reg_block":
                add(kind, prefix + name + ".", base + offset)
                continue
            inside = Build(classes[kind])
            assert {inside.places[each] for each in inside.fields} == {rights}, name
            assert all((inside.names[each][1] == f"{chip}_flag") == bool(bits.set_by) for each, bits in inside.fields.items()), name
            found[prefix + name.removesuffix("[%0d]")] = Register(base + offset, width_of(classes[kind]), build.sizes.get(variable, 0), RIGHTS[rights],
                                                                  kind in commands, {inside.names[each][0]: bits for each, bits in inside.fields.items()})

    commands = re.findall(r"^  class (\w+) extends uvm_reg;\n.*\n    // .* A read is a command\.$", text, re.M)
    add(f"{chip}_dpram" if chip.startswith("dsdpv1") else f"{chip}_map", "", 0)
    return found


# ---------------------------------------------------------------------------------------------------------------- tests
class Exports(unittest.TestCase):
    maxDiff = 4000

    def test_the_source_has_what_the_chips_have(self):
        counts = {chip: len(source(chip)) for chip in CHIPS}
        self.assertEqual(counts["dsdpv1"], counts["dsdpv1_r"])
        self.assertGreater(counts["dsdpv1_rsu"], counts["dsdpv1"])
        self.assertEqual(source("dsdpv1")["chip_command_1"].bits["prm"], Bits(1, 1, 0, "chip"))
        self.assertEqual(source("dsdpv1")["version_year"].bits["value"].reset, 0x0D)
        self.assertNotIn("v1_init_crc", source("dsdpv1")["chip_status_2"].bits)
        self.assertEqual([path for path, each in source("apc3").items() if each.command],
                         ["new_din", "next_dout", "new_diag", "prm_ok", "prm_not_ok", "cfg_ok", "cfg_not_ok", "ssa_free"])
        self.assertNotIn("user_timer", source("apc3")["irr"].bits)
        self.assertIn("user_timer", source("spc3")["irr"].bits)
        self.assertEqual(set(source("vpc3")) - set(source("spc3")), {"mode_0_read", "mode_1_read", "mode_2", "mode_3", "buffers_vpc3"})

    def test_ipxact_is_the_source(self):
        for chip in CHIPS:
            self.assertEqual(from_ipxact(export("ipxact", chip)), source(chip))

    def test_svd_is_the_source_and_has_its_schema(self):
        for chip in CHIPS:
            text = export("svd", chip)
            is_valid_svd(text)
            self.assertEqual(from_svd(text), source(chip))

    def test_ral_is_the_source(self):
        for chip in CHIPS:
            self.assertEqual(from_ral(export("ral", chip), chip), source(chip))

    def test_the_code_of_the_page_compiles(self):
        code = re.findall(r"^```systemverilog\n(.*?)^```", (ROOT / "docs" / "register_exports.md").read_text(encoding="utf-8"), re.M | re.S)
        self.assertEqual(len(code), 2)
        around = ["import uvm_pkg::*;", "uvm_status_e status;", "uvm_object host_sequencer, host_adapter;", "function void fetch_outputs();", "endfunction"]
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "page.sv"
            file.write_text("\n".join(["module page;", *around, "initial begin", "automatic " + code[0], "begin", code[1], "end", "end", "endmodule"]), encoding="utf-8")
            compiled(export("ral", "dsdpv1"), file)

    def test_a_base_moves_all(self):
        moved = {path: register._replace(address=register.address + BASE) for path, register in source("dsdpv1").items()}
        self.assertEqual(from_ipxact(export("ipxact", "dsdpv1", "--base", hex(BASE))), moved)
        self.assertEqual(from_svd(export("svd", "dsdpv1", "--base", hex(BASE))), moved)

    def test_a_wrong_reset_is_found_in_each(self):
        for read, kind, right, wrong in ((from_ipxact, "ipxact", "'hD<", "'hC<"), (from_svd, "svd", ">0xD</resetValue", ">0xC</resetValue"),
                                         (lambda text: from_ral(text, "dsdpv1"), "ral", "8'hD", "8'hC")):
            text = export(kind, "dsdpv1")
            self.assertIn(right, text)
            self.assertNotEqual(read(text.replace(right, wrong)), source("dsdpv1"))

    def test_a_file_is_complete_or_absent(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "dsdpv1.svd"
            self.assertEqual(export("svd", "dsdpv1", "--out", str(file)), "")
            self.assertEqual(file.read_text(encoding="utf-8"), export("svd", "dsdpv1"))
            self.assertEqual(os.listdir(folder), ["dsdpv1.svd"])

    def test_wrong_arguments_are_exit_code_2(self):
        for words, said in ((("--format", "vhdl"), "invalid choice"), ((), "--format"), (("--format", "svd", "--chip", "spc4"), "invalid choice"), (("--format", "svd", "--base", "0xFFFFFFFF"), "--base"),
                            (("--format", "svd", "--out", "/no/such/folder/x"), "registers: /no/such/folder/x.new: No such file or directory")):
            done = run(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    unittest.main()
