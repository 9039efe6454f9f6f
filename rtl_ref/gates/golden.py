# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Golden traces (docs/traces.md) as text for golden_bench.sv."""
import heapq
import json
import lzma
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
INPUTS = ("RESET", "R_REQ", "R_STA", "CSR", "RD", "WR", "A", "D_IN", "PBRXD")
OUTPUTS = ("L_REQ", "L_STA", "D_OUT", "INTR0", "PBTXD", "PBRTS", "PBF", "BR", "READY")
SERIAL_INPUTS = ("XSS", "SCK", "MOSI", "RXD", "MODE", "ADR", "UBR", "UIV")
SERIAL_OUTPUTS = ("MISO", "TXD")
TICKS = 250  # a cycle


def numbers(data):
    value = shift = 0
    for byte in data:
        value, shift = value | (byte & 127) << shift, shift + 7
        if byte < 128:
            yield value
            value = shift = 0


def bits(level, width):
    """0 is Z, 1 is X, any other value is two more than the levels."""
    return ("z" * width, "x" * width)[level] if level < 2 else format(level - 2, f"0{width}b")


class Golden:
    """A golden trace of this scenario."""

    def __init__(self, name):
        self.manifest = json.loads((ROOT / f"traces/{name}.json").read_text(encoding="utf-8"))
        head, self.data = lzma.decompress((ROOT / f"traces/{name}.trace.xz").read_bytes()).split(b"\ndata\n", 1)
        self.signals, at = {}, 0
        for line in head.decode().splitlines():
            if words := re.fullmatch(r"signal (\S+) (\S+) (\d+) \w+ \d+ (\d+) (\d+)", line):
                width, times, levels = map(int, words.groups()[2:])
                self.signals[words[1], words[2]] = width, (at, at + times), (at + times, at + times + levels)
                at += times + levels

    def changes(self, slave, pin):
        """(tick, pin, level) of a pin, its level of power-on first."""
        width, times, levels = self.signals[slave, pin]
        tick = 0
        for step, level in zip(numbers(self.data[slice(*times)]), numbers(self.data[slice(*levels)])):
            tick += step
            yield tick, pin, bits(level, width)

    def pins(self, slave):
        """Names of inputs and of outputs."""
        serial = (slave, "MISO") in self.signals
        return INPUTS + SERIAL_INPUTS * serial, OUTPUTS + SERIAL_OUTPUTS * serial

    def write(self, slave, cycles, path, reset=True):
        """The text of the first cycles; without reset RESET is always high."""
        inputs, outputs = self.pins(slave)
        now, end = {}, cycles * TICKS

        def line(tick):
            return f"{tick} {''.join(now[pin] for pin in inputs)} {''.join(now[pin] for pin in outputs)}\n"

        with open(path, "w", encoding="ascii") as text:
            last = 0
            for tick, pin, level in heapq.merge(*(self.changes(slave, each) for each in inputs + outputs), key=lambda each: each[0]):
                if tick >= end:
                    break
                if tick != last:
                    text.write(line(last))
                last, now[pin] = tick, level if reset or pin != "RESET" else "1"
            text.write(line(last))
            if last < end - 1:
                text.write(line(end - 1))
