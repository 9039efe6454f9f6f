# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""A DUT's ports as the pins of its kind of chip."""
import typing

import cocotb
from cocotb.triggers import Timer

import dsdpv1

from ._cocotb import change_of, release
from .ticks import now

Told = typing.Callable[[int, int, int], typing.Any]


def _number(handle: typing.Any) -> typing.Optional[int]:
    """The value of a signal, None if a bit of it is X or Z."""
    value = handle.value
    return int(value) if value.is_resolvable else None


class ChipPins:
    """The pins of a DUT by the names of its kind (dsdpv1.kind_of): table 1, for a DSDPV1-RSU also straps, SPI and UART; for the SPC3 family those of
    its manual's table 2.1.

    An output that can be released has a second port for its enable: D_OE beside D_OUT, MISO_OE beside MISO, DB_OE beside DB_OUT. Ports have
    rtl_ref's names, those of other kinds by the same rule, unless `names` gives others: {"RESET": "rst_n", "D_OE": "data_en"}. An inverted one begins with "~".
    """

    def __init__(self, dut: typing.Any, names: typing.Optional[typing.Mapping[str, str]] = None, kind: str = "dsdpv1") -> None:
        self.kind = dsdpv1.kind_of(kind)
        self.enables = {each.name: f"{each.bus or each.name}_OE" for each in self.kind.pins if not each.input and each.reset_level == dsdpv1.Z}
        self._ports: typing.Dict[str, typing.Tuple[typing.Any, bool]] = {}
        for pin in (*(each.name for each in self.kind.pins), *self.enables.values()):
            port = (names or {}).get(pin, self._default(pin))
            if not hasattr(dut, port.lstrip("~")):
                raise AttributeError(f"{dut._name} has no port {port} for the pin {pin}; name it in names")  # pylint: disable=protected-access
            self._ports[pin] = getattr(dut, port.lstrip("~")), port.startswith("~")

    def _default(self, pin: str) -> str:
        if pin in self.enables.values():
            return pin.lower() + "_o"
        its = self.kind.pin(pin)
        return (its.bus or pin).lower() + ("_i" if its.input else "_o")

    def port(self, pin: str) -> typing.Any:
        """The handle of a pin."""
        return self._ports[pin][0]

    def level(self, pin: str) -> int:
        """The present level; Z if it is not driven, X if a bit is unknown."""
        if pin in self.enables and self.level(self.enables[pin]) == 0:
            return dsdpv1.Z
        handle, inverted = self._ports[pin]
        value = _number(handle)
        if value is None:
            return dsdpv1.Z if set(str(handle.value).lower()) == {"z"} else dsdpv1.X
        return value ^ ((1 << len(handle)) - 1 if inverted else 0)

    def set(self, pin: str, level: int) -> None:
        """Sets an input at the end of the present time step; Z releases D_IN."""
        handle, inverted = self._ports[pin]
        if level < 0:
            release(handle)
        else:
            handle.value = level ^ ((1 << len(handle)) - 1 if inverted else 0)

    async def power_on(self) -> None:
        """Sets all inputs to the model's power-on levels, so RESET is active. Call it first, before the clock. RESET becomes active within the first
        step, because a simulator without X would otherwise see no edge."""
        for pin in self.kind.pins:
            if pin.input:
                self.set(pin.name, max(pin.reset_level, 0))
        active = self.kind.pin("RESET").reset_level
        self.set("RESET", 1 - active)
        await Timer(1, "step")
        self.set("RESET", active)

    def watch(self, pins: typing.Iterable[str], told: Told) -> typing.List[typing.Any]:
        """Reports (tick, pin's number, level) of each change from now on, after the present levels. Returns the tasks; to stop them is to stop the reports."""
        tasks = []
        for name in pins:
            number = self.kind.pin(name).number
            told(now(), number, self.level(name))
            for port in (name, self.enables[name]) if name in self.enables else (name,):
                tasks.append(cocotb.start_soon(self._tell(self.port(port), name, number, told)))
        return tasks

    async def _tell(self, handle: typing.Any, name: str, number: int, told: Told) -> None:
        edge = change_of(handle)
        while True:
            await edge
            told(now(), number, self.level(name))
