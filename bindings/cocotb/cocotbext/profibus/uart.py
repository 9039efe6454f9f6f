# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Characters on a signal, without a bus: source and sink of PROFIBUS characters (start bit, eight data, even parity, stop bit), and a monitor of
telegrams. Bit times are whole ticks, edges are at absolute ones."""
import dataclasses
import typing

import cocotb
from cocotb.queue import Queue
from cocotb.triggers import FallingEdge

import dsdpv1
from dsdpv1 import Heard, Telegram, bit_ticks

from ._cocotb import change_of, stop
from .ticks import now, until

CHARACTER_BITS = 11


class ProfibusSource:
    """Sends characters on a signal, bit after bit."""

    def __init__(self, signal: typing.Any, baud: str = "12M") -> None:
        self._signal, self.bit, self._free = signal, bit_ticks(baud), 0
        signal.value = 1

    async def write(self, data: "bytes | Telegram", idle_bits: int = 33, wrong_parity_at: typing.Optional[int] = None) -> int:
        """Sends bytes, or a telegram, after `idle_bits` (T_SYN: 33) since its last character. Returns the tick of the first start bit. The
        character with number `wrong_parity_at` has a wrong parity bit."""
        data = data.encode() if isinstance(data, Telegram) else data
        begin = start = max(now(), self._free + idle_bits * self.bit if self._free else 0)
        for index, byte in enumerate(data):
            parity = (bin(byte).count("1") & 1) ^ (index == wrong_parity_at)
            await self._character([0, *(byte >> bit & 1 for bit in range(8)), parity, 1], start)
            start += CHARACTER_BITS * self.bit
        await until(start)
        self._free = start
        return begin

    async def _character(self, bits: typing.List[int], start: int) -> None:
        level = 1
        for index, bit in enumerate(bits):
            if bit != level:
                await until(start + index * self.bit)
                self._signal.value = level = bit


@dataclasses.dataclass(frozen=True)
class Character:
    """A received character."""

    start: int  # tick at which its start bit fell
    byte: int
    parity_error: bool
    framing_error: bool  # the stop bit was low


class ProfibusSink:
    """Receives characters from a signal; each bit is sampled in its middle."""

    def __init__(self, signal: typing.Any, baud: str = "12M") -> None:
        self._signal, self._bit = signal, bit_ticks(baud)
        self._received: typing.Any = Queue()
        self._task = cocotb.start_soon(self._run())

    async def read(self, count: int = 1) -> typing.List[Character]:
        """The next `count` characters."""
        return [await self._received.get() for _ in range(count)]

    def empty(self) -> bool:
        """True if none waits."""
        return bool(self._received.empty())

    def close(self) -> None:
        """Stops receiving."""
        stop(self._task)

    async def _run(self) -> None:
        while True:
            if self._signal.value != 0:
                await FallingEdge(self._signal)
            start, bits = now(), []
            for index in range(CHARACTER_BITS):
                await until(start + index * self._bit + self._bit // 2)
                bits.append(int(self._signal.value))
            if bits[0]:
                continue  # a glitch
            byte = sum(bit << index for index, bit in enumerate(bits[1:9]))
            self._received.put_nowait(Character(start, byte, sum(bits[1:10]) % 2 == 1, bits[10] == 0))
            if not bits[10]:
                await change_of(self._signal)


class ProfibusMonitor:
    """Receives telegrams on a signal, valid or not, with TSDR and errors, as the model's monitor does."""

    def __init__(self, line: typing.Any, baud: str = "12M", callback: typing.Optional[typing.Callable[[Heard], typing.Any]] = None) -> None:
        """Calls `callback` for each telegram; without it recv() returns them."""
        self._line, self._received = line, Queue()  # type: typing.Any, typing.Any
        self._bus = dsdpv1.Bus(baud)
        self._station = self._bus.add_station("line")
        self._bus.on_telegram(callback or self._received.put_nowait)
        self._planned = dsdpv1.NEVER
        cocotb.start_soon(self._run())

    async def recv(self) -> Heard:
        """The next telegram, at its end."""
        return typing.cast(Heard, await self._received.get())

    @property
    def statistics(self) -> dsdpv1.BusStatistics:
        """The counts so far."""
        return self._bus.statistics

    async def _run(self) -> None:
        edge = change_of(self._line)
        while True:
            await edge
            value = self._line.value
            if value.is_resolvable:
                self._station.drive(True, int(value), at=max(now(), self._bus.now))
                self._plan()

    def _plan(self) -> None:
        wake = self._bus.next
        if wake < self._planned:
            self._planned = wake
            cocotb.start_soon(self._sleep(wake))

    async def _sleep(self, wake: int) -> None:
        await until(wake)
        if wake == self._planned:
            self._planned = dsdpv1.NEVER
            self._bus.run(max(now(), self._bus.now))
            self._plan()
