#!/usr/bin/env python3
"""The benches under simulators: each task, a scenario's masters, and the inputs of a golden trace to the reference RTL with a defect.

    simulators_test.py Verilator FOLDER SIM          FOLDER has the verilated benches
    simulators_test.py Icarus FOLDER SIM VPI         VPI: dsdpv1.vpi
    simulators_test.py Vhdl FOLDER SIM VPI           RTL in VHDL, which GHDL turns into Verilog

With a defect in the RTL its scoreboard must name the same cycle, pin and levels as `traces check` for the same RTL in lockstep. tests/every_way
checks that the model's outputs match the golden trace.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from golden import END, GOLDEN, write_inputs

ROOT = pathlib.Path(__file__).resolve().parents[2]
FAULT = 46  # of rtl_ref/dsdpv1/faults.txt
EARLY, EARLY_END = 48, 200_000_000  # another, which is seen at 65 us; ps
OF_THE_R = ("-DMODEL=dsdpv1_r_model", "-DSCOREBOARD=dsdpv1_r_scoreboard")
RSU_FAULT = 129  # of rtl_ref/dsdpv1_rsu/faults.txt: bits of a reply in the other order


def call(command, folder):
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class Benches:
    """Requirements for both simulators; a subclass defines how a bench is run."""

    def passes(self, top, *plusargs, name=None):
        status, said = self.run_bench(name or top, top, *plusargs)
        self.assertEqual(status, 0, said)
        self.assertIn("passed", said)
        return said

    def test_each_task_of_the_master_ends_with_its_outcome(self):
        said = self.passes("services", f"+gsd={ROOT}/scenarios/dsdpv1.gsd")
        self.assertEqual(said.count(": passed"), 5)
        return said

    def test_a_scenario_drives_its_masters_by_itself(self):
        said = self.passes("scenario")
        for words in ("masters.yaml: left out are slaves, chip, checks, expect, allow and end; of the script, by line: pause_user (", "c1_read: 11 22 33 44",
                      "c1_write: done", "c2_read: AA BB CC", "c2_transport: 01 02 03 04 05"):
            self.assertIn(words, said)

    def test_the_scoreboard_names_what_the_lockstep_names(self):
        with_golden(self, self.defect_is_named)

    def test_the_scoreboard_of_the_r_names_what_the_lockstep_names(self):
        def check(folder):
            status, said = self.run_bench("replay_r", "replay", f"+inputs={folder}/inputs.txt")
            self.assertEqual(status, 0, said)
            self.assertRegex(said, r"equal: \d\d+ changes")
            self.defect_is_named(folder, "replay_r", EARLY)

        with_golden(self, check, EARLY_END)

    def defect_is_named(self, folder, bench="replay", fault=FAULT):
        _, told = call([SIM, "traces", "check", GOLDEN, "--engine", "rtl", "--fault", fault, "--no-progress"], ROOT)
        lockstep = re.search(r"first difference  (cycle \d+ .*)\n +pin (\w+) of \w+: golden (?:still )?(\w), here (?:still )?(\w)\n", told)
        self.assertTrue(lockstep, told)
        status, said = self.run_bench(bench, "replay", f"+inputs={folder}/inputs.txt", f"+fault={fault}")
        self.assertNotEqual(status, 0, said)
        place, pin, golden, here = lockstep.groups()
        self.assertIn(f"first difference at {place}: {pin} is {here}, the model's is {golden}", said)

    def test_the_rsu_answers_at_both_serial_ports(self):
        for mode in (1, 2):
            said = self.passes("serial", f"+mode={mode}")
            self.assertIn("reply 8100c5bbe1\nviolations 0, rules applied", said)
        self.assertRegex(self.passes("serial", "+mode=1", "+short_clock"), "violations [1-9]")

    def test_the_scoreboard_of_the_rsu_sees_its_serial_pins(self):
        for mode in (1, 2):
            self.assertRegex(self.passes("serial", f"+mode={mode}", name="serial_rtl"), r"the scoreboard has seen \d\d changes, all alike")
        status, said = self.run_bench("serial_rtl", "serial", "+mode=1", f"+fault={RSU_FAULT}")
        self.assertNotEqual(status, 0, said)
        self.assertIn("first difference at cycle 10003 + 170 ticks (208.410 us): MISO is 0, the model's is 1\n  last input  SCK=0 at cycle 10003 + 50 ticks", said)


def with_golden(test, check, end=END):
    """check(folder), where the folder has the golden's inputs up to a time."""
    with tempfile.TemporaryDirectory(prefix="dsdpv1_replay_") as name:
        folder = pathlib.Path(name)
        status, said = call([SIM, "traces", "wave", GOLDEN, folder / "golden.vcd"], ROOT)
        test.assertEqual(status, 0, said)
        write_inputs(folder / "golden.vcd", folder / "inputs.txt", end)
        check(folder)


class Verilator(Benches, unittest.TestCase):
    def run_bench(self, name, top, *plusargs):
        return call([FOLDER / name / f"V{top}", *plusargs], ROOT)

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


def compiled(folder, name, top, rtl):
    """For Icarus; the exit code and what it said."""
    bindings = VPI.parent / "systemverilog"
    sources = [bindings / line for line in (bindings / "files.txt").read_text(encoding="ascii").split()]
    return call(["iverilog", "-g2012", "-DDSDPV1_VPI", "-DDSDPV1_IMMEDIATE", "-I", bindings, "-I", ROOT / "rtl_ref", "-I", ROOT / "registers",
                 "-s", top, "-o", f"{name}.vvp", VPI, *sources, *rtl, ROOT / f"tests/bindings_sv/{top}.sv"], folder)


class Icarus(Benches, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="dsdpv1_icarus_")))

    def run_bench(self, name, top, *plusargs):
        if not (self.folder / f"{name}.vvp").exists():
            self.compile(name, top)
        return call(["vvp", self.folder / f"{name}.vvp", *plusargs], ROOT)

    def compile(self, name, top):
        rtl = {"replay": self.rtl("dsdpv1"), "replay_r": [*OF_THE_R, *self.rtl("dsdpv1")], "serial_rtl": self.rtl("dsdpv1_rsu")}.get(name, [])
        self.assertEqual(compiled(self.folder, name, top, rtl), (0, ""))

    def test_the_checker_names_a_write_strobe_that_is_too_short(self):
        status, said = self.run_bench("violations", "violations")
        self.assertEqual((status, said.splitlines()[0]), (0, "violations 0, rules applied 17 times"))
        status, said = self.run_bench("violations", "violations", "+short")
        self.assertIn("u_checker.report: TIMING_TS at cycle 9673 + 50 ticks (201.525 us): 5.000 ns of at least 12.500 ns, writing B006 [table 15, P5]\n", said)
        self.assertIn("violations 1, rules", said)

    @staticmethod
    def rtl(chip):
        return ["-DUSE_RTL", "-DSINGLE_FAULTS", *(ROOT / "rtl_ref" / line for line in (ROOT / "rtl_ref" / chip / "files.txt").read_text(encoding="ascii").split())]


class Vhdl(unittest.TestCase):
    def test_the_scoreboard_sees_rtl_in_vhdl(self):
        with_golden(self, self.a_dead_chip_differs, EARLY_END)

    def a_dead_chip_differs(self, folder):
        status, said = call(["ghdl", "-a", ROOT / "tests/bindings_sv/dead_chip.vhd"], folder)
        self.assertEqual(status, 0, said)
        status, verilog = call(["ghdl", "--synth", "--out=verilog", "dsdpv1"], folder)
        self.assertEqual(status, 0, verilog)
        (folder / "chip.v").write_text(verilog, encoding="utf-8")
        self.assertEqual(compiled(folder, "replay", "replay", ["-DUSE_RTL", folder / "chip.v"]), (0, ""))
        status, said = call(["vvp", "replay.vvp", "+inputs=inputs.txt"], folder)
        self.assertNotEqual(status, 0, said)
        self.assertRegex(said, r"first difference at cycle \d+ .*: L_REQ is 0, the model's is 1")


if __name__ == "__main__":
    FOLDER, SIM = pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve()
    VPI = pathlib.Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None
    unittest.main(argv=[sys.argv[0], "-v", sys.argv[1]])
