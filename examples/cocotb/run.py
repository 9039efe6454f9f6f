#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the tests of test_rtl.py on the reference RTL, each in a separate simulation.

    run.py [--simulator icarus|verilator] [--test NAME]... [--fault N] [--scenario FILE] [--end MICROSECONDS] [--build FOLDER]

Examples:
    run.py
    run.py --simulator verilator --test a_master_brings_the_chip_up
    run.py --test the_pins_of_a_scenario_are_replayed --fault 48     # ends at the first cycle that differs from the model's

Exit code 0: all have passed; 1: one has failed; 2: wrong arguments.
"""
import argparse
import importlib.util
import os
import pathlib
import sys

if missing := [name for name in ("cocotb", "numpy", "dsdpv1", "cocotbext") if importlib.util.find_spec(name) is None]:
    print(f"run.py: {sys.executable} has no {', '.join(missing)}, expected a Python with dsdpv1[cocotb] (docs/cocotb.md)", file=sys.stderr)
    sys.exit(2)

try:
    from cocotb_tools.runner import get_results, get_runner
except ImportError:  # cocotb 1
    from cocotb.runner import get_results, get_runner

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RTL = ROOT / "rtl_ref"
# Each test, and the parameters of the RTL: short times, as in test_rtl.QUICK for the model, or those of the chip.
QUICK = {"SEARCH_WINDOW_MS": 1, "READY_CYCLES": 256}
TESTS = {"a_master_brings_the_chip_up": QUICK, "acyclic_requests_are_answered": QUICK, "the_pins_of_a_scenario_are_replayed": {}}
SIMULATORS = {"icarus": ["-g2012"], "verilator": ["--timing", "-Wno-fatal"]}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--simulator", choices=SIMULATORS, default="icarus")
    parser.add_argument("--test", choices=TESTS, action="append", help="left out: all; may be given more than once")
    parser.add_argument("--fault", type=int, default=0, help="a number of rtl_ref/dsdpv1/faults.txt, 0: none")
    parser.add_argument("--scenario", type=pathlib.Path, default=ROOT / "scenarios" / "power_on_12m.yaml", help="whose pins are replayed")
    parser.add_argument("--end", type=float, default=100, help="of the replay, us")
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("sim_build"), help="folder for what the simulator makes")
    return parser.parse_args()


def run(given, test):
    """Returns the number of failed tests."""
    runner, build = get_runner(given.simulator), given.build.resolve() / ("quick" if TESTS[test] else "as_the_chip")
    runner.build(sources=[RTL / name for name in (RTL / "dsdpv1/files.txt").read_text(encoding="utf-8").split()], hdl_toplevel="dsdpv1",
                 includes=[RTL, ROOT / "registers"], defines={"SINGLE_FAULTS": 1}, parameters=TESTS[test], timescale=("1ns", "1ps"), build_dir=build,
                 build_args=SIMULATORS[given.simulator])
    environment = {"MASTERS": str(ROOT / "examples" / "masters.yaml"), "FAULT": str(given.fault), "SCENARIO": str(given.scenario.resolve()), "END_US": str(given.end)}
    return get_results(runner.test(hdl_toplevel="dsdpv1", test_module="test_rtl", testcase=test, test_dir=build, build_dir=build,
                                   results_xml=str(build / f"{test}.xml"), extra_env=environment))[1]


def main():
    given = arguments()
    return 1 if sum(run(given, test) for test in given.test or TESTS) else 0


if __name__ == "__main__":
    sys.exit(main())
