#!/usr/bin/env python3
"""Firmware with each fault of faults.h runs against the chip: none may pass unless it says why no observer can know, and the run names the line.

    owed.py SIM GCC [--ports PSU] [--faults NAME,...]

A row for each fault and port: exit code, the marked line, whether the run names it (of an omission: a function), and all that it names. At least 90 % must
be named.
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
FAULT = re.compile(r'X\((\w+), "(\w+)", (\w+),[\s\\]*"([^"]*)"\)')
SOURCES = {"parallel": ["blocks.c", "parallel.c"], "spi": ["blocks.c", "telegram.c", "spi.c"], "uart": ["telegram.c", "uart.c"]}


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
    """(code, file:line, function) of all that the run holds against the firmware."""
    found = []
    for check in result["checks"]:
        found += [(check["id"], each["where"]) for each in check["listed"]]
    found += [(event["code"], event["where"]) for event in result["violated"] + result["refused"]]
    return [(code, f"{where['file']}:{where['line']}" if where else "", where["function"] if where else "") for code, where in found]


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


def judge(fault, port, done, result):
    """What is wrong with the row, and whether the run names the place; None without a mark."""
    found = places(result)
    passed = done.returncode == 0
    marks = fault.marks(port)
    named = None
    if fault.kind == "ACT" and marks:
        named = any(place in marks for _, place, _ in found)
    if fault.kind == "OMISSION":
        named = any(function for _, _, function in found)
    if fault.kind == "RIGHT" and not passed:
        return "right firmware does not pass", named
    if fault.kind in ("ACT", "OMISSION") and passed:
        return "passes", named
    if fault.kind in ("SILENT", "OPEN") and not passed:
        return "does not pass any more: it gets a mark", None
    return "", None if passed else named


def wanted_jobs(arguments):
    names = [name for name in arguments.faults.split(",") if name]
    return [(fault, PORTS[port]) for fault in faults() for port in fault.ports
            if port in arguments.ports and (not names or fault.name in names)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sim")
    parser.add_argument("gcc")
    parser.add_argument("--ports", default="PSU")
    parser.add_argument("--faults", default="")
    arguments = parser.parse_args()
    wrong = with_mark = right_mark = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for fault, port, done, result in pool.map(lambda job: row(arguments.sim, arguments.gcc, *job), wanted_jobs(arguments)):
            why, named = judge(fault, port, done, result)
            wrong += bool(why)
            with_mark += named is not None
            right_mark += bool(named)
            seen = "; ".join(sorted({" ".join(filter(None, each)) for each in places(result)}))
            print(fault.name, port, fault.kind, done.returncode, ",".join(fault.marks(port)), "" if named is None else "named" if named else "NOT NAMED",
                  seen, why.upper(), sep="\t", flush=True)
    print(f"{wrong} wrong; {right_mark} of {with_mark} places named")
    return 1 if wrong or right_mark < 0.9 * with_mark else 0


if __name__ == "__main__":
    sys.exit(main())
