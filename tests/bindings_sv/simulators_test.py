#!/usr/bin/env python3
"""The benches under simulators: the examples, each task, and the inputs of a golden trace to the model and to the reference RTL.

    simulators_test.py Verilator FOLDER SIM          FOLDER has the verilated benches
    simulators_test.py Icarus FOLDER SIM VPI         VPI: dsdpv1.vpi

Under either simulator the model's outputs must be those of the golden trace, and with a defect in the RTL its scoreboard must name the cycle, pin
and levels that `traces check` names for the same RTL in lockstep.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
GOLDEN, SLAVE = "bus_timing", "demo"
FAULT = 46  # of rtl_ref/faults.txt
END = 1_700_000_000  # ps, after that fault
INPUTS = {"RESET": 1, "R_REQ": 1, "R_STA": 1, "CSR": 1, "RD": 1, "WR": 1, "A": 11, "D_IN": 8, "PBRXD": 1}
OUTPUTS = ("L_REQ", "L_STA", "D_OUT", "INTR0", "PBTXD", "PBRTS", "PBF", "BR", "READY")


def call(command, folder):
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def golden_changes(vcd):
    """(ps, pin, level) of one slave, 'z' and 'x' for all of a pin's wires."""
    names, scope, now = {}, "", 0
    for line in vcd.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[0] == "$scope":
            scope = words[2]
        elif words[0] == "$var" and scope == SLAVE:
            names[words[3]] = words[4]
        elif line[0] == "#":
            now = int(line[1:])
        elif line[0] == "b" and words[1] in names:
            yield now, names[words[1]], words[0][1:]
        elif line[0] in "01xz" and line[1:] in names:
            yield now, names[line[1:]], line[0]


def one_line(levels):
    """The bits of a line of inputs: D as whether it is driven and its value."""
    driven = "z" not in levels["D_IN"]
    words = {**levels, "D_IN": ("1" + levels["D_IN"].rjust(8, "0")) if driven else "0" * 9}
    return "".join(words[name].rjust(width, "0") for name, width in INPUTS.items())


def write_inputs(vcd, path):
    levels, lines = {name: "0" for name in INPUTS}, {}
    for now, name, value in golden_changes(vcd):
        if name in levels and now < END:
            levels[name] = value
            lines[now] = one_line(levels)
    lines[END] = one_line(levels)
    path.write_text("".join(f"{now} {bits}\n" for now, bits in lines.items()), encoding="ascii")


def settled(changes):
    """{ps: levels of all outputs} at the times at which one differs from before, from the first release of RESET on."""
    now_levels, at = {}, {}
    for now, name, value in changes:
        if now < END:
            now_levels[name] = value
            at[now] = dict(now_levels)
    return at


def golden_outputs(vcd):
    chosen = [(now, name, value) for now, name, value in golden_changes(vcd) if name in OUTPUTS]
    return settled(chosen)


def model_outputs(path):
    lines = {}
    for line in path.read_text(encoding="ascii").splitlines():
        now, bits = line.split()
        d_out = "z" if bits[2] == "0" else "x" if "x" in bits[3:11] else bits[3:11]
        values = [bits[0], bits[1], d_out, *bits[11:17]]
        if int(now) < END:
            lines[int(now)] = dict(zip(OUTPUTS, values))
    return lines


def same_level(golden, seen):
    """A D that the golden leaves open may be anything but released: a simulator of two levels has no X."""
    if "x" in golden:
        return seen != "z"
    return golden.lstrip("0") == seen.lstrip("0") if "z" not in golden else seen == "z"


def without_repeats(lines):
    kept, before = {}, None
    for now in sorted(lines):
        if lines[now] != before:
            kept[now] = before = lines[now]
    return kept


class Benches:
    """What both simulators have to do; a subclass says how a bench is run."""

    def passes(self, top, *plusargs, name=None):
        status, said = self.run_bench(name or top, top, *plusargs)
        self.assertEqual(status, 0, said)
        self.assertIn("passed", said)
        return said

    def test_a_master_brings_the_model_to_data_exchange(self):
        said = self.passes("data_exchange")
        self.assertIn("outputs ddccbbaa, inputs 44332211", said)

    def test_each_task_of_the_master_ends_with_its_outcome(self):
        said = self.passes("services", f"+gsd={ROOT}/scenarios/dsdpv1.gsd")
        self.assertEqual(said.count(": passed"), 5)
        return said

    def test_a_scenario_drives_its_masters_by_itself(self):
        said = self.passes("scenario")
        for words in ("masters.yaml: left out are slaves, chip, checks, expect, allow and end; of the script, by line: pause_user (", "c1_read: 11 22 33 44",
                      "c1_write: done", "c2_read: AA BB CC", "c2_transport: 01 02 03 04 05"):
            self.assertIn(words, said)

    def test_golden_inputs_give_golden_outputs_and_the_rtl_is_equal(self):
        self.with_golden(self.golden_is_kept)

    def golden_is_kept(self, folder):
        said = self.replay_is_golden(folder, "replay")
        self.assertGreater(int(re.search(r"equal: (\d+) changes", said).group(1)), 5000)

    def replay_is_golden(self, folder, name):
        status, said = self.run_bench(name, "replay", f"+inputs={folder}/inputs.txt", f"+outputs={folder}/outputs.txt")
        self.assertEqual(status, 0, said)
        golden = without_repeats(golden_outputs(folder / "golden.vcd"))
        seen = without_repeats(model_outputs(folder / "outputs.txt"))
        released = min(now for now in golden if now > 0)
        times = sorted(now for now in set(golden) | set(seen) if now >= released)
        self.assertGreater(len(times), 3000)
        now_golden, now_seen = golden[0], None
        for now in times:
            now_golden, now_seen = golden.get(now, now_golden), seen.get(now, now_seen)
            different = [name for name in OUTPUTS if not same_level(now_golden[name], now_seen[name])]
            self.assertEqual(different, [], f"at {now} ps: golden {now_golden}, here {now_seen}")
        return said

    def test_the_scoreboard_names_what_the_lockstep_names(self):
        self.with_golden(self.defect_is_named)

    def defect_is_named(self, folder):
        _, told = call([SIM, "traces", "check", GOLDEN, "--engine", "rtl", "--fault", FAULT, "--no-progress"], ROOT)
        lockstep = re.search(r"first difference  (cycle \d+ .*)\n +pin (\w+) of \w+: golden (?:still )?(\w), here (\w)\n", told)
        self.assertTrue(lockstep, told)
        status, said = self.run_bench("replay", "replay", f"+inputs={folder}/inputs.txt", f"+fault={FAULT}")
        self.assertNotEqual(status, 0, said)
        place, pin, golden, here = lockstep.groups()
        self.assertIn(f"first difference at {place}: {pin} is {here}, the model's is {golden}", said)

    def with_golden(self, check):
        with tempfile.TemporaryDirectory(prefix="dsdpv1_replay_") as name:
            folder = pathlib.Path(name)
            status, said = call([SIM, "traces", "wave", GOLDEN, folder / "golden.vcd"], ROOT)
            self.assertEqual(status, 0, said)
            write_inputs(folder / "golden.vcd", folder / "inputs.txt")
            check(folder)


class Verilator(Benches, unittest.TestCase):
    def run_bench(self, name, top, *plusargs):
        return call([FOLDER / name / f"V{top}", *plusargs], ROOT)

    def test_golden_inputs_give_golden_outputs_without_clk(self):
        self.with_golden(lambda folder: self.replay_is_golden(folder, "replay_unclocked"))

    def test_scoreboard_and_bound_assertions_beside_the_rtl_of_the_example(self):
        said = self.passes("data_exchange", name="data_exchange_rtl")
        self.assertRegex(said, r"the scoreboard has seen \d{4,} changes, all alike")

    def test_a_planted_defect_stops_the_example(self):
        status, said = self.run_bench("data_exchange_rtl", "data_exchange", f"+fault={FAULT}")
        self.assertNotEqual(status, 0)
        shown = re.search(r"^```\n(first difference at .*?)^```", (ROOT / "docs/systemverilog.md").read_text(encoding="utf-8"), re.M | re.S)
        self.assertIn(shown.group(1), said)

    def test_each_assertion_can_fail(self):
        source = (ROOT / "bindings/systemverilog/dsdpv1_assertions.sv").read_text(encoding="utf-8")
        names = [*re.findall(r"^  `DSDPV1_HOLDS\((\w+),", source, re.M), "outputs_in_reset", "d_released_in_reset"]
        self.assertEqual(len(names), 13)
        self.passes("assertions")
        for name in names:
            status, said = self.run_bench("assertions", "assertions", f"+broken={name}")
            self.assertNotEqual(status, 0, name)
            self.assertIn(f"u_assertions.{name}:", said)


class Icarus(Benches, unittest.TestCase):
    def run_bench(self, name, top, *plusargs):
        source = next(path for path in (ROOT / f"examples/systemverilog/{top}.sv", ROOT / f"tests/bindings_sv/{top}.sv") if path.exists())
        rtl = self.rtl() if top == "replay" else []
        bindings = ROOT / "bindings/systemverilog"
        sources = [bindings / line for line in (bindings / "files.txt").read_text(encoding="ascii").split()]
        with tempfile.TemporaryDirectory(prefix="dsdpv1_icarus_") as folder:
            status, said = call(["iverilog", "-g2012", "-DDSDPV1_VPI", "-DDSDPV1_IMMEDIATE", "-I", bindings, "-I", ROOT / "rtl_ref", "-I", ROOT / "registers",
                                 "-s", top, "-o", "bench.vvp", VPI, *sources, *rtl, source], folder)
            self.assertEqual((status, said), (0, ""))
            return call(["vvp", pathlib.Path(folder) / "bench.vvp", *plusargs], ROOT)

    def rtl(self):
        return ["-DUSE_RTL", "-DSINGLE_FAULTS", *(ROOT / "rtl_ref" / line for line in (ROOT / "rtl_ref/files.txt").read_text(encoding="ascii").split())]


if __name__ == "__main__":
    FOLDER, SIM = pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve()
    VPI = pathlib.Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None
    unittest.main(argv=[sys.argv[0], "-v", sys.argv[1]])
