#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""rtl_ref/crossings.py finds what it has to: a crossing that is new, a second reader of a first flip-flop, a row too many and one too few."""
import pathlib
import shutil
import sys
import tempfile
import unittest

RTL = pathlib.Path(__file__).resolve().parents[2] / "rtl_ref"
sys.path.insert(0, str(RTL))
import crossings  # noqa: E402

PORT, HANDSHAKE = "dsdpv1/host_port.sv", "dsdpv1/handshake.sv"
DEFECTS = (  # file, old text, new text, what has to be found
    ("profibus/station.sv", ".rxd_i(rxd), .run_i(run)", ".rxd_i(pbrxd_i), .run_i(run)", "pbrxd_i from pin to CLK is taken by u_station.u_uart_rx"),
    (HANDSHAKE, "r_sta_i : r_sta_seen", "r_sta_seen : r_sta_i", "r_sta_i"),
    (PORT, "gray_q <= gray_first_q;", "gray_q <= head_gray_q;", "is taken by u_host_port.gray_q, too"),
    (PORT, "if (!driven_q) d_q", "if (taken_q && !driven_q) d_q", "u_host_port.taken_q is the first of two flip-flops and is read by u_host_port.d_q, u_host_port.driven_q"),
    (PORT, "assign d_oe_o = reads && open_q;", "assign d_oe_o = reads && open_q && !wr_i;", "wr_i crosses from pin to pin"),
    (PORT, "if (takes) begin\n      case", "if (takes && !driven_q) begin\n      case", "u_host_port.driven_q crosses from CLK to WR"),
)


def found(root, rows):
    return list(crossings.faults({"dsdpv1": crossings.Design(crossings.netlist("dsdpv1", root))}, rows))


class Crossings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.designs = {top: crossings.Design(crossings.netlist(top, RTL)) for top in crossings.TOPS}
        cls.rows = crossings.table(crossings.PAGE)

    def test_the_table_has_those_of_both_tops_and_no_other(self):
        self.assertEqual(list(crossings.faults(self.designs, self.rows)), [])

    def test_each_row_is_needed(self):
        for row in self.rows:
            with self.subTest(row=row.title()):
                rest = [each for each in self.rows if each is not row]
                self.assertTrue(any("the table does not have it" in each for each in crossings.faults(self.designs, rest)))

    def test_a_row_without_a_crossing_is_found(self):
        row = crossings.Row("intr0_o", "CLK", "WR", ("u_host_port.head_q",), "none")
        self.assertIn("the table has intr0_o from CLK to WR; the RTL has not", list(crossings.faults(self.designs, [*self.rows, row])))

    def test_new_crossings_are_found(self):
        for file, old, new, message in DEFECTS:
            with self.subTest(new=new), tempfile.TemporaryDirectory() as folder:
                root = pathlib.Path(folder) / "rtl"
                shutil.copytree(RTL, root)
                text = (root / file).read_text(encoding="utf-8")
                self.assertEqual(text.count(old), 1)
                (root / file).write_text(text.replace(old, new), encoding="utf-8")
                self.assertTrue(any(message in each for each in found(root, self.rows)), found(root, self.rows))


if __name__ == "__main__":
    unittest.main()
