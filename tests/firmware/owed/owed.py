#!/usr/bin/env python3
"""Firmware with each fault of faults.h runs against the chip: none may pass unless it says why no observer can know, and the run names the line.

    owed.py SIM GCC [--ports PS] [--faults NAME,...] [--table FILE]

A row for each fault and port: verdict, codes, the marked line or function, and the one that the run reports for them.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
FLAGS = ["-mcpu=cortex-m3", "-mthumb", "-O2", "-g", "-fno-inline", "-ffreestanding", "-nostdlib", "-Wall", "-Wextra", "-Wconversion", "-Werror",
         f"-Wl,-T,{HERE}/station.ld", "-Wl,--build-id=none"]
PORTS = {"P": "parallel", "S": "spi", "U": "uart"}
FAULT = re.compile(r'X\((\w+), "(\w+)", (\w+), "([^"]*)"\)')
SOURCES = {"parallel": ["blocks.c", "parallel.c"], "spi": ["blocks.c", "spi.c"], "uart": ["uart.c"]}


def sources(port):
    return [HERE / name for name in ["board.c", "cells.c", "station.c", *SOURCES[port]]]


class Fault:
    def __init__(self, name, ports, kind, what):
        self.name, self.ports, self.kind, self.what = name, ports, kind, what

    def marks(self, port):
        """The statements after a comment with TELLS(name), as file:line."""
        found = []
        for source in sources(port):
            lines = source.read_text().splitlines()
            for number, line in enumerate(lines):
                if f"TELLS({self.name})" in line:
                    while "*/" not in lines[number]:
                        number += 1
                    found.append(f"{source.name}:{number + 2}")
        return found


def faults():
    return [Fault(*row) for row in FAULT.findall((HERE / "faults.h").read_text())]


def build(gcc, fault, port, elf):
    volatile = ["-DPLANTED_NOT_VOLATILE"] if fault.name == "NOT_VOLATILE" else []
    subprocess.run([gcc, *FLAGS, f"-DPLANTED={fault.name}", *volatile, *sources(port), "-lgcc", "-o", elf], check=True)


def places(result):
    """(code, file:line, function) of what the firmware did, in the order of the result."""
    found = []
    for check in result.get("checks", []):
        for each in check.get("listed", []):
            found.append((check["id"], each.get("where")))
    for event in result.get("violated", []) + result.get("refused", []):
        found.append((event.get("code"), event.get("where")))
    return found


def run(sim, elf, port, folder):
    result = folder / "result.json"
    done = subprocess.run([sim, "run", HERE / f"{port}.yaml", "--set", f"user_cpu.elf={elf}", "--result", result], capture_output=True, text=True,
                          check=False, timeout=600)
    return done, json.loads(result.read_text()) if result.exists() else None


def row(sim, gcc, fault, port):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        build(gcc, fault, port, folder / "station.elf")
        done, result = run(sim, folder / "station.elf", port, folder)
    return fault, port, done, result


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sim")
    parser.add_argument("gcc")
    parser.add_argument("--ports", default="PSU")
    parser.add_argument("--faults", default="")
    arguments = parser.parse_args()
    wanted = [name for name in arguments.faults.split(",") if name]
    jobs = [(fault, PORTS[port]) for fault in faults() for port in fault.ports
            if port in arguments.ports and (not wanted or fault.name in wanted)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for fault, port, done, result in pool.map(lambda job: row(arguments.sim, arguments.gcc, *job), jobs):
            codes = sorted({code for code, where in places(result)}) if result else []
            print(f"{fault.name}\t{port}\t{done.returncode}\t{','.join(map(str, codes))}\t{' '.join(fault.marks(port))}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
