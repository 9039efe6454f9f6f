# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The rules of the user's side (docs/checks.md), checked on a DUT's pins."""
import typing

import dsdpv1
from dsdpv1 import NS, X

from ._cocotb import stop
from .pins import ChipPins
from .ticks import now


class PinChecker:
    """Checks the driver of a DUT's host port: handshake, timing of table 15, cells, service.

    Rules about cells and service also need the telegrams on the line: Segment(...).listeners.append(checker.telegram).
    The first violation fails the test at once.
    """

    def __init__(self, pins: ChipPins, limits: typing.Optional[typing.Mapping[str, typing.Optional[int]]] = None, mode: str = "fail") -> None:
        """`limits`: as in dsdpv1.Checker, ticks; None: the rule is not checked. `mode`: "fail", or "report": violations are kept for `finish` or
        other readers."""
        if mode not in ("fail", "report"):
            raise ValueError(f"mode is {mode}, expected fail, report")
        self.violations: typing.List[dsdpv1.Violation] = []
        self._fails = mode == "fail"
        self._checker = dsdpv1.Checker(pins.kind.name, limits=limits)
        self._checker.on_violation(self.violations.append)
        self._tasks = pins.watch(self._checker.wants, self._pin)

    def _pin(self, tick: int, pin: int, level: int) -> None:
        if level != X:  # not driven yet, or unknown
            self._checker.pin(tick, pin, level)
            self._judge()

    def _judge(self) -> None:
        if self._fails and self.violations:
            self._fail()

    def telegram(self, heard: dsdpv1.Heard) -> None:
        """A telegram on the DUT's line, at its end."""
        self._checker.telegram(heard)
        self._judge()

    @property
    def results(self) -> typing.Dict[str, dsdpv1.CheckResult]:
        """For each rule: how often it was applied, and the worst margin."""
        return self._checker.results

    def finish(self) -> None:
        """Call at the end of a test: fails it if a rule was broken, even in mode "report", or if no rule was applied."""
        for task in self._tasks:
            stop(task)
        self._checker.finish(now())
        if self.violations:
            self._fail()
        if not any(result.count for result in self.results.values()):
            raise AssertionError("nothing was judged: nobody used the host port")

    def _fail(self) -> None:
        first = self.violations[0]
        margin = "" if first.margin is None else f", margin {first.margin / NS:.3f} ns"
        count = len(self.violations)
        raise AssertionError(f"{count} violation{'s' if count > 1 else ''}, the first {first.rule} at {first.tick / NS:.3f} ns{margin}: {first.text}")
