# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""GSD files, and what a master has to know about a slave."""
import ctypes
import dataclasses
import json
import os
import typing

from . import _c
from ._library import Handle, encoded, filled, lib, number, sized, text
from .units import BAUDS


@dataclasses.dataclass(frozen=True)
class Slave:
    """One slave, with the data that a class-1 master needs (table 19). Gsd.slave() makes one; dataclasses.replace() changes it."""

    address: int  # 0 to 126
    ident: int  # Ident_Number
    cfg: bytes  # data of Chk_Cfg, 1 to 244 bytes
    input_length: int = 0  # bytes that the slave sends, 0 to 244
    output_length: int = 0  # bytes that it gets, 0 to 244
    user_prm: bytes = b""  # Set_Prm after its first 7 bytes, 0 to 237 bytes
    group_ident: int = 0  # bit n: member of group n + 1
    watchdog: typing.Tuple[int, int] = (0, 0)  # WD_Fact_1, WD_Fact_2: their product x WD_Base; 0 switches it off
    min_tsdr: int = 0  # bit times, 0: 11
    sync: bool = False
    freeze: bool = False
    fail_safe: bool = False  # empty outputs instead of zeros in Clear
    dpv1: bool = False  # acyclic services of class 1
    wd_base_1ms: bool = False  # instead of 10 ms
    lock: bool = True  # Lock_Req
    c1_response_timeout: int = 0  # unit 10 ms; 0: 100
    min_slave_interval_us: int = 0  # polled no more often than this

    def _flags(self) -> int:
        chosen = ((self.sync, _c.DPSIM_PRM_SYNC), (self.freeze, _c.DPSIM_PRM_FREEZE), (self.fail_safe, _c.DPSIM_PRM_FAIL_SAFE),
                  (self.dpv1, _c.DPSIM_PRM_DPV1), (self.wd_base_1ms, _c.DPSIM_PRM_WD_1MS), (not self.lock, _c.DPSIM_PRM_NO_LOCK))
        return sum(flag for wanted, flag in chosen if wanted)

    def _native(self) -> typing.Any:
        made = sized(_c.dpsim_slave, ident=self.ident, address=self.address, group_ident=self.group_ident, flags=self._flags(),
                     wd_fact_1=self.watchdog[0], wd_fact_2=self.watchdog[1], min_tsdr=self.min_tsdr, input_length=self.input_length,
                     output_length=self.output_length, user_prm_size=len(self.user_prm), cfg_size=len(self.cfg),
                     c1_response_timeout=self.c1_response_timeout, min_slave_interval_us=self.min_slave_interval_us)
        for name, value, limit in (("user_prm", self.user_prm, _c.DPSIM_MAX_USER_PRM), ("cfg", self.cfg, _c.DPSIM_MAX_CFG)):
            if len(value) > limit:
                raise ValueError(f"{name} has {len(value)} bytes, expected 0 to {limit}")
            getattr(made, name)[:len(value)] = value
        return made


@dataclasses.dataclass(frozen=True)
class GsdInfo:
    """A GSD file's data about its device."""

    vendor: str
    model: str
    ident: int
    revision: int  # GSD_Revision
    dpv1: bool  # DPV1_Slave
    bauds: typing.Tuple[str, ...]
    modules: typing.Tuple[str, ...]


def _chosen(modules: typing.Sequence[str]) -> typing.Any:
    return (ctypes.c_char_p * max(1, len(modules)))(*(encoded(each) for each in modules)), len(modules)


class Gsd(Handle):
    """A GSD file of revision 1 to 5. InputError has all errors as "file:line: ...", one per line."""

    def __init__(self, path: "str | os.PathLike[str]") -> None:
        super().__init__(number(lambda into: lib.dpsim_gsd_load(encoded(os.fspath(path)), into), ctypes.c_void_p), lib.dpsim_gsd_destroy)

    @classmethod
    def parse(cls, source: str, name: str = "gsd") -> "Gsd":
        """From text; `name` replaces the file name in messages."""
        self, raw = cls.__new__(cls), source.encode("utf-8")
        Handle.__init__(self, number(lambda into: lib.dpsim_gsd_parse(raw, len(raw), encoded(name), into), ctypes.c_void_p), lib.dpsim_gsd_destroy)
        return self

    @property
    def warnings(self) -> typing.List[str]:
        """Warnings about a usable file, in the order of its lines."""
        return text(number(lambda into: lib.dpsim_gsd_warnings(self, into), ctypes.c_char_p)).splitlines()

    @property
    def info(self) -> GsdInfo:
        """Vendor, model, rates, modules."""
        got = filled(lambda into: lib.dpsim_gsd_get_info(self, into), _c.dpsim_gsd_info)
        modules = tuple(text(number(lambda into, i=i: lib.dpsim_gsd_module(self, i, into), ctypes.c_char_p)) for i in range(got.modules))
        bauds = tuple(name for index, name in enumerate(BAUDS) if got.bauds >> index & 1)
        return GsdInfo(text(got.vendor), text(got.model), got.ident, got.revision, bool(got.dpv1), bauds, modules)

    def slave(self, address: int, modules: typing.Sequence[str] = (), dpv1: bool = False, **members: typing.Any) -> Slave:
        """Derives a master's data from the file and these modules (names, or numbers as text, in the order of their slots; none: those that the
        file presets). `members` are those of Slave that the file does not define: watchdog, sync. InputError: no such module, a limit exceeded, no
        DPV1."""
        names, count = _chosen(modules)
        got = filled(lambda into: lib.dpsim_gsd_slave(self, names, count, _c.DPSIM_PRM_DPV1 if dpv1 else 0, into), _c.dpsim_slave)
        return Slave(address, got.ident, bytes(got.cfg[:got.cfg_size]), got.input_length, got.output_length, bytes(got.user_prm[:got.user_prm_size]),
                     dpv1=dpv1, c1_response_timeout=got.c1_response_timeout, min_slave_interval_us=got.min_slave_interval_us, **members)

    def report(self, modules: typing.Sequence[str] = ()) -> typing.Dict[str, typing.Any]:
        """The report of `dsdpv1-sim gsd` for these modules."""
        names, count = _chosen(modules)
        return typing.cast(typing.Dict[str, typing.Any],
                           json.loads(number(lambda into: lib.dpsim_gsd_report(self, names, count, 1, into), ctypes.c_char_p)))
