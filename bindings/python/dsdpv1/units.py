# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Time: whole ticks of 1/12 ns since the start of simulation, in which every time of the chip's documents and of PROFIBUS is a whole number.

``chip.advance(150 * US)`` is 150 us; ``tick / NS`` is a tick in ns. Convert absolute times, so that nothing drifts.
"""
import typing

NS = 12  # ticks
US = 1000 * NS
MS = 1000 * US
S = 1000 * MS
CYCLE = 250  # of the chip's 48 MHz clock
NEVER = 2**64 - 1  # result meaning "never"
Z = -1  # a level: released
X = -2  # a level: unknown
LINE = 0xFFFF  # used instead of a station: the two wires of the segment

BAUDS = ("12M", "6M", "3M", "1.5M", "500k", "187.5k", "93.75k", "45.45k", "19.2k", "9.6k")  # by their number in B012 (table 5)
_BIT_CYCLES = (4, 8, 16, 32, 96, 256, 512, 1056, 2500, 5000)  # S2


def bit_ticks(baud: str) -> int:
    """Ticks of one bit at a rate of BAUDS: at every rate a whole number of the chip's cycles (S2)."""
    return _BIT_CYCLES[baud_index(baud)] * CYCLE


def baud_index(baud: str) -> int:
    """The number of a rate, as B012 codes it (table 5). ValueError: unknown rate."""
    if baud not in BAUDS:
        raise ValueError(f"baud is {baud}, expected {', '.join(BAUDS)}")
    return BAUDS.index(baud)


def baud_name(index: int) -> typing.Optional[str]:
    """The rate with this number, None while the search is running."""
    return BAUDS[index] if 0 <= index < len(BAUDS) else None
