# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The DSDPV1, a PROFIBUS-DP slave ASIC, cycle by cycle: chips pin by pin, a bus with masters and monitor, GSD files, checks, scenarios.

    import dsdpv1
    from dsdpv1 import MS, US

    result = dsdpv1.run("scenarios/power_on_12m.yaml", changes=True, telegrams=True)
    chip = dsdpv1.Chip()
    chip.set("RESET", 1, at=20 * US)
    chip.advance(1 * MS)

Times are whole ticks of 1/12 ns. A refused call raises an Error that says what was wrong and what is allowed. An object, with all that belongs to
it, is used by one thread at a time; different objects are independent, and long calls let other threads run. An exception in a callback propagates
from the call that triggered it. See docs/python.md.
"""
import typing as _typing

from . import registers
from ._library import lib as _lib
from ._library import text as _text
from .bus import Bus, BusStatistics, Station, TsdrStatistics
from .changes import change_type as _change_type
from .changes import of_pin
from .checks import Checker, CheckResult, Rule, Violation, rules
from .chip import AccessTiming, Chip, ChipEvent, ChipStatus, Difference, DpState, Scoreboard, Severity
from .errors import ArgumentError, Error, InputError, InternalError, NotFoundError, StateError, TimeError, UnsupportedError
from .events import AcyclicOutcome, ConnectionEndCause, ConnectionState, Event, EventType, Outcome, RingState, SlaveState
from .gsd import Gsd, GsdInfo, Slave
from .kinds import Kind, Parameter, Pin, kind_names, kind_of
from .master import ConnectionStatus, Master, Master1, Master2, MasterStatus, RingStatus, SlaveStatus, WireFaults
from .runs import Result, Run, run
from .telegram import BROADCAST, Decoded, Heard, Telegram, decode, explain, table
from .telegram import Kind as TelegramKind
from .units import BAUDS, CYCLE, LINE, MS, NEVER, NS, US, S, X, Z, bit_ticks
from .user import Initialisation, Refuse, Request, User, UserError

if _typing.TYPE_CHECKING:
    import numpy as _numpy

    CHANGE: _numpy.dtype[_numpy.void]


def __getattr__(name: str) -> _typing.Any:
    """CHANGE, which needs NumPy, on its first use."""
    if name == "CHANGE":
        return _change_type()
    raise AttributeError(f"module {__name__} has no attribute {name}")


__version__ = _text(_lib.dpsim_version())
__all__ = [
    "BAUDS", "BROADCAST", "CHANGE", "CYCLE", "LINE", "MS", "NEVER", "NS", "S", "US", "X", "Z", "AccessTiming", "AcyclicOutcome", "ArgumentError", "Bus",
    "BusStatistics", "CheckResult", "Checker", "Chip", "ChipEvent", "ChipStatus", "ConnectionEndCause", "ConnectionState", "ConnectionStatus", "Decoded",
    "Difference", "DpState", "Error", "Event", "EventType", "Gsd", "GsdInfo", "Heard", "Initialisation", "InputError", "InternalError", "Kind", "Master", "Master1",
    "Master2", "MasterStatus", "NotFoundError", "Outcome", "Parameter", "Pin", "Refuse", "Request", "Result", "RingState", "RingStatus", "Rule", "Run",
    "Scoreboard", "Severity", "Slave", "SlaveState", "SlaveStatus", "StateError", "Station", "Telegram", "TelegramKind", "TimeError", "TsdrStatistics",
    "UnsupportedError", "User", "UserError", "Violation", "WireFaults", "bit_ticks", "decode", "explain", "kind_names", "kind_of", "of_pin", "registers", "rules",
    "run", "table",
]
