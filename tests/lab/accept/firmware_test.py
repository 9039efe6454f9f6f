#!/usr/bin/env python3
"""accept of right firmware is clean at every port, and firmware that takes every configuration fails by the stimulus that offers a wrong one.

    firmware_test.py SIM GCC DEVICE_O2 CASE [--seeds N]

CASE: right (the example firmware, with the lines that docs/accept.md shows), parallel, spi, uart (the firmware of tests/firmware/owed without a
fault), wrong (a fault of it).
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
PLANTED = {"parallel": ("NONE", "parallel", []), "spi": ("NONE", "spi", ["--mode", "spi"]),
           "uart": ("NONE", "uart", ["--mode", "uart"]), "wrong": ("CFG_ACCEPTED", "parallel", [])}


def accept(sim, elf, options):
    return subprocess.run([sim, "accept", elf, *options, "--no-progress"], capture_output=True, text=True, check=False)


class NoFault:
    def __init__(self, name):
        self.name = name


def firmware(arguments, folder):
    if arguments.case in EXAMPLE:
        return arguments.device, EXAMPLE[arguments.case]
    fault, port, options = PLANTED[arguments.case]
    elf = folder / "station.elf"
    owed.build(arguments.gcc, NoFault(fault), port, elf)
    return elf, options


def without_counts(line):
    return " ".join(re.sub(r"\d+", "N", line).split())


def stale(printed):
    """A line of the page that was not printed, whatever its numbers; or None."""
    shown = PAGE.read_text().split("Of the example firmware:")[1].split("```")[1]
    lines = {without_counts(line) for line in printed.splitlines()}
    return next((line for line in shown.splitlines() if line not in ("", "...") and without_counts(line) not in lines and "----" not in line), None)


def wrong(done, case):
    if case == "right" and (line := stale(done.stdout)):
        print(f"docs/accept.md shows: {line}")
        return True
    if case != "wrong":
        return done.returncode != 0
    return done.returncode != 1 or "wrong configuration: Cfg_Fault" not in " ".join(done.stdout.split())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sim")
    parser.add_argument("gcc")
    parser.add_argument("device")
    parser.add_argument("case", choices=[*EXAMPLE, *PLANTED])
    parser.add_argument("--seeds", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        elf, options = firmware(arguments, pathlib.Path(name))
        for seed in range(1, arguments.seeds + 1):
            done = accept(arguments.sim, elf, [*options, "--seed", str(seed)])
            if wrong(done, arguments.case):
                print(f"{arguments.case}, seed {seed}: exit {done.returncode}\n{done.stdout}{done.stderr}")
                return 1
    print(f"{arguments.case}: {arguments.seeds} seeds, as expected")
    return 0


if __name__ == "__main__":
    sys.exit(main())
