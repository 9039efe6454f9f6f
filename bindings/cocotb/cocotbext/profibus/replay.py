# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Replays on a DUT the pins that a run of the model had at its inputs."""
import typing

import numpy as np
from cocotb.triggers import ReadWrite

from .pins import ChipPins
from .ticks import until


class PinSource:
    """Plays an array of dsdpv1.CHANGE for inputs on a DUT at the same ticks, from a scenario (dsdpv1.run(..., changes=True).changes) or from
    Chip.changes()."""

    def __init__(self, pins: ChipPins) -> None:
        self._pins = pins
        self._inputs = {each.number: each.name for each in pins.kind.pins if each.input}

    async def play(self, changes: np.ndarray, slave: int = 0, end: typing.Optional[int] = None) -> None:
        """Plays the changes of one slave (station) before tick `end`."""
        chosen = changes[(changes["station"] == slave) & np.isin(changes["pin"], list(self._inputs))]
        if end is not None:
            chosen = chosen[chosen["tick"] < end]
        for tick, _, pin, level in chosen.tolist():
            await until(tick)
            self._pins.set(self._inputs[pin], level)
        await ReadWrite()

