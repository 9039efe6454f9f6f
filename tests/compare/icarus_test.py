#!/usr/bin/env python3
"""The reference RTL under Icarus, driven by the pins that the model had, and its wave against the model's.

    icarus_test.py SIM

The inputs are read from the model's VCD by a reader of this script's own. A scenario's wave must be equal; with a fault in the RTL
`compare` must name the cycle that the lockstep names.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = """
name: From power-on to the first answers
baud: 12M
end: 1150us
slaves:
  - name: io
    address: 5
    gsd: %s/scenarios/dsdpv1.gsd
    modules: ["8 bytes in, 8 bytes out"]
    user_cpu: {behaviour: loop_back, cycle: 40us}
    release_reset: 20us
masters:
  - {name: plc, address: 2, start: 150us, slaves: [{slave: io}]}
"""
INPUTS = {"RESET": 1, "R_REQ": 1, "R_STA": 1, "CSR": 1, "RD": 1, "WR": 1, "A": 11, "D": 8, "PBRXD": 1}
BEGIN = "-250ns"  # of the wave of icarus_bench.sv
FAULT, STIMULUS = 44, "check_cfg"  # of rtl_ref/faults.txt; it shows within the 5000 cycles that the lockstep's wave has
QUICK = {"SEARCH_WINDOW_MS": 1, "SEARCH_WINDOW_BITS": 150, "BAUD_CONTROL_MS": 2}  # parameters of rtl-random


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


def write_inputs(vcd, scope, data, path):
    """A line for each time at which an input changes. `data` is what the wave calls D."""
    levels = {name: "0" for name in INPUTS}
    lines = {}

    def bits():
        return "".join(levels[each].rjust(width, "0") for each, width in INPUTS.items())

    for now, name, value in changes(vcd, scope):
        name = "D" if name == data else name
        if name in levels:
            levels[name] = value
            lines[now] = bits()
    last = vcd.read_text(encoding="utf-8").rpartition("\n#")[2].split()[0]
    lines[int(last)] = bits()  # the simulation goes on to the end of the wave
    path.write_text("".join(f"{now} {bits}\n" for now, bits in lines.items()), encoding="ascii")


def run(command, folder):
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def expect(what, condition, said=""):
    if not condition:
        sys.exit(f"{what}\n{said}")


def simulate(folder, inputs, name, parameters, fault=0, fst=False):
    """Under Icarus; the wave is name."""
    rtl = ROOT / "rtl_ref"
    sources = [rtl / line for line in (rtl / "files.txt").read_text(encoding="ascii").split()]
    set_parameters = [f"-Pbench.{key}={value}" for key, value in {**parameters, "FAULT": fault}.items()]
    status, said = run(["iverilog", "-g2012", "-DSINGLE_FAULTS", "-I", rtl, "-I", ROOT / "registers", *set_parameters, "-s", "bench", "-o",
                        "bench.vvp", ROOT / "tests/compare/icarus_bench.sv", *sources], folder)
    expect("iverilog", status == 0, said)
    status, said = run(["vvp", "bench.vvp", *(["-fst"] if fst else []), f"+inputs={inputs}", f"+wave={name}"], folder)
    expect("vvp", status == 0, said)


def compare(sim, folder, *arguments):
    status, said = run([sim, "compare", *arguments, "--shift", BEGIN, "--json", "result.json"], folder)
    expect(f"compare {arguments}", status in (0, 1), said)
    return json.loads((folder / "result.json").read_text(encoding="utf-8")), said


def scenario(sim, folder):
    (folder / "short.yaml").write_text(SCENARIO % ROOT, encoding="utf-8")
    status, said = run([sim, "run", "short.yaml", "--quiet", "--wave", "model.vcd"], folder)
    expect("run", status == 0, said)
    write_inputs(folder / "model.vcd", "io", "D", folder / "inputs.txt")
    simulate(folder, "inputs.txt", "icarus.vcd", {})
    result, said = compare(sim, folder, "model.vcd", "icarus.vcd", "--scope-a", "io", "--pins", "rtl_ref")
    expect("the scenario differs", result["equal"], said)
    compared = {each["signal"]: each["compared"] for each in result["signals"]}
    expect("not all pins of table 1 were compared", len(compared) == 17, said)
    expect("nothing happened on the pins", compared["D"] > 300 and compared["PBTXD"] > 50 and compared["L_REQ"] > 1000, said)


def fault(sim, folder):
    status, told = run([sim, "rtl-random", "--replay", ROOT / f"tests/cosim/stimuli/{STIMULUS}.stimulus", "--fault", FAULT, "--difference",
                        "lockstep.vcd"], folder)
    found = re.search(r"first difference  (cycle (\d+).*)\n +pin (\w+): model (\w), RTL (\w)", told)
    expect("the lockstep does not find the fault", status == 1 and found, told)
    write_inputs(folder / "lockstep.vcd", "inputs", "D_IN", folder / "inputs.txt")
    outputs = ["--scope-a", "model", "--scope-b", "bench.dut", "--pins", "rtl_ref"]
    simulate(folder, "inputs.txt", "right.vcd", QUICK)
    result, said = compare(sim, folder, "lockstep.vcd", "right.vcd", *outputs)
    expect("without the fault it differs", result["equal"], said)
    simulate(folder, "inputs.txt", "fault.fst", QUICK, FAULT, fst=True)
    result, said = compare(sim, folder, "lockstep.vcd", "fault.fst", *outputs)
    first = result["first"]
    expect("the fault is not found", first, said)
    expect(f"the lockstep says\n{found[0]}", first["cycle"] == int(found[2]) and first["signal"] == found[3], said)
    expect(f"the lockstep says\n{found[0]}", (first["a"], first["b"]) == (found[4], found[5]) and found[1] in said, said)


def main():
    sim = pathlib.Path(sys.argv[1]).resolve()
    for part in (scenario, fault):
        with tempfile.TemporaryDirectory(prefix="dsdpv1_icarus_") as folder:
            part(sim, pathlib.Path(folder))


main()
