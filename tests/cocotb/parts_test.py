"""Runs test_parts.py in Icarus, and looks whether a precision that is too coarse is refused.

    parts_test.py FOLDER
"""
import pathlib
import sys

from cocotb.runner import get_results, get_runner

HERE = pathlib.Path(__file__).resolve().parent


def run(folder, precision, **options):
    """(tests, failures)."""
    runner = get_runner("icarus")
    runner.build(verilog_sources=[HERE / "wires.sv"], hdl_toplevel="wires", timescale=("1ns", precision), build_dir=folder, always=True,
                 build_args=["-g2012"])
    return get_results(runner.test(hdl_toplevel="wires", test_module="test_parts", test_dir=folder, build_dir=folder,
                                   results_xml=str(folder / "results.xml"), **options))


if __name__ == "__main__":
    place = pathlib.Path(sys.argv[1])
    (place / "coarse").mkdir(parents=True, exist_ok=True)
    tests, failures = run(place, "1ps")
    coarse = run(place / "coarse", "100ps", testcase="edges_of_the_clock_are_at_their_ticks")
    print(f"{tests} tests, {failures} failures; at 100 ps {coarse[1]} of {coarse[0]} refused")
    sys.exit(0 if tests == 5 and failures == 0 and coarse == (1, 1) else 1)
