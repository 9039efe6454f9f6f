"""Runs test_serial.py on the reference RTL of the DSDPV1-RSU in Icarus, each test in a separate simulation.

    serial_test.py FOLDER
"""
import pathlib
import sys

try:
    from cocotb_tools.runner import get_results, get_runner
except ImportError:  # cocotb 1
    from cocotb.runner import get_results, get_runner

HERE = pathlib.Path(__file__).resolve().parent
RTL = HERE.parents[1] / "rtl_ref"
TESTS = {"spi_answers_a_read_telegram": 0, "uart_answers_a_read_telegram": 0, "a_low_sck_that_is_too_short_is_found": 0,
         "the_scoreboard_finds_bits_of_miso_in_the_wrong_order": 129}  # with which fault of rtl_ref/dsdpv1_rsu/faults.txt


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    runner = get_runner("icarus")
    runner.build(sources=[RTL / name for name in (RTL / "dsdpv1_rsu/files.txt").read_text(encoding="utf-8").split()], hdl_toplevel="dsdpv1_rsu",
                 includes=[RTL, RTL.parent / "registers"], defines={"SINGLE_FAULTS": 1}, parameters={"READY_CYCLES": 256}, timescale=("1ns", "1ps"),
                 build_dir=folder, always=True, build_args=["-g2012"])
    results = {name: get_results(runner.test(hdl_toplevel="dsdpv1_rsu", test_module="test_serial", testcase=name, test_dir=folder, build_dir=folder,
                                             results_xml=str(folder / f"{name}.xml"), extra_env={"FAULT": str(fault)})) for name, fault in TESTS.items()}
    print(results)
    return 0 if set(results.values()) == {(1, 0)} else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
