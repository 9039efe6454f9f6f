# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""PROFIBUS and the DSDPV1 in cocotb: masters, source, sink, monitor, the user CPU at the host port, and the model as reference.

All events are at their tick of 1/12 ns; see docs/cocotb.md.
"""
from .checks import PinChecker
from .host_port import HostPort
from .pins import ChipPins
from .replay import PinSource
from .scoreboard import Difference, Scoreboard, ScoreboardError
from .segment import Master1, Master2, Segment
from .ticks import Clock, now, steps_of, until, wait
from .uart import Character, ProfibusMonitor, ProfibusSink, ProfibusSource

__all__ = ["Character", "ChipPins", "Clock", "Difference", "HostPort", "Master1", "Master2", "PinChecker", "PinSource", "ProfibusMonitor", "ProfibusSink",
           "ProfibusSource", "Scoreboard", "ScoreboardError", "Segment", "now", "steps_of", "until", "wait"]
