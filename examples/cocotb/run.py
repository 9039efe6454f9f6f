#!/usr/bin/env python3
"""Runs test_rtl.py on the reference RTL in a simulator.

    run.py [--simulator icarus] [--fault N] [--build FOLDER] [--scenario FILE] [--end MICROSECONDS] [--test NAME]

Exit code 0: all tests passed; 1: one failed.
"""
import argparse
import os
import pathlib
import sys

from cocotb.runner import get_results, get_runner

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RTL = ROOT / "rtl_ref"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--simulator", choices=("icarus", "verilator"), default="icarus")
    parser.add_argument("--fault", type=int, default=0, help="a number of rtl_ref/faults.txt")
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("sim_build"), help="folder for what the simulator makes")
    parser.add_argument("--scenario", default=str(ROOT / "scenarios" / "power_on_12m.yaml"), help="whose pins are replayed")
    parser.add_argument("--end", type=float, default=100, help="of the replay, us")
    parser.add_argument("--test", help="one of test_rtl.py's; all")
    given = parser.parse_args()

    quick = {"SEARCH_WINDOW_MS": 1, "READY_CYCLES": 256} if given.test == "a_master_brings_the_chip_up" else {}
    runner = get_runner(given.simulator)
    build = given.build.resolve() / ("quick" if quick else "plain")
    runner.build(verilog_sources=[RTL / name for name in (RTL / "files.txt").read_text(encoding="utf-8").split()], hdl_toplevel="dsdpv1",
                 includes=[RTL, ROOT / "registers"], defines={"SINGLE_FAULTS": 1}, parameters=quick, timescale=("1ns", "1ps"), build_dir=build,
                 build_args=["-g2012"] if given.simulator == "icarus" else ["--timing", "-Wno-fatal"])
    results = runner.test(hdl_toplevel="dsdpv1", test_module="test_rtl", test_dir=HERE, build_dir=build, results_xml=str(build / "results.xml"),
                          testcase=given.test,
                          extra_env={"FAULT": str(given.fault), "SCENARIO": os.path.abspath(given.scenario), "END_US": str(given.end)})
    return 1 if get_results(results)[1] else 0


if __name__ == "__main__":
    sys.exit(main())
