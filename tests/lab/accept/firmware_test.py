#!/usr/bin/env python3
"""accept of right firmware is clean at every port, and faults of firmware fail by the stimulus that is about them.

    firmware_test.py SIM GCC DEVICE_O2 CASE

CASE: right (the example firmware, with the lines that docs/accept.md shows), parallel, spi, uart (the firmware of tests/firmware/owed without a
fault), others: faults of it.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

OWED = pathlib.Path(__file__).resolve().parents[2] / "firmware" / "owed"
sys.path.insert(0, str(OWED))
import owed  # noqa: E402

EXAMPLE = {"right": []}
PAGE = pathlib.Path(__file__).resolve().parents[3] / "docs" / "accept.md"
SPOILT = ["--only", "spoilt blocks", "--only", "spoilt requests"]
# Case: fault, port, options, and what tells it from right firmware. Over SPI the flags that the firmware writes back may be the wrong bits.
PLANTED = {"parallel": ("NONE", "parallel", [], ""),
           "spi": ("NONE", "spi", ["--mode", "spi", *SPOILT, "--only", "outputs", "--only", "newer block", "--only", "restart"], ""),
           "uart": ("NONE", "uart", ["--mode", "uart"], ""),
           "wrong": ("CFG_ACCEPTED", "parallel", ["--only", "wrong configuration"], "wrong configuration: Cfg_Fault at least 4; seen: 0 times"),
           "unjudged_parallel": ("CRC_UNJUDGED", "parallel", SPOILT, "spoilt blocks: right parameters or configuration refused never"),
           "unjudged_spi": ("CRC_UNJUDGED", "spi", ["--mode", "spi", *SPOILT],
                            r"spoilt blocks(: right parameters or configuration refused never| wrong bits read \d+ VIOLATED: \d+ HOST_SETS_BIT)"),
           "unjudged_uart": ("CRC_UNJUDGED", "uart", ["--mode", "uart", *SPOILT], "spoilt requests: answers at least 4")}


def accept(sim, elf, options):
    return subprocess.run([sim, "accept", elf, *options, "--no-progress"], capture_output=True, text=True, check=False)


def firmware(arguments, folder):
    if arguments.case in EXAMPLE:
        return arguments.device, EXAMPLE[arguments.case]
    fault, port, options, _ = PLANTED[arguments.case]
    elf = folder / "station.elf"
    next(each for each in owed.faults(False) if each.name == fault).build(arguments.gcc, port, elf)
    return elf, options


def without_counts(line):
    """Nor whether chance met it."""
    return " ".join(re.sub(r"\d+", "N", line).removesuffix("not met").split())


def stale(printed):
    """A line of the page that was not printed, whatever its numbers; or None."""
    shown = PAGE.read_text().split("Of the example firmware:")[1].split("```")[1]
    lines = {without_counts(line) for line in printed.splitlines()}
    return next((line for line in shown.splitlines() if line not in ("", "...") and without_counts(line) not in lines and "----" not in line), None)


def wrong(done, case):
    if case == "right" and (line := stale(done.stdout)):
        print(f"docs/accept.md shows: {line}")
        return True
    told = PLANTED[case][3] if case in PLANTED else ""
    return done.returncode != (1 if told else 0) or not re.search(told, " ".join(done.stdout.split()))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sim")
    parser.add_argument("gcc")
    parser.add_argument("device")
    parser.add_argument("case", choices=[*EXAMPLE, *PLANTED])
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        elf, options = firmware(arguments, pathlib.Path(name))
        done = accept(arguments.sim, elf, options)
    if wrong(done, arguments.case):
        print(f"{arguments.case}: exit {done.returncode}\n{done.stdout}{done.stderr}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
