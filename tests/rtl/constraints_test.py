#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""rtl_ref/constraints.py finds nothing in the constraints of both tops, and finds what it has to in broken ones."""
import pathlib
import sys
import unittest

RTL = pathlib.Path(__file__).resolve().parents[2] / "rtl_ref"
sys.path.insert(0, str(RTL))
import constraints  # noqa: E402


class Constraints(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        modules = {top: constraints.netlist(top, RTL) for top in constraints.TOPS}
        cls.designs = {top: (constraints.Design(module), set(module["ports"])) for top, module in modules.items()}

    def found(self, top, lines):
        return list(constraints.faults(top, lines, *self.designs[top]))

    def test_both_tops_have_what_they_need(self):
        for top in constraints.TOPS:
            self.assertEqual(self.found(top, constraints.read(top)), [])

    def test_each_exception_and_clock_is_needed(self):
        top = "dsdpv1_rsu"
        lines = constraints.read(top)
        for line in lines:
            needed = line.command == "create_clock" or (" -from " in line.text and " -hold " not in line.text)
            if needed or "-max 12.5 [get_ports {a_i" in line.text or "-max 87.5" in line.text:
                twin = " -min " if line.command == "set_input_delay" else None
                rest = [each for each in lines if each is not line and not (twin and twin in each.text and each.names() == line.names())]
                with self.subTest(line=line.where):
                    self.assertTrue(self.found(top, rest))

    def test_unknown_names_and_exceptions_without_a_reason_are_found(self):
        lines = constraints.read("dsdpv1")
        extra = constraints.Line("x.sdc:1", "set_false_path -from [get_ports wr_ii] -to [get_cells u_host_port${h}gone*]", False)
        said = "\n".join(self.found("dsdpv1", [*lines, extra]))
        for each in ("x.sdc:1: dsdpv1 has no wr_ii", "x.sdc:1: dsdpv1 has no u_host_port.gone*", "x.sdc:1: no reason in the line before it"):
            self.assertIn(each, said)


if __name__ == "__main__":
    unittest.main()
