# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Telegrams of the data link layer (EN 50170, IEC 61158-4 type 3) as fields, bytes and text."""
import ctypes
import dataclasses
import enum
import typing

from . import _c
from ._library import as_bytes, lib, sized, text
from .units import BAUDS, NEVER, US, bit_ticks

BROADCAST = _c.DPSIM_BROADCAST


class Kind(enum.IntEnum):
    """Start delimiters."""

    SD1 = _c.DPSIM_SD1  # no data
    SD2 = _c.DPSIM_SD2  # data of variable length
    SD3 = _c.DPSIM_SD3  # 8 bytes
    SD4 = _c.DPSIM_SD4  # the token
    SC = _c.DPSIM_SC  # short acknowledge


@dataclasses.dataclass(frozen=True)
class Telegram:
    """A telegram as fields. SAPs are None without an extension byte; `data` does not include them."""

    kind: Kind
    da: int = 0
    sa: int = 0
    fc: int = 0
    data: bytes = b""
    dsap: typing.Optional[int] = None
    ssap: typing.Optional[int] = None

    def _native(self) -> typing.Any:
        if len(self.data) > _c.DPSIM_MAX_DATA:
            raise ValueError(f"data has {len(self.data)} bytes, expected 0 to {_c.DPSIM_MAX_DATA}")
        made = sized(_c.dpsim_telegram, kind=self.kind, da=self.da, sa=self.sa, fc=self.fc, data_size=len(self.data))
        made.dsap, made.ssap = (_c.DPSIM_NO_SAP if sap is None else sap for sap in (self.dsap, self.ssap))
        made.data[:len(self.data)] = self.data
        return made

    def encode(self) -> bytes:
        """The bytes on the wire, with FCS. ArgumentError: a field out of range, or data that do not fit the kind."""
        buffer, count = ctypes.create_string_buffer(_c.DPSIM_MAX_TELEGRAM), ctypes.c_size_t()
        lib.dpsim_telegram_encode(ctypes.byref(self._native()), ctypes.addressof(buffer), len(buffer), ctypes.byref(count))
        return buffer.raw[:count.value]


@dataclasses.dataclass(frozen=True)
class Decoded:
    """The first telegram of some bytes."""

    telegram: typing.Optional[Telegram]  # also set if only FCS or end delimiter are wrong
    error: str  # "wrong FCS"; "" for a right one
    used: int  # bytes; for an invalid one up to the place of the error


def _sap(value: int) -> typing.Optional[int]:
    return None if value == _c.DPSIM_NO_SAP else value


def decode(data: bytes) -> Decoded:
    """The first telegram of `data`, valid or not."""
    made, error, used = sized(_c.dpsim_telegram), ctypes.c_int32(), ctypes.c_size_t()
    lib.dpsim_telegram_decode(bytes(data), len(data), ctypes.byref(made), ctypes.byref(error), ctypes.byref(used))
    known = error.value in (_c.DPSIM_DECODE_OK, _c.DPSIM_DECODE_FCS, _c.DPSIM_DECODE_END_DELIMITER)
    telegram = Telegram(Kind(made.kind), made.da, made.sa, made.fc, bytes(made.data[:made.data_size]), _sap(made.dsap), _sap(made.ssap))
    return Decoded(telegram if known else None, text(lib.dpsim_decode_error_text(error)), used.value)


def explain(data: bytes, style: str = "line", dpv1: typing.Optional[bool] = None) -> str:
    """The first telegram of `data` as text: "line", "service" (its name only), or "bytes" (a line for each byte). `dpv1` says whether the slave is
    parameterised for DPV1, which decides how a device related diagnosis is read; None: both ways are shown."""
    styles = ("line", "service", "bytes")
    if style not in styles:
        raise ValueError(f"style is {style}, expected {', '.join(styles)}")
    words = ctypes.c_char_p()
    lib.dpsim_telegram_explain(bytes(data), len(data), styles.index(style), -1 if dpv1 is None else int(dpv1), ctypes.byref(words))
    return text(words.value)


@dataclasses.dataclass(frozen=True)
class Heard:
    """A telegram as received by the monitor of a bus or run."""

    start: int  # tick of the falling edge of its first start bit
    end: int  # tick of the end of its last stop bit
    tsdr: typing.Optional[int]  # for an answer: ticks from the end of the request
    data: bytes  # all of it, from the start delimiter on
    station: typing.Optional[int]  # address of the answering station; None: not an answer
    error: str  # "" for a right one
    character_errors: bool
    baud: str

    @property
    def line(self) -> str:
        """As one line of text."""
        return explain(self.data)

    @property
    def service(self) -> str:
        """The name of its service; "" for FDL status and the like."""
        return explain(self.data, "service")


def heard_of(native: typing.Any) -> Heard:
    """Makes a Heard from the library's struct."""
    return Heard(native.start, native.end, None if native.tsdr == NEVER else native.tsdr, as_bytes(native.bytes, native.count),
                 None if native.station == 255 else native.station, text(lib.dpsim_decode_error_text(native.error)),
                 bool(native.character_errors), BAUDS[native.baud])


def native_of(heard: Heard) -> typing.Any:
    """For the library; `heard` must outlive the result."""
    errors = {text(lib.dpsim_decode_error_text(number)): number for number in range(_c.DPSIM_DECODE_TRUNCATED + 1)}
    return _c.dpsim_heard(heard.start, heard.end, NEVER if heard.tsdr is None else heard.tsdr,
                          ctypes.cast(ctypes.c_char_p(heard.data), ctypes.POINTER(ctypes.c_uint8)), len(heard.data),
                          255 if heard.station is None else heard.station, int(heard.character_errors), errors[heard.error], BAUDS.index(heard.baud))


def table(telegrams: typing.Iterable[Heard]) -> typing.Any:
    """Telegrams as a pandas DataFrame (pandas must be installed): start_us, end_us, tsdr_bits, bytes in hex, words."""
    import pandas  # type: ignore[import-untyped,unused-ignore]  # pylint: disable=import-outside-toplevel

    rows = [{"start_us": each.start / US, "end_us": each.end / US, "tsdr_bits": None if each.tsdr is None else each.tsdr / bit_ticks(each.baud),
             "station": each.station, "error": each.error, "service": each.service, "line": each.line, "bytes": each.data.hex(" ").upper()}
            for each in telegrams]
    return pandas.DataFrame(rows)
