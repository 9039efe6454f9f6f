# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Converts between ticks of 1/12 ns, in which all times of the chip and of PROFIBUS are whole numbers, and the simulator's steps.

Only absolute times are converted, each once, so nothing drifts: an edge is at most half a step off its tick, and a tick converted to a time and
back is the same tick if a step is at most 40 ps. With a precision of 1 ps a bit at 12 Mbit/s always begins within 0.5 ps of its exact time.
"""
import functools
import typing

import cocotb
from cocotb.triggers import Timer
from cocotb.utils import get_sim_steps, get_sim_time

from dsdpv1 import CYCLE

from ._cocotb import set_now

MOST_FS = 40_000  # per step


@functools.lru_cache(maxsize=None)
def _steps_per_us() -> int:
    steps = int(get_sim_steps(1, "us"))
    if steps < 1_000_000_000 // MOST_FS:
        raise RuntimeError(f"the simulator's precision is {1_000_000 / steps:g} ps, expected at most {MOST_FS / 1000:g} ps: set it to 1 ps")
    return steps


def steps_of(tick: int) -> int:
    """The step nearest to an absolute tick; 12000 ticks are a us."""
    return (2 * tick * _steps_per_us() + 12_000) // 24_000


def now() -> int:
    """The present tick."""
    steps = _steps_per_us()
    return (2 * int(get_sim_time("step")) * 12_000 + steps) // (2 * steps)


async def until(tick: int) -> None:
    """Waits for an absolute tick; returns at once if it is the present one or past."""
    left = steps_of(tick) - int(get_sim_time("step"))
    if left > 0:
        await Timer(left, "step")


async def wait(ticks: int) -> None:
    """Waits for this number of ticks."""
    await until(now() + ticks)


class Clock:
    """The 48 MHz clock: rising edge n at tick 250 n, whatever the simulator's precision.

    An input that changes at the tick of a rising edge counts for the next one (P9): the clock is set at once, and testbenches write later in the
    same time step.
    """

    def __init__(self, signal: typing.Any) -> None:
        self._signal = signal

    def start(self) -> typing.Any:
        """Starts at the next whole cycle. Returns the task; its kill() stops the clock, in cocotb 2 its cancel()."""
        return cocotb.start_soon(self._run())

    async def _run(self) -> None:
        cycle = -(-now() // CYCLE)
        while True:
            cycle = await self._three_cycles(cycle)
            # Three cycles are 62.5 ns. If that is a whole number of steps, the timers of their six halves can be reused.
            halves = [steps_of(cycle * CYCLE + half * CYCLE // 2) for half in range(7)]
            if (halves[6] - halves[0]) * 12_000 == 3 * CYCLE * _steps_per_us():
                await until(cycle * CYCLE)
                await self._for_ever([Timer(end - begin, "step") for begin, end in zip(halves, halves[1:])])

    async def _three_cycles(self, cycle: int) -> int:
        for half in range(6):
            await until(cycle * CYCLE + half * CYCLE // 2)
            set_now(self._signal, 1 - half % 2)
        return cycle + 3

    async def _for_ever(self, timers: typing.List[Timer]) -> None:
        while True:
            for index, timer in enumerate(timers):
                set_now(self._signal, 1 - index % 2)
                await timer
