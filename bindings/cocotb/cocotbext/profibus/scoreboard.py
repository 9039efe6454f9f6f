# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The model as reference: it gets the DUT's inputs, and each change of each output has to be the DUT's, at its cycle."""
import collections
import typing

import cocotb

import dsdpv1
from dsdpv1 import CYCLE, US, X

from .pins import ChipPins
from .ticks import now, until

PERIOD = 480 * CYCLE  # how often it is compared
LATE = {"MISO": "spi_miso_delay"}  # outputs whose port is the register of a pin, and the parameter that says how late that is


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
        """Of the 48 MHz clock, counted from tick 0."""
        return self.tick // CYCLE

    def __str__(self) -> str:
        rest = f" + {self.tick % CYCLE} ticks" if self.tick % CYCLE else ""
        return (f"first difference  cycle {self.cycle}{rest} ({self.tick / US:.3f} us)\n"
                f"                  pin {self.pin}: model {_word(self.model)}, DUT {_word(self.dut)}\n"
                f"last event        {self.last_event}\nlast access       {self.last_access}")


class ScoreboardError(AssertionError):
    """Model and DUT differ; `difference` says where."""

    def __init__(self, difference: Difference) -> None:
        super().__init__(str(difference))
        self.difference = difference


def _word(level: int) -> str:
    return {dsdpv1.Z: "Z", X: "X"}.get(level, f"{level:X}")


class _Pad:
    """The pin of an output whose port is its register, which the host's clock moves: from one level to the other it follows `late` ticks later; when it
    is driven and released, at once."""

    def __init__(self, late: int) -> None:
        self._late, self._level = late, dsdpv1.Z
        self._coming: typing.List[typing.Tuple[int, int]] = []

    def put(self, tick: int, level: int) -> None:
        """A level of the port that has settled; ticks never go back."""
        if level < 0 or self._level < 0:
            self._coming = [each for each in self._coming if each[0] <= tick] + [(tick, level)]
        elif level != self._level:
            self._coming.append((tick + self._late, level))
        self._level = level

    def take(self, horizon: int) -> typing.List[typing.Tuple[int, int]]:
        """Changes of the pin before `horizon`, each once."""
        early = [each for each in self._coming if each[0] < horizon]
        self._coming = self._coming[len(early):]
        return early


class Scoreboard:
    """Runs beside any testbench: it only looks at the DUT's pins. The DUT's clock has to be exact (Clock), rising edge n at tick 250 n.

    Every 10 us of simulated time the changes of both sides are compared. At the first difference the test fails with a ScoreboardError; with
    `fails` False `difference` is set and nothing more is compared. What the model calls X (P5) matches everything. Inputs must not change
    in the active phase of a rising edge: an input of that tick counts for the next one (P9). MISO of the DUT is the pin's register: from one
    level to the other the pin follows spi_miso_delay later, as in lockstep (docs/microarchitecture_rsu.md, 5.1).
    """

    def __init__(self, pins: ChipPins, parameters: typing.Optional[typing.Mapping[str, int]] = None, fails: bool = True) -> None:
        """`parameters` of the model (access_interval, ready_cycles, ...): those of the DUT."""
        if now() != 0:
            raise RuntimeError(f"the scoreboard begins at tick {now()}, allowed is 0, before anything has happened")
        self.difference: typing.Optional[Difference] = None
        self.matched = 0  # changes of outputs
        self._pins, self._fails = pins, fails
        self._model = dsdpv1.Chip(pins.kind.name, parameters=parameters)
        usual = {each.name: each.default for each in pins.kind.parameters}
        self._pads = {pins.kind.pin(name).number: _Pad((parameters or {}).get(delay, usual[delay])) for name, delay in LATE.items() if delay in usual}
        self._names = [each.name for each in pins.kind.pins]
        inputs = [each for each in pins.kind.pins if each.input]
        outputs = [each for each in pins.kind.pins if not each.input]
        self._levels = {each.number: self._model.level(each.number) for each in outputs}
        self._dut_levels: typing.Dict[int, int] = dict(self._levels)
        self._inputs: typing.List[typing.Tuple[int, int, int, int]] = []
        self._accesses: typing.Deque[typing.Tuple[int, int, int]] = collections.deque(maxlen=64)
        self._events: typing.Deque[dsdpv1.ChipEvent] = collections.deque(maxlen=64)
        self._dut: typing.List[typing.Tuple[int, int, int]] = []
        self._model.watch([each.name for each in outputs])
        self._model.on_event(self._events.append)
        self._watchers = [*pins.watch([each.name for each in inputs], self._input), *pins.watch([each.name for each in outputs], self._output)]
        self._task = cocotb.start_soon(self._run())

    # ---- what the DUT does
    def _input(self, tick: int, pin: int, level: int) -> None:
        if level == X or (level == dsdpv1.Z and self._pins.kind.pins[pin].reset_level != dsdpv1.Z):  # not driven yet
            return
        self._inputs.append((tick, 0, pin, level))
        if self._names[pin] in ("RD", "WR") and level == 0:
            self._accesses.append((tick, pin, self._pins.level("A")))

    def _output(self, tick: int, pin: int, level: int) -> None:
        self._dut.append((tick, pin, level))

    # ---- comparison
    async def _run(self) -> None:
        horizon = PERIOD
        while self.difference is None:
            await until(horizon)
            self._settle(horizon)
            horizon += PERIOD

    def check(self) -> None:
        """Compares all up to now: call it at the end of a test."""
        self._settle(now())

    def close(self) -> None:
        """Compares no more."""
        self._task.kill()
        self._ignore()

    def _ignore(self) -> None:
        for task in self._watchers:
            task.kill()

    def _settle(self, horizon: int) -> None:
        """All changes before `horizon`, which both sides have reached."""
        if self.difference is not None or horizon <= self._model.now:
            return
        early = [each for each in self._inputs if each[0] < horizon]
        self._inputs = self._inputs[len(early):]
        if early:
            self._model.set_many(early)
        self._model.advance(horizon - 1)
        changes: typing.Dict[int, typing.Tuple[typing.Dict[int, int], typing.Dict[int, int]]] = {}
        for tick, _, pin, level in self._model.changes().tolist():
            changes.setdefault(tick, ({}, {}))[0][pin] = level
        for tick, pin, level in self._dut_pins(horizon):
            changes.setdefault(tick, ({}, {}))[1][pin] = level
        self._compare(changes)

    def _dut_pins(self, horizon: int) -> typing.Iterator[typing.Tuple[int, int, int]]:
        """Changes of the DUT's pins before `horizon`; of a tick's the last one counts."""
        settled = {(tick, pin): level for tick, pin, level in self._dut if tick < horizon}
        self._dut = [each for each in self._dut if each[0] >= horizon]
        for (tick, pin), level in settled.items():
            if pin in self._pads:
                self._pads[pin].put(tick, level)
            else:
                yield tick, pin, level
        for pin, pad in self._pads.items():
            yield from ((tick, pin, level) for tick, level in pad.take(horizon))

    def _compare(self, changes: typing.Dict[int, typing.Tuple[typing.Dict[int, int], typing.Dict[int, int]]]) -> None:
        for tick in sorted(changes):
            model, dut = changes[tick]
            self._levels.update(model)
            self._dut_levels.update(dut)
            for pin in sorted(model.keys() | dut.keys()):
                wanted, found = self._levels[pin], self._dut_levels[pin]
                if wanted not in (found, X):
                    self._differ(tick, pin, wanted, found)
                    return
                self.matched += pin in model

    def _differ(self, tick: int, pin: int, wanted: int, found: int) -> None:
        events = [each for each in self._events if each.tick <= tick]
        event = f"{events[-1].tick / US:.3f} us  {events[-1].text}" if events else "none"
        accesses = [f"{self._names[strobe]} of B{max(cell, 0):03X} at {at / US:.3f} us" for at, strobe, cell in self._accesses if at <= tick]
        access = accesses[-1] if accesses else "none"
        self._ignore()
        self.difference = Difference(tick, self._names[pin], wanted, found, event, access)
        if self._fails:
            raise ScoreboardError(self.difference)
