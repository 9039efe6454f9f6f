# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""One chip, driven pin by pin, and its events; the model compared with a DUT."""
from __future__ import annotations

import ctypes
import dataclasses
import enum
import typing

from . import _c
from ._library import Handle, encoded, filled, lib, number, sized, text
from .changes import address, as_changes, taken
from .kinds import Kind, PinName, kind_of
from .units import NEVER, baud_name

if typing.TYPE_CHECKING:
    import numpy as np

ENGINES = ("skip", "step")


class DpState(enum.IntEnum):
    """States of a DP slave (table 5)."""

    OFFLINE = _c.DPSIM_DP_OFFLINE
    WAIT_PRM = _c.DPSIM_DP_WAIT_PRM
    WAIT_CFG = _c.DPSIM_DP_WAIT_CFG
    DATA_EXCH = _c.DPSIM_DP_DATA_EXCH


class Severity(enum.IntEnum):
    """Severity of a chip's event: a state or service, a refusal, a rule broken by the user's side."""

    INFO = _c.DPSIM_SEVERITY_INFO
    REFUSAL = _c.DPSIM_SEVERITY_REFUSAL
    VIOLATION = _c.DPSIM_SEVERITY_VIOLATION


@dataclasses.dataclass(frozen=True)
class ChipEvent:
    """An event of a chip."""

    tick: int
    station: int
    code: str  # from docs/reasons.md, never changes: "PRM_IDENT"
    severity: Severity
    text: str


@dataclasses.dataclass(frozen=True)
class ChipStatus:
    """States and counters of a chip, as in dpsim_chip_status."""

    dp_state: DpState
    baud: typing.Optional[str]  # None: the search is running
    address: int  # 0 before the initialisation
    master: typing.Optional[int]  # the parameterising one
    telegrams_received: int
    telegrams_answered: int
    data_exchanges: int
    outputs_missed: int  # H5: blocks that newer ones replaced before the user fetched them
    accesses: int
    longest_wait: int  # H1: the most ticks that a due access waited for the user


@dataclasses.dataclass(frozen=True)
class AccessTiming:
    """When the pins change during an access of the host bus, in ticks (table 15, P5, P11); the defaults keep all limits. None: the default."""

    address_setup: typing.Optional[int] = None  # A before the strobe falls (Tc >= 0)
    cs_lead: typing.Optional[int] = None  # CSR falls before the strobe
    rd_low: typing.Optional[int] = None  # > 0
    rd_sample: typing.Optional[int] = None  # D sampled after RD fell (Tw >= 375)
    wr_low: typing.Optional[int] = None  # > 0 (Ts >= 150)
    data_setup: typing.Optional[int] = None  # D before WR rises (Td >= 150)
    data_hold: typing.Optional[int] = None  # D after WR rises (Td >= 150)
    address_hold: typing.Optional[int] = None  # A after the strobe rises (writes: Td >= 150)
    cs_trail: typing.Optional[int] = None  # CSR rises after the strobe
    recovery: typing.Optional[int] = None  # from the last edge to the end of the access

    def complete(self) -> "AccessTiming":
        """Replaces None by the defaults."""
        default = filled(lib.dpsim_access_timing_default, _c.dpsim_access_timing)
        return AccessTiming(**{each.name: getattr(default, each.name) if getattr(self, each.name) is None else getattr(self, each.name)
                               for each in dataclasses.fields(self)})

    def _native(self) -> typing.Any:
        return ctypes.byref(sized(_c.dpsim_access_timing, **dataclasses.asdict(self.complete())))


def event_maker(kind: Kind, tell: typing.Callable[[ChipEvent], typing.Any]) -> typing.Callable[[typing.Any], None]:
    """A callback for the library that converts events to text."""
    raw, buffer = encoded(kind.name), ctypes.create_string_buffer(256)

    def told(event: typing.Any) -> None:
        lib.dpsim_chip_event_text(raw, event, ctypes.addressof(buffer), 256)
        info = filled(lib.dpsim_reason_get, _c.dpsim_reason_info, raw, event[0].reason)
        tell(ChipEvent(event[0].tick, event[0].station, text(info.code), Severity(info.severity), text(buffer.value)))

    return told


def _timing(timing: typing.Optional[AccessTiming]) -> typing.Any:
    return None if timing is None else timing._native()  # pylint: disable=protected-access


def chip_options(engine: str, kind: typing.Optional[str], name: typing.Optional[str], parameters: typing.Mapping[str, int]) -> typing.Any:
    """The options of Chip() and Bus.add_chip() for the library."""
    if engine not in ENGINES:
        raise ValueError(f"engine is {engine}, expected {', '.join(ENGINES)}")
    table = (_c.dpsim_parameter * max(1, len(parameters)))(*(_c.dpsim_parameter(encoded(key), value) for key, value in parameters.items()))
    return sized(_c.dpsim_chip_options, engine=ENGINES.index(engine), kind=encoded(kind), name=encoded(name),
                 parameters=ctypes.cast(table, ctypes.POINTER(_c.dpsim_parameter)), parameter_count=len(parameters))


def _unpickled(kind: str, engine: str, parameters: typing.Mapping[str, int], state: bytes) -> "Chip":
    made = Chip(kind, engine, parameters)
    made.restore(state)
    return made


class Chip(Handle):
    """A chip without a bus, at power-on and tick 0: RESET is low.

    A change of an input at tick t is seen by the first rising edge of CLK strictly after t (P9); the host port, which is asynchronous, sees it at
    t. Calls come in order of time: a tick before the present one is a TimeError. `at` None is the present tick. Pins are given by name or number.
    On a bus (Bus.add_chip) setting or advancing the chip runs the whole bus.

    A chip without a bus can be saved and restored, and so be copied and pickled: the copy continues from the same state, without watched pins and
    callbacks.
    """

    def __init__(self, kind: typing.Optional[str] = None, engine: str = "skip", parameters: typing.Optional[typing.Mapping[str, int]] = None) -> None:
        """`engine` "step" evaluates each cycle: slow, with the same changes. `parameters`: those that differ from the default."""
        options = chip_options(engine, kind, None, parameters or {})
        super().__init__(number(lambda into: lib.dpsim_chip_create(ctypes.byref(options), into), ctypes.c_void_p), lib.dpsim_chip_destroy)
        self._set_kind(kind)
        self._made_with = (engine, dict(parameters or {}))

    @classmethod
    def _of(cls, handle: int, kind: typing.Optional[str]) -> "Chip":
        """A chip owned by its bus."""
        self = cls.__new__(cls)
        Handle.__init__(self, handle, None)
        self._set_kind(kind)
        return self

    def _set_kind(self, kind: typing.Optional[str]) -> None:
        self.kind = kind_of(kind)
        self._numbers: typing.Dict[PinName, int] = {each.name: each.number for each in self.kind.pins}
        self._numbers.update({each.number: each.number for each in self.kind.pins})

    def _number(self, pin: PinName) -> int:
        found = self._numbers.get(pin)
        return self.kind.pin(pin).number if found is None else found

    # ---- pins and time
    @property
    def now(self) -> int:
        """The present tick."""
        return int(number(lambda into: lib.dpsim_chip_now(self, into), ctypes.c_uint64))

    @property
    def next(self) -> int:
        """The tick of the chip's next activity that needs no call; NEVER: none until an input changes."""
        return int(number(lambda into: lib.dpsim_chip_next(self, into), ctypes.c_uint64))

    def set(self, pin: PinName, level: int, at: typing.Optional[int] = None) -> None:
        """Runs up to `at`, then sets an input: 0 or 1, the value of a pin with several wires, or Z for D_IN."""
        lib.dpsim_chip_set(self, self.now if at is None else at, self._number(pin), level)

    def set_many(self, changes: typing.Any) -> None:
        """Sets many at once: an array of CHANGE or a list of (tick, station, pin, level); stations are ignored."""
        array = as_changes(changes)
        lib.dpsim_chip_set_many(self, address(array), len(array), None)

    def receive(self, data: bytes, bit: int, at: typing.Optional[int] = None) -> int:
        """Sends characters to PBRXD of a chip without a bus, with even parity, back to back, each bit `bit` ticks long (bit_ticks). Returns the
        end of the last stop bit, which is then the present tick. StateError: the chip is on a bus."""
        start = self.now if at is None else at
        return int(number(lambda into: lib.dpsim_chip_receive(self, start, bit, bytes(data), len(data), into), ctypes.c_uint64))

    def advance(self, to: int) -> None:
        """Runs up to and including tick `to`. Releases the GIL."""
        lib.dpsim_chip_advance(self, to)

    def level(self, pin: PinName) -> int:
        """The present level of a pin, input or output; Z, X."""
        return int(number(lambda into: lib.dpsim_chip_level(self, self._number(pin), into), ctypes.c_int16))

    def sample(self, at: typing.Optional[int] = None) -> int:
        """Samples D at this tick as the user. Earlier than Tw (P5) the level is X, and a violation is reported."""
        return int(number(lambda into: lib.dpsim_chip_sample(self, self.now if at is None else at, into), ctypes.c_int16))

    # ---- accesses
    def read(self, cell: int, at: typing.Optional[int] = None, timing: typing.Optional[AccessTiming] = None) -> int:
        """Reads a cell, 0 to 0x7FF, through the pins; the present tick is then the end of the access. X if the chip does not define it. The caller
        must own the DPRAM of a DSDPV1 (H2). SPC3 family: the asynchronous Intel bus, without a look at XREADY (A42)."""
        value, end = ctypes.c_int16(), ctypes.c_uint64()
        lib.dpsim_chip_read(self, self.now if at is None else at, cell, _timing(timing), ctypes.byref(value), ctypes.byref(end))
        return value.value

    def write(self, cell: int, value: int, at: typing.Optional[int] = None, timing: typing.Optional[AccessTiming] = None) -> None:
        """Writes a cell in the same way."""
        lib.dpsim_chip_write(self, self.now if at is None else at, cell, value, _timing(timing), ctypes.byref(ctypes.c_uint64()))

    def load(self, address: int, at: typing.Optional[int] = None) -> int:
        """Reads a register or byte of an SPC3, APC3 or VPC3+ with all effects, without the pins of its bus. UnsupportedError: another kind."""
        return int(number(lambda into: lib.dpsim_chip_load(self, self.now if at is None else at, address, into), ctypes.c_uint8))

    def store(self, address: int, value: int, at: typing.Optional[int] = None) -> None:
        """Writes one in the same way."""
        lib.dpsim_chip_store(self, self.now if at is None else at, address, value)

    # ---- serial ports of the user: DSDPV1-RSU, VPC3+ (SPI), XGate-DPS10
    def spi(self, data: bytes, at: typing.Optional[int] = None, bit: int = 0, byte_gap: int = 0) -> bytes:
        """Sends bytes in one frame of XSS or NSS, with all edges, and returns those of MISO; the present tick is then the end of the frame. `bit`:
        ticks of a bit, 0: 9 MHz, of an XGate-DPS10 1 MHz. UnsupportedError: the chip has no SPI, or its strap or parameter chooses another port."""
        timing, received = sized(_c.dpsim_spi_timing, bit=bit, byte_gap=byte_gap), ctypes.create_string_buffer(max(1, len(data)))
        lib.dpsim_chip_spi(self, self.now if at is None else at, ctypes.byref(timing), bytes(data), ctypes.addressof(received), len(data),
                           ctypes.byref(ctypes.c_uint64()))
        return received.raw[:len(data)]

    def uart_open(self, rate: int) -> None:
        """Opens the user's UART at `rate` bit/s: from now on it receives all that the chip sends. Again: another rate; received bytes are dropped."""
        lib.dpsim_chip_uart_open(self, rate)

    def uart_send(self, data: bytes, at: typing.Optional[int] = None) -> int:
        """Sends characters to RXD, back to back. Returns the end of the last stop bit, which is then the present tick. StateError: uart_open()
        was not called."""
        start = self.now if at is None else at
        return int(number(lambda into: lib.dpsim_chip_uart_send(self, start, bytes(data), len(data), into), ctypes.c_uint64))

    def uart_receive(self, count: int, until: typing.Optional[int] = None) -> bytes:
        """Takes the oldest received bytes: runs until there are `count` of them, at most up to `until`; None: those that have come."""
        received = ctypes.create_string_buffer(max(1, count))
        size = number(lambda into: lib.dpsim_chip_uart_receive(self, self.now if until is None else until, ctypes.addressof(received), count, into),
                      ctypes.c_size_t)
        return received.raw[:size]

    def peek(self, cell: int) -> int:
        """Reads a cell without pins, time or side effects."""
        return int(number(lambda into: lib.dpsim_chip_peek(self, cell, into), ctypes.c_uint8))

    def poke(self, cell: int, value: int) -> None:
        """Writes a cell without pins; the chip finds it at its next access."""
        lib.dpsim_chip_poke(self, cell, value)

    # ---- save and restore
    def save(self) -> bytes:
        """The complete state of the chip at the present tick, for restore() here or in another process. Callbacks, watched pins and kept changes
        are not saved. StateError: the chip is on a bus, whose line, masters and time are not part of a chip.

            path.write_bytes(chip.save())
            ...
            again = dsdpv1.Chip()
            again.restore(path.read_bytes())
        """
        state = ctypes.create_string_buffer(_c.DPSIM_MAX_CHIP_STATE)
        size = number(lambda into: lib.dpsim_chip_save(self, ctypes.addressof(state), len(state), into), ctypes.c_size_t)
        return state.raw[:size]

    def restore(self, state: bytes) -> None:
        """Resumes the saved chip at its tick, which may be before the present one. Kind and parameters must be the same, the engine need not.
        Callbacks and watched pins stay; kept changes are discarded. InputError: the bytes are not a state of such a chip, which is then unchanged."""
        lib.dpsim_chip_restore(self, bytes(state), len(state))

    def __reduce__(self) -> typing.Any:
        state = self.save()
        return _unpickled, (self.kind.name, *self._made_with, state)

    # ---- events
    def watch(self, pins: typing.Optional[typing.Iterable[PinName]] = None,
              callback: typing.Optional[typing.Callable[[int, str, int], typing.Any]] = None) -> None:
        """Reports changes of these pins (None: all, []: none) from now on, in order of time: by callback(tick, pin, level), or by keeping them for
        changes(). In the callback the chip must not be changed."""
        names = [each.name for each in self.kind.pins]
        told = None if callback is None else lambda change: callback(change[0].tick, names[change[0].pin], change[0].level)
        self._keep("watch", _c.dpsim_change_fn, told, lambda made: lib.dpsim_chip_watch(self, self.kind.mask(pins), made, None))

    def changes(self) -> np.ndarray:
        """Takes the changes kept by watch(): an array of CHANGE. Memory grows until they are taken."""
        return taken(lib.dpsim_chip_read_changes, self)

    def on_event(self, callback: typing.Optional[typing.Callable[[ChipEvent], typing.Any]]) -> None:
        """Calls `callback` for states, refusals and violations; None: no callback."""
        told = None if callback is None else event_maker(self.kind, callback)
        self._keep("event", _c.dpsim_chip_event_fn, told, lambda made: lib.dpsim_chip_on_event(self, made, None))

    @property
    def status(self) -> ChipStatus:
        """States and counters; changes nothing."""
        got = filled(lambda into: lib.dpsim_chip_get_status(self, into), _c.dpsim_chip_status)
        return ChipStatus(DpState(got.dp_state), baud_name(got.baud), got.address, None if got.master == 255 else got.master, got.telegrams_received,
                          got.telegrams_answered, got.data_exchanges, got.outputs_missed, got.accesses, got.longest_wait)

    @property
    def station(self) -> int:
        """Its number on the bus. StateError: the chip is not on a bus."""
        return int(number(lambda into: lib.dpsim_chip_station(self, into), ctypes.c_uint16))


@dataclasses.dataclass(frozen=True)
class Difference:
    """The first difference, and the events before it."""

    tick: int  # its start
    pin: str
    model: int  # its levels
    dut: int
    last_input: typing.Optional[typing.Tuple[int, str, int]]  # tick, pin, level
    events: typing.Tuple[ChipEvent, ...]  # the model's last three, the latest first


class Scoreboard(Handle):
    """The model gets the DUT's inputs, and the DUT's outputs must equal the model's at every tick (include/dsdpv1/chip.h has the rules)."""

    def __init__(self, kind: typing.Optional[str] = None, parameters: typing.Optional[typing.Mapping[str, int]] = None, tolerance: int = 0,
                 warm_up: int = 0) -> None:
        """`parameters`: those of the DUT. A difference that lasts at most `tolerance` ticks is ignored; comparison starts when RESET has been low
        for `warm_up` ticks, during which RTL may have X, 0: from tick 0."""
        options = sized(_c.dpsim_scoreboard_options, tolerance=tolerance, warm_up=warm_up)
        model = chip_options("skip", kind, None, parameters or {})
        super().__init__(number(lambda into: lib.dpsim_scoreboard_create(ctypes.byref(model), ctypes.byref(options), into), ctypes.c_void_p),
                         lib.dpsim_scoreboard_destroy)
        self.kind = kind_of(kind)
        self._result = sized(_c.dpsim_scoreboard_result)

    def compare(self, changes: typing.Any, until: int) -> typing.Optional[Difference]:
        """Feeds the DUT's changes: an array of CHANGE or a list of (tick, station, pin's number, level); it makes no others up to `until`. All
        ticks before `until` are judged. Returns the first difference so far; after it comparison stops."""
        array, got, events = as_changes(changes), self._result, typing.cast(typing.List[ChipEvent], [])
        lib.dpsim_scoreboard_compare(self, address(array), len(array), until, ctypes.byref(got))
        if got.tick == NEVER:
            return None
        tell, pins = event_maker(self.kind, events.append), self.kind.pins
        for event in got.events[:got.event_count]:
            tell(ctypes.pointer(event))
        last_input = None if got.input_tick == NEVER else (got.input_tick, pins[got.input].name, got.input_level)
        return Difference(got.tick, pins[got.pin].name, got.model, got.dut, last_input, tuple(events))

    @property
    def matched(self) -> int:
        """Changes of the model's outputs that the DUT made as well."""
        return int(self._result.matched)
