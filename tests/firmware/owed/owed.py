#!/usr/bin/env python3
"""Firmware with each planted fault runs against the chip: none may pass unless it says why no observer can know, and the run names the line.

    owed.py SIM GCC [--example] [--expect] [--ports PSU] [--faults NAME,...]

A row for each fault and port: exit code, the marked line (of an omission: functions), whether the run names it, and all that it names. At least 90 % of a port must be
named. Without --example the faults are those of faults.h, in bare firmware; with it those of example.yaml, in the driver and the example firmware. With --expect each
runs again in the scenario with the expectations of expect.yaml, and the row ends with those that are not met.
"""
import argparse
import collections
import concurrent.futures
import functools
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
FIRMWARE = ROOT / "examples" / "firmware"
CPU = ["-mcpu=cortex-m3", "-mthumb", "-O2", "-g", "-ffreestanding", "-nostdlib", "-Wl,--build-id=none"]
BARE_FLAGS = [*CPU, "-fno-inline", "-Wall", "-Wextra", "-Wconversion", "-Werror", f"-Wl,-T,{HERE}/station.ld"]
EXAMPLE_FLAGS = [*CPU, "-std=c99", "-fno-tree-loop-distribute-patterns", "-isystem", FIRMWARE / "freestanding", f"-I{ROOT}", f"-I{ROOT}/driver",
                 f"-Wl,-T,{FIRMWARE}/stm32f103ze.ld"]
PORTS = {"P": "parallel", "S": "spi", "U": "uart"}
# Where a program may be instead of what it owes: the pauses of its main loop, or what the fault makes it do.
IDLE = {"parallel": ["pause_us"], "spi": ["pause_us", "transfer", "character"], "uart": ["pause_us", "receive", "send"]}
ELSEWHERE = {"LOOP_DEAD": ["other_faults"], "UNACKNOWLEDGED": ["intr0_handler"]}
FAULT = re.compile(r'X\((\w+), "(\w+)", (\w+),[\s\\]*"([^"]*)"\)')
BARE_SOURCES = {"parallel": ["blocks.c", "parallel.c"], "spi": ["blocks.c", "telegram.c", "spi.c"], "uart": ["telegram.c", "uart.c"]}

# --- firmware ------------------------------------------------------------------------------------------------------------


class Bare:
    """A fault of faults.h."""
    left_out = ()

    def __init__(self, name, ports, kind, what):
        self.name, self.ports, self.kind, self.what = name, ports, kind, what

    @staticmethod
    def sources(port):
        return [HERE / name for name in ["board.c", "cells.c", "station.c", *BARE_SOURCES[port]]]

    @staticmethod
    def device_at(_port, elf):
        return f"user_cpu: {{kind: arm, elf: {elf}}}"

    def marks(self, port):
        """The statements after a comment with TELLS(name), as file:line."""
        found = []
        for source in self.sources(port):
            lines = source.read_text().splitlines()
            for number, line in enumerate(lines):
                if f"TELLS({self.name})" in line:
                    while "*/" not in lines[number]:
                        number += 1
                    found.append(f"{source.name}:{number + 2}")
        return found

    def functions(self, port):
        return ELSEWHERE.get(self.name, IDLE[port]) if self.kind == "OMISSION" or (self.name, port) == ("CRC_UNJUDGED", "uart") else []

    def build(self, gcc, port, elf):
        volatile = ["-DPLANTED_NOT_VOLATILE"] if self.name == "NOT_VOLATILE" else []
        subprocess.run([gcc, *BARE_FLAGS, f"-DPLANTED={self.name}", *volatile, *self.sources(port), "-lgcc", "-o", elf], check=True)


class Example:
    """A fault of example.yaml; without `file` there is none. The chip judges the configuration; the firmware gives no diagnosis by itself,
    and reads again over SPI what Min_Slave_Intervall of the GSD leaves no time for (docs/accept.md)."""
    left_out = ("CFG_USER", "DIAG", "spoil_reads")  # of the scenario
    device = """init: {prm_mode: 2, cfg_mode: 1, dpv1: true}
    user_cpu:
      kind: arm
      elf: %s
      cycle: %s
      behaviour: count
      dpv1: {objects: [{slot: 1, index: 1, data: "A0 A1 A2 A3"}, {slot: 1, index: 2, data: "A0 A1 A2 A3"}]}"""
    cell = {"parallel": ("dsdpv1_port_stm32.h", "[address] = value;"), "spi": ("spi_port.c", "    card->spi->DR = out[i];\n    while"),
            "uart": ("uart_port.c", "USART2->DR = bytes[i];")}
    pin = ("dsdpv1_port_stm32.c", "GPIOC->BSRR = level")

    def __init__(self, name, ports, what, file="", replace="", by="", tells="", stays=()):
        self.name, self.ports, self.what, self.file, self.replace, self.by, self.tells, self.stays = name, ports, what, file, replace, by, tells, stays
        self.kind = "ACT" if tells else "OMISSION" if stays else "RIGHT"

    def device_at(self, port, elf):
        return self.device % (elf, {"parallel": "1ms", "spi": "2ms", "uart": "3ms"}[port])

    def planted(self):
        text = (ROOT / self.file).read_text()
        assert text.count(self.replace) == 1, f"{self.name}: its text is {text.count(self.replace)} times in {self.file}"
        return text.replace(self.replace, self.by)

    def marks(self, port):
        if not self.tells:
            return []
        name, text = {"cell": self.cell[port], "pin": self.pin}.get(self.tells, (pathlib.Path(self.file).name, self.tells))
        source = self.planted() if name == pathlib.Path(self.file).name else (FIRMWARE / name).read_text()
        assert text in source, f"{self.name}: {text} is not in {name}"
        return [f"{name}:{source[:source.index(text)].count(chr(10)) + 1}"]

    def functions(self, _port):
        return self.stays

    def build(self, gcc, port, elf):
        sources = {path: path for path in [*FIRMWARE.glob("*.c"), *(ROOT / "driver").glob("*.c")]}
        if self.file:
            copy = elf.parent / pathlib.Path(self.file).name
            copy.write_text(self.planted())
            sources[ROOT / self.file] = copy
        subprocess.run([gcc, *EXAMPLE_FLAGS, *sources.values(), "-lgcc", "-o", elf], check=True)


def faults(example):
    if example:
        return [Example("NONE", "PSU", "right firmware"), *(Example(**row) for row in yaml.safe_load((HERE / "example.yaml").read_text()))]
    return [Bare(*row) for row in FAULT.findall((HERE / "faults.h").read_text())]


# --- runs ----------------------------------------------------------------------------------------------------------------


def scenario(fault, port, elf, expects):
    text = (HERE / f"{port}.yaml").read_text()
    text = text.replace("../../../scenarios", str(ROOT / "scenarios")).replace("user_cpu: {kind: arm, elf: station.elf}", fault.device_at(port, elf))
    text += (HERE / "expect.yaml").read_text() if expects else ""
    return "".join(line for line in text.splitlines(keepends=True) if not any(word in line for word in fault.left_out))


def run(sim, fault, port, folder, expects):
    """The run's exit code and result."""
    file, result = folder / f"{port}.yaml", folder / "result.json"
    file.write_text(scenario(fault, port, folder / "station.elf", expects))
    done = subprocess.run([sim, "run", file, "--no-progress", "--result", result], capture_output=True, text=True, check=False, timeout=600)
    if done.returncode not in (0, 1):
        raise RuntimeError(f"{fault.name} {port}: {done.stderr}")
    return done.returncode, json.loads(result.read_text())


def row(sim, gcc, expects, job):
    fault, port = job
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        fault.build(gcc, port, folder / "station.elf")
        code, result = run(sim, fault, port, folder, False)
        expected = run(sim, fault, port, folder, True)[1] if expects else None
    return fault, port, code, result, expected


def is_of_right_firmware(refused):
    """The probe's configuration is refused; a telegram may come too early, an answer after the abort."""
    return refused["code"] in ("SPI_BUSY", "INPUT_LENGTH", "SAP_STATE", "DPV1_NO_REQUEST") or (refused["code"] == "CFG_USER" and refused["count"] == 1)


def places(result):
    """(code, file:line, function, whether it stayed there) of all that the run holds against the firmware."""
    found = [(check["id"], each["where"]) for check in result["checks"] for each in check["listed"]]
    found += [(event["code"], event["where"]) for event in result["violated"]]
    found += [(event["code"], event["where"]) for event in result["refused"] if not is_of_right_firmware(event)]
    return [(code, f"{where['file']}:{where['line']}" if where else "", where["function"] if where else "", bool(where) and where["stayed_ns"] is not None)
            for code, where in found]


def unmet(result):
    return [each["text"] for each in result["expectations"] if each["passed"] is False and not each["implied"]]


def judge(fault, port, code, result):
    """What is wrong with the row, and whether the run names the place; None for right and silent firmware."""
    found = places(result)
    named = any(place in fault.marks(port) or (stayed and function in fault.functions(port)) for _, place, function, stayed in found)
    if fault.kind == "RIGHT":
        return "right firmware does not pass" if code != 0 else "", None
    if fault.kind == "SILENT":
        return "does not pass any more: it gets a mark" if code != 0 else "", None
    return "passes" if code == 0 else "", named


# --- the table -----------------------------------------------------------------------------------------------------------


def wanted_jobs(arguments):
    names = [name for name in arguments.faults.split(",") if name]
    return [(fault, PORTS[port]) for fault in faults(arguments.example) for port in fault.ports
            if port in arguments.ports and (not names or fault.name in names)]


def print_row(fault, port, code, result, expected, why, named):
    seen = "; ".join(sorted({" ".join(filter(None, each[:3])) for each in places(result)}))
    cells = [fault.name, port, fault.kind, code, ",".join(fault.marks(port) or fault.functions(port)), "" if named is None else "named" if named else "NOT NAMED", seen]
    if expected:
        cells.append("; ".join(unmet(expected)) or "expectations met")
    print(*cells, why.upper(), sep="\t", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sim")
    parser.add_argument("gcc")
    parser.add_argument("--example", action="store_true")
    parser.add_argument("--expect", action="store_true")
    parser.add_argument("--ports", default="PSU")
    parser.add_argument("--faults", default="")
    arguments = parser.parse_args()
    wrong, named_in = 0, collections.defaultdict(list)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for done in pool.map(functools.partial(row, arguments.sim, arguments.gcc, arguments.expect), wanted_jobs(arguments)):
            fault, port, code, result, expected = done
            why, named = judge(fault, port, code, result)
            wrong += bool(why) or (fault.kind == "RIGHT" and bool(expected) and bool(unmet(expected)))
            if named is not None:
                named_in[port].append(named)
            print_row(*done, why, named)
    for port, named in named_in.items():
        print(f"{port}: {sum(named)} of {len(named)} places named")
    print(f"{wrong} wrong")
    return 1 if wrong or any(sum(named) < 0.9 * len(named) for named in named_in.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
