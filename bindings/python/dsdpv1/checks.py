# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The rules of a chip's user side (docs/checks.md), applied to pins from any source: a model, RTL or a recording."""
import ctypes
import dataclasses
import typing

from . import _c
from ._library import Handle, encoded, filled, lib, number, sized, text
from .changes import address, as_changes
from .kinds import PinName, kind_of
from .telegram import Heard, native_of
from .units import NEVER


@dataclasses.dataclass(frozen=True)
class Rule:
    """One rule. `limit` in ticks; None: only measured, or kept or violated."""

    name: str  # stable: "TIMING_TS"
    rule: str  # what must hold
    clause: str
    advice: str
    bound: str  # "min", "max": of a value; "most": of a number; "rule": kept or not
    limit: typing.Optional[int]


@dataclasses.dataclass(frozen=True)
class Violation:
    """A rule that was broken. Ticks."""

    tick: int
    found: int  # when it became visible
    rule: str  # its name
    margin: typing.Optional[int]  # below 0
    text: str
    pins: str  # the last changes of the pins that the rule concerns


@dataclasses.dataclass(frozen=True)
class CheckResult:
    """Result of one rule, so far. Ticks."""

    count: int  # how often it was applied
    violations: int
    worst_margin: typing.Optional[int]  # the least one, positive = kept
    worst_value: typing.Optional[int]
    at: typing.Optional[int]  # when that was


def rules(kind: typing.Optional[str] = None) -> typing.Tuple[Rule, ...]:
    """All rules of a kind of chip, in the order of their numbers."""
    raw = encoded(kind_of(kind).name)
    found = []
    for index in range(lib.dpsim_rule_count(raw)):
        info = filled(lib.dpsim_rule_get, _c.dpsim_rule_info, raw, index)
        limit = None if info.bound == _c.DPSIM_BOUND_RULE or info.limit == _c.DPSIM_NO_LIMIT else info.limit
        found.append(Rule(text(info.name), text(info.rule), text(info.clause), text(info.advice), ("min", "max", "rule", "most")[info.bound], limit))
    return tuple(found)


class Checker(Handle):
    """Feed it all changes of pins in order of time, if possible also telegrams; results may be read at any time."""

    def __init__(self, kind: typing.Optional[str] = None, limits: typing.Optional[typing.Mapping[str, typing.Optional[int]]] = None) -> None:
        """`limits`: other limits by the rule's name, in ticks; None: not checked."""
        limits = limits or {}
        table = (_c.dpsim_limit * max(1, len(limits)))(*(_c.dpsim_limit(encoded(name), value or 0, int(value is None)) for name, value in limits.items()))
        options = sized(_c.dpsim_checker_options, kind=encoded(kind), limit_count=len(limits), limits=ctypes.cast(table, ctypes.POINTER(_c.dpsim_limit)))
        super().__init__(number(lambda into: lib.dpsim_checker_create(ctypes.byref(options), into), ctypes.c_void_p), lib.dpsim_checker_destroy)
        self._kind, self._rules = kind_of(kind), rules(kind)

    def on_violation(self, callback: typing.Optional[typing.Callable[[Violation], typing.Any]]) -> None:
        """Calls `callback` as soon as a violation is visible, during the call that feeds the pins; None: violations are only counted."""
        def told(native: typing.Any) -> None:
            got = native[0]
            assert callback is not None
            callback(Violation(got.tick, got.found, text(got.name), got.margin if got.has_margin else None, text(got.text), text(got.pins)))

        self._keep("violation", _c.dpsim_violation_fn, None if callback is None else told,
                   lambda made: lib.dpsim_checker_on_violation(self, made, None))

    @property
    def wants(self) -> typing.Tuple[str, ...]:
        """The pins that it needs; other pins may be fed as well."""
        mask = number(lambda into: lib.dpsim_checker_wants(self, into), ctypes.c_uint64)
        return tuple(each.name for each in self._kind.pins if mask >> each.number & 1)

    def pin(self, tick: int, pin: PinName, level: int) -> None:
        """Feeds a change of a pin."""
        lib.dpsim_checker_pin(self, tick, self._kind.pin(pin).number, level)

    def pins(self, changes: typing.Any) -> None:
        """Feeds many changes: an array of CHANGE, as returned by Chip.changes(), of any station."""
        array = as_changes(changes)
        lib.dpsim_checker_pins(self, address(array), len(array), None)

    def sample(self, tick: int) -> None:
        """Announces, before a read that starts now, that the user samples D at `tick`; without this call the time is derived from the pins (P5)."""
        lib.dpsim_checker_sample(self, tick)

    def telegram(self, heard: Heard) -> None:
        """Feeds a telegram on the chip's line, at its end: rules about cells and service need them."""
        lib.dpsim_checker_telegram(self, ctypes.byref(native_of(heard)))

    def finish(self, tick: int) -> None:
        """Call once, at the end; after it only results may be read."""
        lib.dpsim_checker_finish(self, tick)

    @property
    def results(self) -> typing.Dict[str, CheckResult]:
        """Results by the rule's name."""
        return {rule.name: self._result(index) for index, rule in enumerate(self._rules)}

    def _result(self, index: int) -> CheckResult:
        got = filled(lambda into: lib.dpsim_checker_get_result(self, index, into), _c.dpsim_check_result)
        return CheckResult(got.count, got.violations, got.worst_margin if got.has_margin else None, got.worst_value if got.has_value else None,
                           None if got.at == NEVER else got.at)
