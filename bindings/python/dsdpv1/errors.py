# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Exceptions for refused calls of the library."""
from . import _c


class Error(Exception):
    """A call that the library refused. Nothing was done; the text says what was wrong and what is allowed."""


class ArgumentError(Error, ValueError):
    """A value out of its range."""


class NotFoundError(Error, LookupError):
    """No kind, pin, parameter, slave, connection, rule or module of that name or number."""


class TimeError(Error, ValueError):
    """A tick before the object's present time."""


class StateError(Error, RuntimeError):
    """Not now: inside a callback, after the run, for a master of the other class, for a closed object."""


class InputError(Error, ValueError):
    """A file or text is wrong or cannot be read: "file:line: what is wrong, what is allowed"."""


class UnsupportedError(Error, NotImplementedError):
    """Not supported by the library: an ARM board in a scenario, an access to a chip without a host bus."""


class InternalError(Error):
    """A fault of the library itself; please report its text."""


_CLASSES = {
    _c.DPSIM_ERR_ARGUMENT: ArgumentError,
    _c.DPSIM_ERR_SIZE: InternalError,
    _c.DPSIM_ERR_NOT_FOUND: NotFoundError,
    _c.DPSIM_ERR_TIME: TimeError,
    _c.DPSIM_ERR_STATE: StateError,
    _c.DPSIM_ERR_INPUT: InputError,
    _c.DPSIM_ERR_SPACE: InternalError,
    _c.DPSIM_ERR_UNSUPPORTED: UnsupportedError,
    _c.DPSIM_ERR_INTERNAL: InternalError,
}


def error_of(status: int, message: str) -> Exception:
    """The exception for a status of the C API, with its message."""
    if status == _c.DPSIM_ERR_NO_MEMORY:
        return MemoryError(message)
    return _CLASSES.get(status, InternalError)(message)
