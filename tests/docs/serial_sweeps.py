#!/usr/bin/env python3
"""Where the handshake over SPI and the UART holds: the tables in docs/programmers_guide.md are what sweeps of dsdpv1-sim give.

    serial_sweeps.py SIM            runs the sweeps and compares their tables
    serial_sweeps.py SIM --write    runs them and writes the tables

Exit 1 when a table is another, or a sweep fails.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

import guide

NOT_CHECKED = "no data exchange"  # the expectation that the scenario has


class Sweep:
    """Along `swept` lies the region, with a row for each value of `other`; each of the two is a key, its values and what the table calls it."""

    def __init__(self, scenario, swept, other, *settings):
        self.scenario, self.swept, self.other, self.settings = scenario, swept, other, settings

    def command(self):
        words = [f"scenarios/{self.scenario}.yaml"]
        for setting in self.settings:
            words += ["--set", setting]
        for key, values, _ in (self.swept, self.other):
            words += ["--param", f"{key}={values}"]
        return words


CLOCKS = ("user_cpu.spi.clock", "1000,2000,4000,8000,9000,9100,10000,12000", "SCK / kHz")
SWEEPS = [
    Sweep("rsu_spi_timing", CLOCKS, ("user_cpu.spi.byte_gap", "0us,500ns,1us,2us", "gap between bytes")),
    Sweep("rsu_spi_timing", CLOCKS, ("user_cpu.spi.gap", "500ns,20us,100us", "gap between frames")),
    Sweep("rsu_uart_timing", ("user_cpu.uart.gap", "0us,20us,21us,83us,84us,166us,167us", "gap between characters"),
          ("chip.uart_rate", "230.4k,460.8k,1.8432M", "rate / (bit/s)"), "end=130ms", "masters.plc.start=35ms", "user_cpu.cycle=20ms"),
    Sweep("rsu_uart_timing", ("user_cpu.uart.rate", "430000..490000/5000", "host's rate / (bit/s), the chip's is 460.8k"),
          ("user_cpu.uart.gap", "0us,10us", "gap between characters"), "chip.uart_rate=460.8k", "end=35ms", "masters.plc.start=8ms", "user_cpu.cycle=2ms"),
]


def points(sim, sweep, folder):
    """The rows of results.csv, by the value of the other parameter, in the order of the swept one."""
    done = subprocess.run([sim, "sweep", *sweep.command(), "--no-progress", "--out", folder], cwd=guide.ROOT, check=False, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{sweep.scenario}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    rows = {}
    with (folder / "results.csv").open(encoding="utf-8", newline="") as file:
        for point in csv.DictReader(file):
            rows.setdefault(point[sweep.other[0]], []).append(point)
    return rows


def first_broken(point):
    return f"`{point['first_violation']}`" if point["first_violation"] else NOT_CHECKED


def row(sweep, value, line):
    """Its region, and the first check that fails on either side of it."""
    holds = [i for i, point in enumerate(line) if point["holds"] == "yes"]
    if not holds:
        return f"| {value} | none | {first_broken(line[0])} | {first_broken(line[-1])} |\n"
    first, last = holds[0], holds[-1]
    if len(holds) != last - first + 1:
        sys.exit(f"{' '.join(sweep.command())}: at {value} it holds in more than one region")
    region = " to ".join(dict.fromkeys(line[i][sweep.swept[0]] for i in (first, last)))
    below = f"{line[first - 1][sweep.swept[0]]}: {first_broken(line[first - 1])}" if first > 0 else "-"
    above = f"{line[last + 1][sweep.swept[0]]}: {first_broken(line[last + 1])}" if last + 1 < len(line) else "-"
    return f"| {value} | {region} | {below} | {above} |\n"


def table(sim, sweep):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_serial_sweep_") as folder:
        rows = points(sim, sweep, pathlib.Path(folder, "out"))
    text = f"```\ndsdpv1-sim sweep {' '.join(sweep.command())}\n```\n\n"
    text += f"| {sweep.other[2]} | {sweep.swept[2]} where it holds | below | above |\n|---|---|---|---|\n"
    return text + "".join(row(sweep, value, line) for value, line in rows.items())


def main():
    sim, write = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:] == ["--write"]
    block = guide.Block("serial_sweeps", "tables of the sweeps are stale")
    found = "\n".join(table(sim, sweep) for sweep in SWEEPS)
    if write:
        block.write(found)
    elif block.text != found:
        block.refuse(f"sweeps give\n{found}")


if __name__ == "__main__":
    main()
