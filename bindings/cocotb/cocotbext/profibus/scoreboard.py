# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The model as reference: it gets the DUT's inputs, and the DUT must make each change of each output in the same cycle."""
import collections
import typing

import cocotb

import dsdpv1
from dsdpv1 import CYCLE, US, X

from ._cocotb import stop
from .pins import ChipPins
from .ticks import now, until

PERIOD = 480 * CYCLE  # how often it is compared


class Difference(typing.NamedTuple):
    """The first tick at which model and DUT differ."""

    tick: int
    pin: str
    model: int
    dut: int
    last_event: str  # of the model
    last_access: str

    @property
    def cycle(self) -> int:
        """Cycle of the 48 MHz clock, counted from tick 0."""
        return self.tick // CYCLE

    def __str__(self) -> str:
        rest = f" + {self.tick % CYCLE} ticks" if self.tick % CYCLE else ""
        return (f"first difference  cycle {self.cycle}{rest} ({self.tick / US:.3f} us)\n"
                f"                  pin {self.pin}: model {_word(self.model)}, DUT {_word(self.dut)}\n"
                f"last event        {self.last_event}\nlast access       {self.last_access}")


class ScoreboardError(AssertionError):
    """Model and DUT differ; see `difference`."""

    def __init__(self, difference: Difference) -> None:
        super().__init__(str(difference))
        self.difference = difference


def _word(level: int) -> str:
    return {dsdpv1.Z: "Z", X: "X"}.get(level, f"{level:X}")


class Scoreboard:
    """Runs beside any testbench and only reads the DUT's pins. The DUT's clock must be exact (Clock), rising edge n at tick 250 n.

    Every 10 us of simulated time the changes of both sides are compared, by the rules of dsdpv1.Scoreboard. At the first difference the test fails
    with a ScoreboardError; with `fails` False `difference` is set and comparison stops. Inputs must not change in the active phase of a rising
    edge: an input of that tick counts for the next one (P9).
    """

    def __init__(self, pins: ChipPins, parameters: typing.Optional[typing.Mapping[str, int]] = None, fails: bool = True, tolerance: int = 0) -> None:
        """`parameters` of the model (access_interval, ready_cycles, ...): those of the DUT. Differences that last at most `tolerance` ticks are
        ignored: for RTL with delays."""
        if now() != 0:
            raise RuntimeError(f"the scoreboard begins at tick {now()}, expected 0, before anything has happened")
        self.difference: typing.Optional[Difference] = None
        self._pins, self._fails = pins, fails
        self._board = dsdpv1.Scoreboard(pins.kind.name, parameters, tolerance)
        self._names = [each.name for each in pins.kind.pins]
        self._changes: typing.List[typing.Tuple[int, int, int, int]] = []
        self._accesses: typing.Deque[typing.Tuple[int, int, int]] = collections.deque(maxlen=64)
        self._watchers = pins.watch(self._names, self._change)
        self._task = cocotb.start_soon(self._run())

    @property
    def matched(self) -> int:
        """Changes of the model's outputs that the DUT made as well."""
        return self._board.matched

    def _change(self, tick: int, pin: int, level: int) -> None:
        its = self._pins.kind.pins[pin]
        if its.input and (level == X or (level == dsdpv1.Z and its.reset_level != dsdpv1.Z)):  # not driven yet
            return
        self._changes.append((tick, 0, pin, level))
        if its.name in ("RD", "WR") and level == 0:
            self._accesses.append((tick, pin, self._pins.level("A")))

    async def _run(self) -> None:
        horizon = PERIOD
        while self.difference is None:
            await until(horizon)
            self.check()
            horizon += PERIOD

    def check(self) -> None:
        """Compares everything up to now: call it at the end of a test."""
        if self.difference is None:
            changes, self._changes = self._changes, []
            found = self._board.compare(changes, now())
            if found is not None:
                self._differ(found)

    def close(self) -> None:
        """Stops comparing."""
        stop(self._task)
        self._ignore()

    def _ignore(self) -> None:
        for task in self._watchers:
            stop(task)

    def _differ(self, found: dsdpv1.Difference) -> None:
        event = f"{found.events[0].tick / US:.3f} us  {found.events[0].text}" if found.events else "none"
        accesses = [f"{self._names[strobe]} of B{max(cell, 0):03X} at {at / US:.3f} us" for at, strobe, cell in self._accesses if at <= found.tick]
        access = accesses[-1] if accesses else "none"
        self._ignore()
        self.difference = Difference(found.tick, found.pin, found.model, found.dut, event, access)
        if self._fails:
            raise ScoreboardError(self.difference)
