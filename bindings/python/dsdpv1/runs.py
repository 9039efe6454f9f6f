# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Load a scenario (docs/scenarios.md), run it and read its results."""
from __future__ import annotations

import ctypes
import functools
import json
import os
import typing

from . import _c
from ._library import Handle, encoded, filled, lib, number, sized, text
from .changes import of_pin, taken
from .chip import ENGINES, ChipEvent, event_maker
from .kinds import Kind, PinName, kind_of
from .telegram import Heard, heard_of, table
from .units import LINE

if typing.TYPE_CHECKING:
    import numpy as np

CHECKS = ("fail", "off", "report")  # 1, 2, 3 of the C API
Path = typing.Union[str, "os.PathLike[str]"]


def _file(path: typing.Optional[Path]) -> typing.Optional[bytes]:
    return None if path is None else encoded(os.fspath(path))


def _options(path: typing.Optional[Path], source: typing.Optional[str], settings: typing.Mapping[str, typing.Any], engine: str,
             checks: typing.Optional[str],
             files: typing.Mapping[str, typing.Optional[Path]]) -> typing.Any:
    for name, value, allowed in (("engine", engine, ENGINES), ("checks", checks, CHECKS)):
        if value is not None and value not in allowed:
            raise ValueError(f"{name} is {value}, expected {', '.join(allowed)}")
    words = (ctypes.c_char_p * max(1, len(settings)))(*(encoded(f"{key}={value}") for key, value in settings.items()))
    return sized(_c.dpsim_run_options, engine=ENGINES.index(engine), checks=0 if checks is None else 1 + CHECKS.index(checks), setting_count=len(settings), path=_file(path),
                 text=encoded(source), settings=ctypes.cast(words, ctypes.POINTER(ctypes.c_char_p)), **{key: _file(each) for key, each in files.items()})


class Run(Handle):
    """A scenario, run once. run() does everything; this class is for callbacks, and for loading a scenario before running it.

    InputError: "file:line: what is wrong, what is allowed". UnsupportedError: a slave whose user CPU is an ARM board, which needs dsdpv1-sim.
    """

    def __init__(self, path: typing.Optional[Path] = None, *, text: typing.Optional[str] = None,  # pylint: disable=redefined-outer-name
                 settings: typing.Optional[typing.Mapping[str, typing.Any]] = None, engine: str = "skip", checks: typing.Optional[str] = None,
                 log: typing.Optional[Path] = None, wave: typing.Optional[Path] = None, capture: typing.Optional[Path] = None) -> None:
        """`path` of the scenario; with `text`, the scenario itself, `path` is its name in messages and the base of relative paths. `settings`
        replace keys: {"user_cpu.cycle": "40us"}. `checks`: one of CHECKS; None: as in the scenario, else "fail". `log` (.log, .jsonl), `wave`
        (.vcd, .fst) and `capture` (.pcapng) are output files."""
        options = _options(path, text, settings or {}, engine, checks, {"log": log, "wave": wave, "capture": capture})
        super().__init__(number(lambda into: lib.dpsim_run_create(ctypes.byref(options), into), ctypes.c_void_p), lib.dpsim_run_destroy)
        info = filled(lambda into: lib.dpsim_run_get_info(self, into), _c.dpsim_run_info)
        self.name, self.end, self.kind = _text(info.name), int(info.end), kind_of(_text(info.kind))
        self.slaves = tuple(_text(number(lambda into, i=i: lib.dpsim_run_slave(self, i, into), ctypes.c_char_p)) for i in range(info.slaves))

    # ---- before the run
    def keep(self, changes: bool = False, telegrams: bool = False) -> None:
        """Selects the contents of Result.changes and Result.telegrams; 16 bytes a change."""
        lib.dpsim_run_keep(self, (_c.DPSIM_KEEP_CHANGES if changes else 0) | (_c.DPSIM_KEEP_TELEGRAMS if telegrams else 0))

    def on_change(self, callback: typing.Optional[typing.Callable[[int, int, int, int], typing.Any]]) -> None:
        """Calls callback(tick, slave, pin, level) for all pins of all slaves and the line (slave LINE, pin 0). Some 20 000 per simulated ms: slow."""
        told = None if callback is None else lambda change: callback(change[0].tick, change[0].station, change[0].pin, change[0].level)
        self._keep("change", _c.dpsim_change_fn, told, lambda made: lib.dpsim_run_on_change(self, made, None))

    def on_telegram(self, callback: typing.Optional[typing.Callable[[Heard], typing.Any]]) -> None:
        """Calls `callback` at the end of each telegram."""
        told = None if callback is None else lambda heard: callback(heard_of(heard[0]))
        self._keep("telegram", _c.dpsim_telegram_fn, told, lambda made: lib.dpsim_run_on_telegram(self, made, None))

    def on_event(self, callback: typing.Optional[typing.Callable[[ChipEvent], typing.Any]]) -> None:
        """Calls `callback` for events of the chips; their station is the number of the slave."""
        told = None if callback is None else event_maker(self.kind, callback)
        self._keep("event", _c.dpsim_chip_event_fn, told, lambda made: lib.dpsim_run_on_event(self, made, None))

    def on_text(self, callback: typing.Optional[typing.Callable[[int, str], typing.Any]]) -> None:
        """Calls callback(slave, line) for lines printed by user CPUs. A native user CPU, the only one of this library, prints nothing."""
        told = None if callback is None else lambda slave, line: callback(slave, _text(line))
        self._keep("text", _c.dpsim_text_fn, told, lambda made: lib.dpsim_run_on_text(self, made, None))

    def execute(self, poll: typing.Optional[typing.Callable[[int], bool]] = None) -> "Result":
        """Runs to the end, or until `poll`, called with the tick every 100 us of simulated time, returns False. Once. Releases the GIL.
        InputError: a file cannot be written."""
        asked = None if poll is None else lambda now: int(bool(poll(now)))
        self._keep("poll", _c.dpsim_poll_fn, asked, lambda made: lib.dpsim_run_execute(self, made, None), default=0)
        return Result(self)


_text = text


class Result:
    """The result of a run; a run that has not passed raises no exception.

    `exit_code`, as of `dsdpv1-sim run`: 0 passed; 1 an expectation was not met, or there was a violation that is not allowed; 3 nothing was
    judged; 130 stopped by `poll`. `verdict` also says what was not judged, "PASSED, 140 violations not judged". `passed`: exit_code is 0.
    """

    def __init__(self, executed: Run) -> None:
        got = filled(lambda into: lib.dpsim_run_get_summary(executed, into), _c.dpsim_run_summary)
        self._run = executed
        exit_code, words = ctypes.c_int32(), ctypes.c_char_p()
        lib.dpsim_run_verdict(executed, ctypes.byref(exit_code), ctypes.byref(words))
        self.exit_code, self.verdict = int(exit_code.value), text(words.value)
        self.name, self.slaves, self.kind = executed.name, executed.slaves, executed.kind  # type: str, typing.Tuple[str, ...], Kind
        self.passed, self.interrupted = bool(got.passed), bool(got.interrupted)
        self.simulated = int(got.simulated)  # ticks
        self.violations = int(got.violations)
        self.wall_seconds = float(got.wall_seconds)

    @functools.cached_property
    def data(self) -> typing.Dict[str, typing.Any]:
        """The result as `dsdpv1-sim run --result` writes it (docs/result.md)."""
        return typing.cast(typing.Dict[str, typing.Any], json.loads(number(lambda into: lib.dpsim_run_result(self._run, into), ctypes.c_char_p)))

    @functools.cached_property
    def report(self) -> str:
        """The tables that `dsdpv1-sim run` prints."""
        return text(number(lambda into: lib.dpsim_run_report(self._run, into), ctypes.c_char_p))

    @functools.cached_property
    def changes(self) -> np.ndarray:
        """All pins of all slaves and the line, an array of CHANGE in order of time, each beginning with its power-on level at tick 0. Empty unless
        they were kept."""
        return taken(lib.dpsim_run_read_changes, self._run)

    @functools.cached_property
    def telegrams(self) -> typing.List[Heard]:
        """All kept telegrams, in order of time."""
        array, count = ctypes.POINTER(_c.dpsim_heard)(), ctypes.c_size_t()
        lib.dpsim_run_telegrams(self._run, ctypes.byref(array), ctypes.byref(count))
        return [heard_of(array[i]) for i in range(count.value)]

    def pin(self, name: PinName, slave: typing.Union[int, str] = 0) -> np.ndarray:
        """The changes of one pin of a slave, or of "LINE"."""
        if name == "LINE":
            return of_pin(self.changes, 0, LINE)
        index = self.slaves.index(slave) if isinstance(slave, str) else slave
        return of_pin(self.changes, self.kind.pin(name).number, index)

    def telegram_table(self) -> typing.Any:
        """The telegrams as a pandas DataFrame; pandas must be installed."""
        return table(self.telegrams)


def run(path: typing.Optional[Path] = None, *, changes: bool = False, telegrams: bool = False, **options: typing.Any) -> Result:
    """Runs a scenario to its end. `changes`, `telegrams`: whether to keep them; `options` are those of Run: text, settings, engine, checks, log,
    wave, capture."""
    made = Run(path, **options)
    made.keep(changes, telegrams)
    return made.execute()
