# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of chips in the library, with their pins and parameters."""
import dataclasses
import functools
import typing

from . import _c
from ._library import encoded, filled, lib, text
from .errors import NotFoundError

PinName = typing.Union[str, int]


@dataclasses.dataclass(frozen=True)
class Pin:
    """A pin of a kind of chip: the datasheet's name, number of wires, direction, and initial level."""

    number: int
    name: str
    width: int
    input: bool
    bus: typing.Optional[str]  # the bus of which this pin is one direction: "D" for D_IN and D_OUT
    reset_level: int


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A parameter that the rulings mark (p)."""

    name: str
    unit: str
    description: str
    minimum: int
    maximum: int
    default: int


@dataclasses.dataclass(frozen=True)
class Kind:
    """A kind of chip."""

    name: str
    pins: typing.Tuple[Pin, ...]
    parameters: typing.Tuple[Parameter, ...]
    reasons: typing.Tuple[str, ...]  # codes by number: "PRM_IDENT"

    def pin(self, name: PinName) -> Pin:
        """The pin with a name or number. NotFoundError: unknown."""
        for each in self.pins:
            if name in (each.name, each.number):
                return each
        raise NotFoundError(f"{self.name} has no pin {name}, it has {', '.join(each.name for each in self.pins)}")

    def mask(self, pins: typing.Optional[typing.Iterable[PinName]]) -> int:
        """A set of pins for the library, None: all."""
        return _c.DPSIM_ALL_PINS if pins is None else sum({1 << self.pin(each).number for each in pins})


def _pin(kind: bytes, index: int) -> Pin:
    info = filled(lib.dpsim_pin_get, _c.dpsim_pin_info, kind, index)
    return Pin(info.number, text(info.name), info.width, bool(info.input), text(info.bus) or None, info.reset_level)


def _parameter(kind: bytes, index: int) -> Parameter:
    info = filled(lib.dpsim_parameter_get, _c.dpsim_parameter_info, kind, index)
    return Parameter(text(info.name), text(info.unit), text(info.description), info.minimum, info.maximum, info.default_value)


def _reason(kind: bytes, index: int) -> str:
    return text(filled(lib.dpsim_reason_get, _c.dpsim_reason_info, kind, index).code)


@functools.lru_cache(maxsize=None)
def kind_of(name: typing.Optional[str] = None) -> Kind:
    """The kind with this name, None: the first one. NotFoundError: unknown."""
    names = kind_names()
    if name is None:
        name = names[0]
    if name not in names:
        raise NotFoundError(f"there is no kind {name}, there are {', '.join(names)}")
    raw = encoded(name)
    assert raw is not None
    return Kind(name, tuple(_pin(raw, i) for i in range(lib.dpsim_pin_count(raw))),
                tuple(_parameter(raw, i) for i in range(lib.dpsim_parameter_count(raw))),
                tuple(_reason(raw, i) for i in range(lib.dpsim_reason_count(raw))))


def kind_names() -> typing.List[str]:
    """The kinds in the library."""
    return [text(lib.dpsim_kind_name(i)) for i in range(lib.dpsim_kind_count())]
