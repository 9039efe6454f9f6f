#!/usr/bin/env python3
"""The reference RTL under Icarus, driven by the pins of a golden trace, and its wave compared with the golden.

    icarus_test.py SIM

The same for a DSDPV1-RSU over SPI. An independent reader takes the inputs from the golden's VCD. The wave must be equal; with a fault in the RTL `compare` must name the same cycle,
pin and levels as `traces check` for the same RTL under Verilator.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
INPUTS = {"RESET": 1, "R_REQ": 1, "R_STA": 1, "CSR": 1, "RD": 1, "WR": 1, "A": 11, "D": 8, "PBRXD": 1}
BEGIN = "-250ns"  # of the wave of icarus_bench.sv
SERIAL = {"XSS": 1, "SCK": 1, "MOSI": 1, "RXD": 1, "MODE": 2, "ADR": 2, "UBR": 3, "UIV": 3}
GOLDEN, SLAVE, END = "bus_timing", "demo", 2_000_000_000  # ps; from power-on to data exchange
FAULT = 46  # of rtl_ref/dsdpv1/faults.txt
RSU_GOLDEN, RSU_SLAVE, RSU_END = "rsu_spi", "drive", 1_000_000_000  # from power-on: the user's writes and reads over SPI
RSU_FAULT = 129  # of rtl_ref/dsdpv1_rsu/faults.txt: bits of a reply in the wrong order
RSU_MAP = "tolerance: {MISO: 1}\n"  # the RTL's MISO has no spi_miso_delay


def changes(vcd, scope):
    """(ps, name, value) of this program's VCD: one line a change."""
    names, scopes, now = {}, [], 0
    for line in vcd.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[0] == "$scope":
            scopes.append(words[2])
        elif words[0] == "$upscope":
            scopes.pop()
        elif words[0] == "$var" and scopes == [scope]:
            names[words[3]] = words[4]
        elif line[0] == "#":
            now = int(line[1:])
        elif line[0] == "b" and words[1] in names:
            yield now, names[words[1]], words[0][1:]
        elif line[0] in "01xz" and line[1:] in names:
            yield now, names[line[1:]], line[0]


def write_inputs(vcd, path, slave=SLAVE, end=END, inputs=None):
    """A line for each time at which an input changes."""
    inputs = inputs or INPUTS
    levels = {name: "0" for name in inputs}
    lines = {}

    def bits():
        return "".join(levels[each].rjust(width, "0") for each, width in inputs.items())

    for now, name, value in changes(vcd, slave):
        name = "D" if name == "D_IN" else name
        if now >= end:
            break
        if name in levels:
            levels[name] = value
            lines[now] = bits()
    lines[end] = bits()
    path.write_text("".join(f"{now} {bits}\n" for now, bits in lines.items()), encoding="ascii")


def run(command, folder):
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def expect(what, condition, said=""):
    if not condition:
        sys.exit(f"{what}\n{said}")


def simulate(folder, wave, fault=0, chip="dsdpv1"):
    """Under Icarus."""
    rtl = ROOT / "rtl_ref"
    sources = [rtl / line for line in (rtl / chip / "files.txt").read_text(encoding="ascii").split()]
    status, said = run(["iverilog", "-g2012", "-DSINGLE_FAULTS", *(["-DRSU"] if chip == "dsdpv1_rsu" else []), "-I", rtl, "-I", ROOT / "registers", f"-Pbench.FAULT={fault}", "-s", "bench", "-o",
                        "bench.vvp", ROOT / "tests/lab/compare/icarus_bench.sv", *sources], folder)
    expect("iverilog", status == 0, said)
    status, said = run(["vvp", "bench.vvp", *(["-fst"] if wave.endswith(".fst") else []), "+inputs=inputs.txt", f"+wave={wave}"], folder)
    expect("vvp", status == 0, said)


def compare(sim, folder, wave, slave=SLAVE, end=END, pins="rtl_ref"):
    """Its finding, and its text."""
    status, said = run([sim, "compare", "golden.vcd", wave, "--scope-a", slave, "--scope-b", "bench.dut", "--pins", pins, "--shift", BEGIN,
                        "--to", f"{end}ps", "--json", "result.json"], folder)
    expect(f"compare {wave}", status in (0, 1), said)
    return json.loads((folder / "result.json").read_text(encoding="utf-8")), said


def no_difference(sim, folder):
    simulate(folder, "icarus.vcd")
    result, said = compare(sim, folder, "icarus.vcd")
    expect("the RTL differs", result["equal"], said)
    compared = {each["signal"]: each["compared"] for each in result["signals"]}
    expect("not all pins of table 1 were compared", len(compared) == 17, said)
    expect("nothing happened on the pins", compared["D_OUT"] > 100 and compared["PBTXD"] > 50 and compared["L_REQ"] > 1000, said)


def the_same_difference(sim, folder):
    status, told = run([sim, "traces", "check", GOLDEN, "--engine", "rtl", "--fault", FAULT, "--no-progress"], ROOT)
    found = re.search(r"first difference  (cycle (\d+).*)\n +pin (\w+) of \w+: golden (?:still )?(\w), here (\w)\n", told)
    expect("the golden does not find the fault", status == 1 and found, told)
    wave = "fault.fst"  # that VCD is read as well is seen where nothing differs
    simulate(folder, wave, FAULT)
    result, said = compare(sim, folder, wave)
    first = result["first"]
    expect("the fault is not found", first, said)
    named = str(first["cycle"]), first["signal"], first["a"], first["b"]
    expect(f"the golden says\n{told}", named == found.groups()[1:] and found[1] in said, said)


def serial_port(sim, folder):
    """The pins of the DSDPV1-RSU: equal without a fault, and MISO differs with one."""
    golden(sim, folder, RSU_GOLDEN)
    write_inputs(folder / "golden.vcd", folder / "inputs.txt", RSU_SLAVE, RSU_END, INPUTS | SERIAL)
    (folder / "map.yaml").write_text(RSU_MAP, encoding="ascii")
    simulate(folder, "right.fst", 0, "dsdpv1_rsu")
    result, said = compare(sim, folder, "right.fst", RSU_SLAVE, RSU_END, "map.yaml")
    expect("the RTL of the DSDPV1-RSU differs", result["equal"], said)
    compared = {each["signal"]: each["compared"] for each in result["signals"]}
    expect("not all pins were compared", len(compared) == 27, said)
    expect("nothing happened on the serial pins", compared["MISO"] > 100 and compared["SCK"] > 1000, said)
    simulate(folder, "wrong.fst", RSU_FAULT, "dsdpv1_rsu")
    result, said = compare(sim, folder, "wrong.fst", RSU_SLAVE, RSU_END, "map.yaml")
    expect("the fault of MISO is not found", result["first"] and result["first"]["signal"] == "MISO", said)
    expect("the user's last access is not told", "last access       SPI frame of " in said, said)


def golden(sim, folder, name):
    status, said = run([sim, "traces", "wave", name, folder / "golden.vcd"], ROOT)
    expect("traces wave", status == 0, said)


def main():
    sim = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory(prefix="dsdpv1_icarus_") as name:
        folder = pathlib.Path(name)
        golden(sim, folder, GOLDEN)
        write_inputs(folder / "golden.vcd", folder / "inputs.txt")
        no_difference(sim, folder)
        the_same_difference(sim, folder)
        serial_port(sim, folder)


main()
