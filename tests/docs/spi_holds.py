#!/usr/bin/env python3
"""How long a host over SPI holds the DPRAM for an acyclic request of 240 bytes: the table in docs/programmers_guide.md is what runs of dsdpv1-sim give.

    spi_holds.py SIM FIRMWARE            compares the rows; those of the ARM board where FIRMWARE, the folder of the example firmware, has its file
    spi_holds.py SIM FIRMWARE --write    writes the table

Exit 1 when a row is another, or a run fails.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import guide

HEAD = ("| host | longest hold | least Min_Slave_Intervall |\n"
        "|---|---|---|\n")
LATEST_NS = 250  # after a release's last bit the chip takes outputs that wait (H3, SP12): the limit of B014_HOLD_INTERVAL
# What a row is called: scenario and settings.
HOSTS = {f"bench's, SCK of {clock} kHz": ("rsu_spi", "user_cpu.spi.clock", str(clock)) for clock in (9000, 4500, 2250, 1125)}
BOARD = {"STM32F103 at 72 MHz, 9 MHz, polls, -O2": "device_O2", "... has interrupts": "device_interrupts", "... polls, -O0": "device_O0"}


def hosts(firmware):
    """Those that can be run here."""
    yield from HOSTS.items()
    yield from ((name, ("arm_spi", "user_cpu.elf", str(firmware / f"{elf}.elf"))) for name, elf in BOARD.items() if (firmware / f"{elf}.elf").exists())


def longest_hold_ns(sim, scenario, key, value):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_spi_hold_") as folder:
        result = pathlib.Path(folder) / "result.json"
        done = subprocess.run([sim, "run", guide.ROOT / "scenarios" / f"{scenario}.yaml", "--set", f"{key}={value}", "--set", "masters.plc.bus.min_slave_interval=2500",
                               "--checks", "off", "--quiet", "--result", result], check=False, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{scenario} with {key}={value}: exit {done.returncode}\n{done.stdout}{done.stderr}")
        return json.loads(result.read_text(encoding="utf-8"))["slaves"][0]["handshake"]["user_longest_hold_ns"]


def row(sim, name, run):
    hold = longest_hold_ns(sim, *run)
    units = math.ceil((hold + LATEST_NS) / 100_000)  # of 100 us, as a GSD file has them
    return f"| {name} | {hold / 1000:.0f} us | {units} ({100 * units} us) |\n"


def main():
    sim, firmware = (pathlib.Path(each).resolve() for each in sys.argv[1:3])
    rows = [row(sim, name, run) for name, run in hosts(firmware)]
    block = guide.Block("spi_holds", "table of holds over SPI is stale")
    if sys.argv[3:] == ["--write"]:
        if len(rows) < len(HOSTS) + len(BOARD):
            sys.exit(f"{firmware} has not all of the example firmware: cmake --build build/default --target dsdpv1_firmware")
        block.write(HEAD + "".join(rows))
        return
    if stale := [line for line in rows if line not in block.text]:
        block.refuse("a run gives\n" + "".join(stale))


if __name__ == "__main__":
    main()
