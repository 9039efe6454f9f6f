# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The user CPU on a DUT's pins: the programs of dsdpv1.user, each edge at its tick."""
import typing

from cocotb.triggers import ReadWrite

import dsdpv1
from dsdpv1 import CYCLE, NS, AccessTiming
from dsdpv1.user import Action, Handler, Initialisation, Program, Read, Set, Wait, Write, exchange, hold, initialise, read_cell, serve, wait_ready

from .pins import ChipPins
from .ticks import now, until, wait

T = typing.TypeVar("T")


class HostPort:
    """Drives RESET, R_REQ, R_STA, CSR, RD, WR, A and D of a DUT.

    Accesses have the edges of `timing` (table 15); setting or sampling a handshake pin takes `pin_time` ticks. Everything else may be done by
    programs: generators of actions, as in dsdpv1.user.
    """

    def __init__(self, pins: ChipPins, timing: typing.Optional[AccessTiming] = None, pin_time: int = 50 * NS) -> None:
        self.pins, self.pin_time = pins, pin_time
        self._timing = (timing or AccessTiming()).complete()

    # ---- accesses, edge by edge
    async def _edges(self, edges: typing.List[typing.Tuple[int, str, int]], end: int) -> None:
        for tick, pin, level in sorted(edges, key=lambda each: each[0]):
            await until(tick)
            self.pins.set(pin, level)
        await until(end)

    async def read(self, cell: int, timing: typing.Optional[AccessTiming] = None) -> int:
        """Reads a cell through the pins; X if a bit is unknown. The user should own the DPRAM (hold)."""
        t = self._timing if timing is None else timing.complete()
        fall = now() + max(0, t.address_setup or 0, t.cs_lead or 0)  # the first edge is now
        rise = fall + (t.rd_low or 0)
        sample = fall + (t.rd_sample or 0)
        before = [(fall - (t.address_setup or 0), "A", cell), (fall - (t.cs_lead or 0), "CSR", 0), (fall, "RD", 0)]
        after = [(rise, "RD", 1), (rise + (t.cs_trail or 0), "CSR", 1)]
        await self._edges(before + [each for each in after if each[0] < sample], sample)
        value = self.pins.level("D_OUT")
        await self._edges([each for each in after if each[0] >= sample], self._end(after, t))
        return value if value != dsdpv1.Z else dsdpv1.X

    async def write(self, cell: int, value: int, timing: typing.Optional[AccessTiming] = None) -> None:
        """Writes a cell in the same way."""
        t = self._timing if timing is None else timing.complete()
        fall = now() + max(0, t.address_setup or 0, t.cs_lead or 0, (t.data_setup or 0) - (t.wr_low or 0))
        rise = fall + (t.wr_low or 0)
        edges = [(fall - (t.address_setup or 0), "A", cell), (fall - (t.cs_lead or 0), "CSR", 0), (fall, "WR", 0),
                 (rise - (t.data_setup or 0), "D_IN", value), (rise, "WR", 1), (rise + (t.data_hold or 0), "D_IN", dsdpv1.Z),
                 (rise + (t.cs_trail or 0), "CSR", 1)]
        await self._edges(edges, self._end([*edges, (rise + (t.address_hold or 0), "A", cell)], t))

    @staticmethod
    def _end(edges: typing.List[typing.Tuple[int, str, int]], timing: AccessTiming) -> int:
        return max(each[0] for each in edges) + (timing.recovery or 0)

    # ---- programs
    async def act(self, action: Action) -> int:
        """Executes one action of a program."""
        if isinstance(action, Read):
            return await self.read(action.cell)
        if isinstance(action, Write):
            await self.write(action.cell, action.value)
        elif isinstance(action, Wait):
            await wait(action.ticks)
        else:
            if isinstance(action, Set):
                self.pins.set(action.pin, action.level)
            await wait(self.pin_time)
            await ReadWrite()
            return self.pins.level(action.pin)
        return 0

    async def run(self, program: Program[T]) -> T:
        """Executes a whole program; returns its result."""
        answer: typing.Optional[int] = None
        while True:
            try:
                action = next(program) if answer is None else program.send(answer)
            except StopIteration as end:
                return typing.cast(T, end.value)
            answer = await self.act(action)

    async def power_on(self, init: typing.Optional[Initialisation] = None, at: int = 20 * CYCLE) -> None:
        """Raises RESET at tick `at` and waits for the start-up; then executes the initialisation, if given."""
        await until(at)
        self.pins.set("RESET", 1)
        await self.run(wait_ready())
        if init is not None:
            await self.run(initialise(init))

    async def exchange(self, inputs: typing.Optional[bytes] = None) -> typing.Optional[bytes]:
        """Writes inputs to the chip and returns new outputs."""
        return await self.run(exchange(inputs))

    async def serve(self, handler: Handler) -> int:
        """Answers the waiting acyclic requests with `handler`, which gets a Request and may raise Refuse; returns their number."""
        return await self.run(serve(handler))

    async def read_held(self, cell: int) -> int:
        """Reads a cell in a separate hold."""
        return await self.run(hold(read_cell(cell)))
