"""Runs test_parts.py, test_pins.py and test_spc3.py in Icarus, and checks that a too coarse precision is rejected.

    parts_test.py FOLDER
"""
import pathlib
import sys

try:
    from cocotb_tools.runner import get_results, get_runner
except ImportError:  # cocotb 1
    from cocotb.runner import get_results, get_runner

HERE = pathlib.Path(__file__).resolve().parent


def run(folder, precision="1ps", top="wires", module="test_parts", **options):
    """(tests, failures)."""
    folder.mkdir(parents=True, exist_ok=True)
    runner = get_runner("icarus")
    runner.build(sources=[HERE / "wires.sv"], hdl_toplevel=top, timescale=("1ns", precision), build_dir=folder, always=True,
                 build_args=["-g2012"])
    return get_results(runner.test(hdl_toplevel=top, test_module=module, test_dir=folder, build_dir=folder,
                                   results_xml=str(folder / "results.xml"), **options))


if __name__ == "__main__":
    place = pathlib.Path(sys.argv[1])
    parts, pins = run(place / "parts"), run(place / "pins", top="pins_only", module="test_pins")
    spc3 = run(place / "spc3", top="spc3_pins_only", module="test_spc3")
    coarse = run(place / "coarse", "100ps", testcase="edges_of_the_clock_are_at_their_ticks")
    print(f"tests and failures: parts {parts}, pins {pins}, SPC3 {spc3}, at a precision of 100 ps {coarse}")
    sys.exit(0 if (parts, pins, spc3, coarse) == ((5, 0), (5, 0), (2, 0), (1, 1)) else 1)
