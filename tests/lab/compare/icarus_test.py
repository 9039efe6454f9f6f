#!/usr/bin/env python3
"""The reference RTL under Icarus, driven by the pins of a golden trace, and its wave compared with the golden.

    icarus_test.py SIM

An independent reader takes the inputs from the golden's VCD. The wave must be equal; with a fault in the RTL `compare` must name the same cycle,
pin and levels as `traces check` for the same RTL under Verilator.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
GOLDEN, SLAVE = "bus_timing", "demo"
END = 2_000_000_000  # ps; from power-on to data exchange
INPUTS = {"RESET": 1, "R_REQ": 1, "R_STA": 1, "CSR": 1, "RD": 1, "WR": 1, "A": 11, "D": 8, "PBRXD": 1}
BEGIN = "-250ns"  # of the wave of icarus_bench.sv
FAULT = 46  # of rtl_ref/dsdpv1/faults.txt


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


def write_inputs(vcd, path):
    """A line for each time at which an input changes."""
    levels = {name: "0" for name in INPUTS}
    lines = {}

    def bits():
        return "".join(levels[each].rjust(width, "0") for each, width in INPUTS.items())

    for now, name, value in changes(vcd, SLAVE):
        name = "D" if name == "D_IN" else name
        if name in levels and now < END:
            levels[name] = value
            lines[now] = bits()
    lines[END] = bits()
    path.write_text("".join(f"{now} {bits}\n" for now, bits in lines.items()), encoding="ascii")


def run(command, folder):
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def expect(what, condition, said=""):
    if not condition:
        sys.exit(f"{what}\n{said}")


def simulate(folder, wave, fault=0):
    """Under Icarus."""
    rtl = ROOT / "rtl_ref"
    sources = [rtl / line for line in (rtl / "dsdpv1/files.txt").read_text(encoding="ascii").split()]
    status, said = run(["iverilog", "-g2012", "-DSINGLE_FAULTS", "-I", rtl, "-I", ROOT / "registers", f"-Pbench.FAULT={fault}", "-s", "bench", "-o",
                        "bench.vvp", ROOT / "tests/lab/compare/icarus_bench.sv", *sources], folder)
    expect("iverilog", status == 0, said)
    status, said = run(["vvp", "bench.vvp", *(["-fst"] if wave.endswith(".fst") else []), "+inputs=inputs.txt", f"+wave={wave}"], folder)
    expect("vvp", status == 0, said)


def compare(sim, folder, wave):
    """Its finding, and its text."""
    status, said = run([sim, "compare", "golden.vcd", wave, "--scope-a", SLAVE, "--scope-b", "bench.dut", "--pins", "rtl_ref", "--shift", BEGIN,
                        "--to", f"{END}ps", "--json", "result.json"], folder)
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


def main():
    sim = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory(prefix="dsdpv1_icarus_") as name:
        folder = pathlib.Path(name)
        status, said = run([sim, "traces", "wave", GOLDEN, folder / "golden.vcd"], ROOT)
        expect("traces wave", status == 0, said)
        write_inputs(folder / "golden.vcd", folder / "inputs.txt")
        no_difference(sim, folder)
        the_same_difference(sim, folder)


main()
