#!/usr/bin/env python3
"""Measures the time that cocotbext.profibus adds to a simulation of the reference RTL in Icarus under cocotb, in percent. Prints ROW<TAB>VALUE.

    cocotb_speed.py FOLDER
"""
import json
import os
import pathlib
import sys

from cocotb.runner import get_results, get_runner

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RTL = ROOT / "rtl_ref"
sys.path.insert(0, str(ROOT / "examples" / "cocotb"))  # the simulation's Python gets this one's path


def build(folder):
    """The simulation, as in examples/cocotb/run.py."""
    runner = get_runner("icarus")
    runner.build(verilog_sources=[RTL / name for name in (RTL / "dsdpv1/files.txt").read_text(encoding="utf-8").split()], hdl_toplevel="dsdpv1",
                 includes=[RTL, ROOT / "registers"], defines={"SINGLE_FAULTS": 1}, parameters={"SEARCH_WINDOW_MS": 1, "READY_CYCLES": 256},
                 timescale=("1ns", "1ps"), build_dir=folder, build_args=["-g2012"])
    return runner


def run(runner, folder, test):
    """CPU seconds of one of cocotb_speed_tests.py, in a separate simulator."""
    results = runner.test(hdl_toplevel="dsdpv1", test_module="cocotb_speed_tests", test_dir=folder, build_dir=folder, testcase=test,
                          results_xml=str(folder / f"{test}.xml"), extra_env={"FAULT": "0", "COCOTB_LOG_LEVEL": "ERROR"})
    if get_results(results) != (1, 0):
        sys.exit(f"{test} failed")
    return json.loads((folder / f"{test}.json").read_text(encoding="utf-8"))


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    output = os.dup(1)
    os.dup2(2, 1)  # the simulators' output is not a row
    runner = build(folder)
    if not (folder / "stimulus.json").is_file():
        run(runner, folder, "record")
    alone = run(runner, folder, "alone")
    together = run(runner, folder, "with_the_package")
    os.write(output, f"cocotb\t{100 * (together - alone) / alone}\n".encode())


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve())
