# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""A PROFIBUS segment: chips, masters, external stations, and a monitor that receives all telegrams."""
from __future__ import annotations

import ctypes
import dataclasses
import os
import typing

from . import _c
from ._library import Handle, encoded, filled, lib, number, sized, text
from .changes import taken
from .chip import Chip, chip_options
from .errors import StateError
from .events import Event, event_of
from .master import PERSONALITIES, Master, Master1, Master2
from .telegram import Heard, heard_of
from .units import Z, baud_index

if typing.TYPE_CHECKING:
    import numpy as np


@dataclasses.dataclass(frozen=True)
class BusStatistics:
    """Counts of the monitor."""

    telegrams: int  # valid ones
    wrong: int
    flags: typing.Dict[str, int]  # "collision", "gap", ...: how often


@dataclasses.dataclass(frozen=True)
class TsdrStatistics:
    """Answers of one address; TSDR in ticks, 0 without answers."""

    requests: int
    answers: int
    unanswered: int
    tsdr_min: int
    tsdr_max: int
    tsdr_mean: int


class Station:
    """A station that the caller simulates: RTL, another model."""

    def __init__(self, bus: "Bus", index: int) -> None:
        self._bus, self.index = bus, index

    def drive(self, enabled: bool, level: int, at: typing.Optional[int] = None) -> None:
        """Runs the bus up to `at`, then switches the station's driver on or off (`enabled`); while on, it drives `level`."""
        lib.dpsim_bus_drive(self._bus, self._bus.now if at is None else at, self.index, int(enabled), level)


class Bus(Handle):
    """A segment. Chips are added first, then masters and stations; running it runs all in order of time. Chips act before the monitor, the monitor
    before masters. In callbacks the bus must not be run or changed; commands to masters are allowed."""

    def __init__(self, baud: str = "12M") -> None:
        """`baud` is that of masters and monitor, one of BAUDS."""
        options = sized(_c.dpsim_bus_options, baud=baud_index(baud))
        super().__init__(number(lambda into: lib.dpsim_bus_create(ctypes.byref(options), into), ctypes.c_void_p), lib.dpsim_bus_destroy)
        self._members: typing.List[Handle] = []
        self.left_out = ""  # by the last add_scenario

    def close(self) -> None:
        """Releases it with all its chips and masters."""
        super().close()
        for each in getattr(self, "_members", ()):
            each.close()

    def _add(self, member: typing.Any) -> typing.Any:
        self._members.append(member)
        member.bus = self  # keeps the bus alive
        return member

    # ---- stations
    def add_chip(self, name: typing.Optional[str] = None, kind: typing.Optional[str] = None, engine: str = "skip",
                 parameters: typing.Optional[typing.Mapping[str, int]] = None) -> Chip:
        """Adds a chip whose UART pins are on the line; the caller drives its user side. StateError: a master or station has already been added."""
        options = chip_options(engine, kind, name, parameters or {})
        handle = number(lambda into: lib.dpsim_bus_add_chip(self, ctypes.byref(options), into), ctypes.c_void_p)
        return typing.cast(Chip, self._add(Chip._of(handle, kind)))  # pylint: disable=protected-access

    def _master(self, master_class: int, options: typing.Mapping[str, typing.Any]) -> int:
        made = sized(_c.dpsim_master_options, master_class=master_class)
        for key, value in options.items():
            setattr(made, key, value)
        return int(number(lambda into: lib.dpsim_bus_add_master(self, ctypes.byref(made), into), ctypes.c_void_p))

    def add_master(self, address: int = 0, name: typing.Optional[str] = None, personality: str = "high_always", **timing: int) -> Master1:
        """Adds a master of class 1, silent until start(). `personality`: "high_always" or "classic". `timing` are members of dpsim_master_options:
        highest_address, ring, no_token, slot_bits, set_bits, quiet_bits, target_rotation_bits, max_retries, gap_factor, min_slave_interval_us,
        clock_ppm; 0 is their default."""
        if personality not in PERSONALITIES:
            raise ValueError(f"personality is {personality}, expected {', '.join(PERSONALITIES)}")
        options = {**self._timing(timing), "address": address, "name": encoded(name), "personality": PERSONALITIES.index(personality)}
        return typing.cast(Master1, self._add(Master1(self._master(1, options))))

    def add_master2(self, address: int = 0, name: typing.Optional[str] = None, **timing: int) -> Master2:
        """Adds a master of class 2, which always takes part in the ring; the same keys."""
        return typing.cast(Master2, self._add(Master2(self._master(2, {**self._timing(timing), "address": address, "name": encoded(name)}))))

    def add_scenario(self, path: typing.Union[str, "os.PathLike[str]"], settings: typing.Optional[typing.Mapping[str, typing.Any]] = None,
                     scenario: typing.Optional[str] = None) -> typing.List[Master]:
        """Adds all masters of a scenario, class 1 first, with their slaves and connections. They start automatically and execute the script's
        actions for masters; the ends of its requests are events with id 0. The slaves are elsewhere: `left_out` lists the ignored parts of the
        scenario. `settings` replace keys of the file; `scenario`: its text, with `path` as its name. InputError: also for a `when` that only a
        slave could evaluate."""
        words = [encoded(f"{key}={value}") for key, value in (settings or {}).items()]
        options = sized(_c.dpsim_scenario_options, path=encoded(os.fspath(path)), text=encoded(scenario), setting_count=len(words),
                        settings=ctypes.cast((ctypes.c_char_p * max(1, len(words)))(*words), ctypes.POINTER(ctypes.c_char_p)))
        handles, left_out = (ctypes.c_void_p * 128)(), ctypes.c_char_p()
        count = number(lambda into: lib.dpsim_bus_add_scenario(self, ctypes.byref(options), handles, len(handles), into, ctypes.byref(left_out)),
                       ctypes.c_size_t)
        self.left_out = text(left_out.value)
        return [self._add(self._of_its_class(handle)) for handle in handles[:count]]

    @staticmethod
    def _of_its_class(handle: typing.Any) -> Master:
        try:
            filled(lambda into: lib.dpsim_master_get_status(handle, into), _c.dpsim_master_status)
            return Master1(handle)
        except StateError:
            return Master2(handle)

    @staticmethod
    def _timing(timing: typing.Mapping[str, int]) -> typing.Mapping[str, int]:
        known = {name for name, *_ in _c.dpsim_master_options._fields_} - {"size", "master_class", "name", "personality", "address"}
        for key in timing:
            if key not in known:
                raise TypeError(f"a master has no {key}, it has {', '.join(sorted(known))}")
        return timing

    def add_station(self, name: typing.Optional[str] = None) -> Station:
        """Adds an external station with its driver off."""
        return Station(self, number(lambda into: lib.dpsim_bus_add_station(self, encoded(name), into), ctypes.c_uint16))

    @property
    def masters(self) -> typing.List[Master]:
        """In the order in which they were added."""
        return [each for each in self._members if isinstance(each, Master)]

    # ---- time
    @property
    def now(self) -> int:
        """The present tick."""
        return int(number(lambda into: lib.dpsim_bus_now(self, into), ctypes.c_uint64))

    @property
    def next(self) -> int:
        """The tick of the next station activity that needs no call, NEVER: none is due."""
        return int(number(lambda into: lib.dpsim_bus_next(self, into), ctypes.c_uint64))

    def run(self, to: int) -> None:
        """Runs all stations up to and including tick `to`. Releases the GIL."""
        lib.dpsim_bus_run(self, to)

    # ---- the line
    @property
    def line(self) -> int:
        """Its present level, 1 is idle."""
        return int(number(lambda into: lib.dpsim_bus_line(self, into), ctypes.c_int16))

    def force(self, level: typing.Optional[int], at: typing.Optional[int] = None) -> None:
        """Wire fault: runs up to `at`, then forces the line to `level`; None releases it."""
        lib.dpsim_bus_force(self, self.now if at is None else at, Z if level is None else level)

    def plug(self, station: int, plugged: bool, at: typing.Optional[int] = None) -> None:
        """Wire fault: unplugs a station, which then receives an idle line and does not drive the wire."""
        lib.dpsim_bus_plug(self, self.now if at is None else at, station, int(plugged))

    def watch(self, line: bool = True, drivers: bool = False,
              callback: typing.Optional[typing.Callable[[int, int, int, int], typing.Any]] = None) -> None:
        """Reports changes of the line (station LINE, pin 0) and of the drivers of masters and stations (pin 0 TXD, 1 RTS) from now on: by
        callback(tick, station, pin, level), or by keeping them for changes()."""
        what = (_c.DPSIM_WATCH_LINE if line else 0) | (_c.DPSIM_WATCH_DRIVERS if drivers else 0)
        told = None if callback is None else lambda change: callback(change[0].tick, change[0].station, change[0].pin, change[0].level)
        self._keep("watch", _c.dpsim_change_fn, told, lambda made: lib.dpsim_bus_watch(self, what, made, None))

    def changes(self) -> np.ndarray:
        """Takes the changes kept by watch(): an array of CHANGE."""
        return taken(lib.dpsim_bus_read_changes, self)

    # ---- events
    def on_telegram(self, callback: typing.Optional[typing.Callable[[Heard], typing.Any]]) -> None:
        """Calls `callback` at the end of each telegram, valid or not; None: no callback."""
        told = None if callback is None else lambda heard: callback(heard_of(heard[0]))
        self._keep("telegram", _c.dpsim_telegram_fn, told, lambda made: lib.dpsim_bus_on_telegram(self, made, None))

    def on_event(self, callback: typing.Optional[typing.Callable[[Event], typing.Any]]) -> None:
        """Calls `callback` for each event of masters and monitor; None: no callback."""
        told = None if callback is None else lambda event: callback(event_of(event[0]))
        self._keep("event", _c.dpsim_event_fn, told, lambda made: lib.dpsim_bus_on_event(self, made, None))

    @property
    def statistics(self) -> BusStatistics:
        """Statistics of the monitor."""
        got = filled(lambda into: lib.dpsim_bus_get_statistics(self, into), _c.dpsim_bus_statistics)
        flags = {text(lib.dpsim_flag_name(flag)): got.flags[flag] for flag in range(_c.DPSIM_FLAG_COUNT)}
        return BusStatistics(got.telegrams, got.wrong, flags)

    def tsdr(self, address: int) -> TsdrStatistics:
        """Statistics of one address, 0 to 126."""
        got = filled(lambda into: lib.dpsim_bus_get_tsdr(self, address, into), _c.dpsim_tsdr_statistics)
        return TsdrStatistics(got.requests, got.answers, got.unanswered, got.tsdr_min, got.tsdr_max, got.tsdr_mean)
