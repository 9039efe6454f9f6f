"""Modules for kinds of chips that the library does not have: generate.py of bindings/simulator with made-up ones.

    generator_test.py PACKAGE    the folder of the completed Python package; DSDPV1_LIBRARY names the library
"""
import dataclasses
import pathlib
import sys
import tempfile
import unittest

FOLDER = tempfile.TemporaryDirectory()
sys.argv = [sys.argv[0], FOLDER.name, sys.argv[-1]]
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bindings" / "simulator"))
import generate  # noqa: E402  pylint: disable=wrong-import-position

DSDPV1 = generate.kind_of("dsdpv1")


def numbered(*pins):
    return tuple(dataclasses.replace(pin, number=number) for number, pin in enumerate(pins))


class Kinds(unittest.TestCase):
    def test_one_without_rtl_has_the_ports_in_the_order_of_its_pins(self):
        kind = dataclasses.replace(DSDPV1, name="other", pins=numbered(DSDPV1.pin("PBTXD"), DSDPV1.pin("RESET"), DSDPV1.pin("D_OUT")))
        self.assertEqual(generate.top_of(kind), "other")
        text = generate.module(kind, "model")
        places = [text.index(f" {port}") for port in ("clk_i", "pbtxd_o", "reset_i", "d_o", "d_oe_o")]
        self.assertEqual(places, sorted(places))
        self.assertIn('`include "other_inputs.svh"', text)
        self.assertEqual(sorted(generate.packing([DSDPV1, kind])), ["dsdpv1_inputs.svh", "dsdpv1_outputs.svh", "other_inputs.svh", "other_outputs.svh"])

    def test_a_parameter_that_may_exceed_32_bits_is_a_longint(self):
        lines = [line for line in generate.module(generate.kind_of("xgate"), "model").splitlines() if "parameter " in line]
        self.assertIn("  parameter longint HOST_SHOWN = 64'd6000000000,", lines)
        self.assertIn("  parameter integer RATE = 115200,", lines)

    def test_one_with_the_pins_of_another_has_its_top(self):
        self.assertEqual(generate.top_of(dataclasses.replace(DSDPV1, name="other")), "dsdpv1")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
