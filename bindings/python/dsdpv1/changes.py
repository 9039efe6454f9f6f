# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Changes of pins as numpy arrays. NumPy is imported at the first request: a run without recorded changes does not need it."""
from __future__ import annotations

import ctypes
import functools
import typing

from ._library import Handle

if typing.TYPE_CHECKING:
    import numpy as np

_PIECE = 1 << 16  # changes, 1 MB


@functools.lru_cache(maxsize=None)
def change_type() -> np.dtype[np.void]:
    """CHANGE: tick (1/12 ns), station (of a bus the station, of a run the slave, LINE; else 0), pin (its number), level (also Z, X)."""
    import numpy  # pylint: disable=import-outside-toplevel
    return numpy.dtype({"names": ["tick", "station", "pin", "level"], "formats": ["u8", "u2", "u2", "i2"], "offsets": [0, 8, 10, 12], "itemsize": 16})


def address(changes: np.ndarray) -> int:
    """The address of an array of CHANGE, for the library."""
    return int(changes.__array_interface__["data"][0])


def as_changes(changes: typing.Any) -> np.ndarray:
    """Converts an array or a list of (tick, station, pin, level) to an array of CHANGE."""
    import numpy  # pylint: disable=import-outside-toplevel
    return numpy.ascontiguousarray(changes, dtype=change_type())


def taken(read: typing.Callable[..., typing.Any], source: Handle) -> np.ndarray:
    """All kept changes, by one of the functions ..._read_changes."""
    import numpy  # pylint: disable=import-outside-toplevel
    pieces, count = [], ctypes.c_size_t(_PIECE)
    while count.value == _PIECE:
        piece = numpy.empty(_PIECE, change_type())
        read(source, address(piece), _PIECE, ctypes.byref(count))
        pieces.append(piece[:count.value])
    return pieces[0].copy() if len(pieces) == 1 else numpy.concatenate(pieces)


def of_pin(changes: np.ndarray, pin: int, station: typing.Optional[int] = None) -> np.ndarray:
    """The changes of one pin, of one station if given."""
    chosen = changes["pin"] == pin
    if station is not None:
        chosen &= changes["station"] == station
    return typing.cast("np.ndarray", changes[chosen])
