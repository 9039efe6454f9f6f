# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Loads and checks libdsdpv1 with ctypes and turns its errors into exceptions. ctypes releases the GIL during a call.

The environment variable DSDPV1_LIBRARY selects another libdsdpv1.so than the one installed with this package.
"""
import ctypes
import functools
import os
import pathlib
import threading
import typing

from . import _c
from .errors import StateError, error_of

# Beside the generated module, not beside this one: pip install -e leaves the sources of the package where they are.
_PACKAGED = pathlib.Path(_c.__file__).parent / "lib" / f"libdsdpv1.so.{_c.DPSIM_ABI_MAJOR}"
_thread = threading.local()


def _path() -> str:
    """The library named in the environment, the package's own, or the one known to the system's loader."""
    named = os.environ.get("DSDPV1_LIBRARY")
    if named:
        return named
    return str(_PACKAGED) if _PACKAGED.is_file() else _PACKAGED.name


def _load() -> ctypes.CDLL:
    try:
        library = ctypes.CDLL(_path())
    except OSError as error:
        raise ImportError(f"{error}: no libdsdpv1; set DSDPV1_LIBRARY to its path, or install this package by pip") from None
    found = library.dpsim_abi_version()
    wanted = _c.DPSIM_ABI_MAJOR * 65536 + _c.DPSIM_ABI_MINOR
    if found // 65536 != _c.DPSIM_ABI_MAJOR or found < wanted:
        raise ImportError(f"{_path()} has the ABI {found // 65536}.{found % 65536}, expected {_c.DPSIM_ABI_MAJOR}, "
                          f"{_c.DPSIM_ABI_MINOR} or later")
    return library


def _raise_pending() -> None:
    """Raises the exception of a callback that ran during the call."""
    pending = getattr(_thread, "pending", None)
    if pending is not None:
        _thread.pending = None
        raise pending


def _check(status: int, _function: typing.Any, arguments: typing.Any) -> typing.Any:
    _raise_pending()
    if status != _c.DPSIM_OK:
        if isinstance(arguments[0], Handle) and arguments[0].closed:
            raise StateError(f"this {type(arguments[0]).__name__} is closed")
        raise error_of(status, text(lib.dpsim_error_message()))
    return arguments


class _Library:
    """The functions of the C API by name, bound at first use."""

    def __init__(self) -> None:
        self._library = _load()

    def __getattr__(self, name: str) -> typing.Any:
        try:
            result, arguments = _c.FUNCTIONS[name]
        except KeyError:
            raise AttributeError(name) from None
        function = getattr(self._library, name)
        function.restype, function.argtypes = result, arguments
        if result is _c.dpsim_status and name != "dpsim_status":
            function.errcheck = _check
        setattr(self, name, function)
        return function


def text(value: typing.Optional[bytes]) -> str:
    """A text of the library; "" for NULL."""
    return value.decode("utf-8", "replace") if value else ""


def encoded(value: typing.Optional[str]) -> typing.Optional[bytes]:
    """A text for the library; None: its default."""
    return None if value is None else os.fspath(value).encode("utf-8")


def sized(struct: typing.Any, **members: typing.Any) -> typing.Any:
    """A struct of the C API with its size set."""
    return struct(size=ctypes.sizeof(struct), **members)


def filled(function: typing.Any, struct: typing.Any, *arguments: typing.Any) -> typing.Any:
    """Returns the struct that a function fills through its last argument."""
    into = sized(struct)
    function(*arguments, ctypes.byref(into))
    return into


def number(function: typing.Any, kind: typing.Any, *arguments: typing.Any) -> typing.Any:
    """Returns the number, text or handle that a function writes through its last argument."""
    into = kind()
    function(*arguments, ctypes.byref(into))
    return into.value


def as_bytes(pointer: typing.Any, count: int) -> bytes:
    return ctypes.string_at(pointer, count) if count else b""


def callback(kind: typing.Any, function: typing.Optional[typing.Callable[..., typing.Any]], default: typing.Any = None) -> typing.Any:
    """Wraps `function`, which is called with all arguments except the user pointer. Its exception is raised to the caller of the library call;
    until then callbacks of this thread do nothing."""
    if function is None:
        return kind()  # NULL

    @functools.wraps(function)
    def guarded(_user: typing.Any, *arguments: typing.Any) -> typing.Any:
        if getattr(_thread, "pending", None) is not None:
            return default
        try:
            return function(*arguments)
        except BaseException as error:  # pylint: disable=broad-except
            _thread.pending = error
            return default

    return kind(guarded)


class Handle:
    """An object of the library, released by close(), at the end of a `with` block, or when it is no longer referenced."""

    def __init__(self, handle: int, destroy: typing.Optional[typing.Any]) -> None:
        self._as_parameter_: typing.Optional[int] = handle  # the value that ctypes passes to the library
        self._destroy = destroy
        self._callbacks: typing.Dict[str, typing.Any] = {}  # the library holds their addresses

    @property
    def closed(self) -> bool:
        """True if it has been released."""
        return self._as_parameter_ is None

    def close(self) -> None:
        """Releases it; afterwards every call raises a StateError. Further calls of close() do nothing."""
        handle, self._as_parameter_ = getattr(self, "_as_parameter_", None), None
        if handle is not None and self._destroy is not None:
            self._destroy(handle)
        self._callbacks = {}

    def __enter__(self) -> typing.Any:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        try:
            self.close()
        except Exception:  # at the interpreter's exit
            pass

    def _keep(self, name: str, kind: typing.Any, function: typing.Optional[typing.Callable[..., typing.Any]],
              tell: typing.Callable[[typing.Any], None], default: typing.Any = None) -> None:
        """Sets `function` as the library's callback, then drops the earlier one."""
        made = callback(kind, function, default)
        tell(made)
        self._callbacks[name] = made


lib = _Library()
