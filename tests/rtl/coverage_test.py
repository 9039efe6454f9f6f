#!/usr/bin/env python3
"""The report of the RTL's coverage on made-up data: its counts, required explanations, refusals."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "rtl_ref" / "coverage.py"
SOURCE = "if (a) b = c;  // why\ncase (state)\nlogic [1:0] word;\n"


def record(page, line, name, count, instance="TOP.one", column=1):
    fields = {"f": "anywhere/rtl/block.sv", "l": line, "n": column, "page": page, "o": name, "h": instance}
    return "C '" + "".join(f"\1{key}\2{value}" for key, value in fields.items()) + f"' {count}"


class Report(unittest.TestCase):
    def report(self, records, reasons="", chip="dsdpv1"):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "rtl").mkdir()
            (folder / "rtl" / "block.sv").write_text(SOURCE, encoding="utf-8")
            (folder / "data").write_text("# SystemC::Coverage-3\n" + "".join(f"{each}\n" for each in records), encoding="utf-8")
            (folder / "reasons").write_text(reasons, encoding="utf-8")
            return subprocess.run([sys.executable, "-B", SCRIPT, "report", "data", "--sources", ".", "--reasons", "reasons",
                                   "--chip", chip],
                                  cwd=folder, capture_output=True, text=True, check=False)

    def test_counts_lines_and_toggles_apart(self):
        result = self.report([record("v_line/block", 2, "case", 5), record("v_branch/block", 1, "if", 3),
                              record("v_toggle/block", 3, "word[0]", 1), record("v_toggle/block", 3, "word[1]", 0)], "toggle | * | word[1] | a constant\n")
        self.assertIn("| `rtl_ref/rtl/block.sv` | 2 of 2, 100.0 % | 1 of 2, 50.0 % |", result.stdout)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_line_reached_in_one_instance_is_reached(self):
        result = self.report([record("v_line/block", 2, "case", 0), record("v_line/block", 2, "case", 1, "TOP.two")])
        self.assertIn("| all | 1 of 1, 100.0 % | none |", result.stdout)

    def test_branches_that_begin_in_one_line_are_counted_apart(self):
        result = self.report([record("v_branch/block", 1, "if", 1), record("v_branch/block", 1, "if", 1, column=9)])
        self.assertIn("| all | 2 of 2, 100.0 % | none |", result.stdout)

    def test_of_the_sister_chip_its_own_blocks_are_counted(self):
        shared = record("v_branch/block", 1, "if", 0)
        own = shared.replace("anywhere/rtl/", "anywhere/dsdpv1_rsu/").replace("' 0", "' 4")
        result = self.report([shared, own], chip="dsdpv1_rsu")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("| all | 1 of 1, 100.0 % | none |", result.stdout)

    def test_a_line_without_explanation_fails(self):
        result = self.report([record("v_branch/block", 1, "if", 0)], "line | rtl/block.sv | case (state) | another line\n")
        self.assertEqual(result.returncode, 1)
        self.assertIn("rtl/block.sv:1: if (a) b = c;\n    NO EXPLANATION", result.stdout)
        self.assertIn("1 lines and 0 bits without an explanation, 1 explanations of nothing", result.stdout)
        self.assertIn("explains nothing: line | rtl/block.sv | case (state) | another line", result.stdout)

    def test_an_explained_line_passes(self):
        result = self.report([record("v_branch/block", 1, "if", 0)], "# words\n\nline | rtl/block.sv | b = c | a is never 1\n")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("rtl/block.sv:1: if (a) b = c;\n    a is never 1", result.stdout)

    def test_an_else_has_a_name_of_its_own(self):
        point = [record("v_branch/block", 1, "else", 0)]
        self.assertEqual(self.report(point, "line | rtl/block.sv | else of: if (a) | a is always 1\n").returncode, 0)

    def test_bits_of_a_signal_are_explained_together(self):
        bits = [record("v_toggle/block", 3, f"word[{number}]", count) for number, count in enumerate((0, 0, 0, 4, 0))]
        result = self.report(bits, "toggle | */block.sv | wo* | a constant\n")
        self.assertIn("a constant\n    rtl/block.sv: word[4, 2:0]", result.stdout)
        self.assertIn("0 lines and 0 bits without", result.stdout)
        self.assertEqual(result.returncode, 0)

    def test_a_bit_without_explanation_fails(self):
        result = self.report([record("v_toggle/block", 3, "word[0]", 0), record("v_toggle/block", 3, "word[1]", 0)])
        self.assertIn("NO EXPLANATION\n    rtl/block.sv: word[1:0]", result.stdout)
        self.assertIn("0 lines and 2 bits without", result.stdout)
        self.assertEqual(result.returncode, 1)

    def test_a_rule_for_some_bits_leaves_the_others(self):
        bits = [record("v_toggle/block", 3, f"word[{number}]", 0) for number in range(4)]
        result = self.report(bits, "toggle | rtl/block.sv | word[3:2] | too high\n")
        self.assertIn("too high\n    rtl/block.sv: word[3:2]", result.stdout)
        self.assertIn("NO EXPLANATION\n    rtl/block.sv: word[1:0]", result.stdout)
        some = self.report(bits, "toggle | rtl/block.sv | word[3, 1:0] | not 2\n")
        self.assertIn("not 2\n    rtl/block.sv: word[3, 1:0]", some.stdout)
        self.assertIn("NO EXPLANATION\n    rtl/block.sv: word[2]", some.stdout)
        one = self.report(bits[:1], "toggle | rtl/block.sv | word[0] | odd words only\n")
        self.assertEqual(one.returncode, 0, one.stdout)

    def test_a_reason_that_explains_nothing_fails(self):
        result = self.report([record("v_toggle/block", 3, "word[0]", 1)], "toggle | rtl/block.sv | word[0] | never\n")
        self.assertIn("explains nothing: toggle | rtl/block.sv | word[0] | never", result.stdout)
        self.assertEqual(result.returncode, 1)

    def test_data_of_another_kind_are_refused(self):
        result = self.report(["nonsense"])
        self.assertEqual(result.returncode, 1)
        self.assertIn("not a record of coverage", result.stderr)

    def test_a_reason_without_words_is_refused_with_its_line(self):
        result = self.report([], "\nline | rtl/block.sv | b = c\n")
        self.assertEqual(result.returncode, 1)
        self.assertIn("reasons:2: not a reason", result.stderr)

    def test_wrong_bits_are_refused_with_their_line(self):
        for pattern in ("word[3:]", "word[a]", "word[1", "word[]"):
            result = self.report([], f"toggle | rtl/block.sv | {pattern} | a constant\n")
            self.assertEqual(result.returncode, 1)
            self.assertIn(f"reasons:1: wrong bits in {pattern}, expected", result.stderr)


if __name__ == "__main__":
    unittest.main()
