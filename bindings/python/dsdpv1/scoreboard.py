# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The model as reference for somebody's chip, the DUT: RTL, a recording."""
import ctypes
import dataclasses
import typing

from . import _c
from ._library import Handle, lib, number, sized
from .changes import address, as_changes
from .chip import ChipEvent, chip_options, event_maker
from .kinds import kind_of
from .units import NEVER


@dataclasses.dataclass(frozen=True)
class Difference:
    """The first one, and what was before it."""

    tick: int  # since when
    pin: str
    model: int  # its levels
    dut: int
    last_input: typing.Optional[typing.Tuple[int, str, int]]  # tick, pin, level
    events: typing.Tuple[ChipEvent, ...]  # the model's last three, the latest first


class Scoreboard(Handle):
    """The model gets the DUT's inputs, and the DUT's outputs have to be its own at every tick (include/dsdpv1/scoreboard.h has the rules)."""

    def __init__(self, kind: typing.Optional[str] = None, parameters: typing.Optional[typing.Mapping[str, int]] = None, tolerance: int = 0,
                 warm_up: int = 0) -> None:
        """`parameters`: those of the DUT. A difference that lasts no longer than `tolerance` ticks is none; it compares when RESET has been low for
        `warm_up` ticks, in which RTL leaves X, 0: from tick 0 on."""
        options = sized(_c.dpsim_scoreboard_options, tolerance=tolerance, warm_up=warm_up)
        model = chip_options("skip", kind, None, parameters or {})
        super().__init__(number(lambda into: lib.dpsim_scoreboard_create(ctypes.byref(model), ctypes.byref(options), into), ctypes.c_void_p),
                         lib.dpsim_scoreboard_destroy)
        self.kind = kind_of(kind)
        self._result = sized(_c.dpsim_scoreboard_result)

    def compare(self, changes: typing.Any, until: int) -> typing.Optional[Difference]:
        """The DUT has made these changes, an array of CHANGE or a list of (tick, station, pin's number, level), and no others up to `until`: all
        ticks before it are judged. The first difference so far; after it nothing more is compared."""
        array, got, events = as_changes(changes), self._result, typing.cast(typing.List[ChipEvent], [])
        lib.dpsim_scoreboard_compare(self, address(array), len(array), until, ctypes.byref(got))
        if got.tick == NEVER:
            return None
        tell, pins = event_maker(self.kind, events.append), self.kind.pins
        for event in got.events[:got.event_count]:
            tell(ctypes.pointer(event))
        last_input = None if got.input_tick == NEVER else (got.input_tick, pins[got.input].name, got.input_level)
        return Difference(got.tick, pins[got.pin].name, got.model, got.dut, last_input, tuple(events))

    @property
    def matched(self) -> int:
        """Changes of the model's outputs that the DUT has made as well."""
        return int(self._result.matched)
