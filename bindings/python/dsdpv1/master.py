# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Masters of class 1 and 2. Their commands may be given in callbacks; they take effect between two requests, at the present tick at the earliest.
Bus.on_event reports their outcome."""
import ctypes
import dataclasses
import typing

from . import _c
from ._library import Handle, as_bytes, filled, lib, number, sized, text
from .events import ConnectionState, RingState, SlaveState
from .gsd import Slave
from .telegram import BROADCAST, Telegram
from .units import baud_index

PERSONALITIES = ("high_always", "classic")
SERVICES = {"fdl_status": _c.DPSIM_SERVICE_FDL_STATUS, "read_inputs": _c.DPSIM_SERVICE_READ_INPUTS, "read_outputs": _c.DPSIM_SERVICE_READ_OUTPUTS,
            "get_cfg": _c.DPSIM_SERVICE_GET_CFG, "slave_diag": _c.DPSIM_SERVICE_SLAVE_DIAG}


@dataclasses.dataclass(frozen=True)
class SlaveStatus:
    """A slave's status in its master."""

    state: SlaveState
    reason: str  # why the last bring-up failed or data exchange ended
    inputs: bytes  # of the last data exchange
    outputs: bytes
    diagnosis: bytes  # data of the last answer to Slave_Diag
    data_exchanges: int
    diagnoses: int
    parameterisations: int
    retries: int
    timeouts: int
    errors: int  # wrong answers
    refusals: int  # UE, RR, RS


@dataclasses.dataclass(frozen=True)
class MasterStatus:
    """Status of a master of class 1."""

    running: bool
    clear: bool
    cycles: int
    cycle_time: int  # ticks of the last one


@dataclasses.dataclass(frozen=True)
class RingStatus:
    """Status of a master that shares the token. Rotations (T_RR) in ticks."""

    state: RingState
    stations: typing.Tuple[int, ...]  # LAS, the list of active stations
    rotations: int
    rotation_min: int
    rotation_max: int
    rotation_mean: int
    token_retries: int
    stations_dropped: int
    stations_found: int
    claims: int
    tokens_given_up: int


@dataclasses.dataclass(frozen=True)
class ConnectionStatus:
    """Status of a connection of class 2."""

    state: ConnectionState
    sap: typing.Optional[int]  # of the channel
    send_timeout: int  # granted, unit 10 ms
    max_length: int  # Max_Len_Data_Unit
    open_requests: int


@dataclasses.dataclass(frozen=True)
class WireFaults:
    """Faults to inject into raw bytes on the wire; positions count bytes from 0, None: no fault."""

    wrong_parity_at: typing.Optional[int] = None
    missing_stop_at: typing.Optional[int] = None
    gap: typing.Optional[typing.Tuple[int, int]] = None  # idle before this byte, 1/1000 bit times
    truncate: typing.Optional[typing.Tuple[int, int]] = None  # so many whole characters are sent, and so many bits of the next one
    glitch: typing.Optional[typing.Tuple[int, int, int]] = None  # in this character, from so many 1/1000 bit times on, how long

    def _native(self) -> typing.Any:
        made, none2, none3 = sized(_c.dpsim_wire_faults), (0, 0), (0, 0, 0)
        made.wrong_parity_at, made.missing_stop_at = self.wrong_parity_at or 0, self.missing_stop_at or 0
        made.gap_before, made.gap_millibits = self.gap or none2
        made.truncate_after, made.truncate_bits = self.truncate or none2
        made.glitch_at, made.glitch_start_millibits, made.glitch_length_millibits = self.glitch or none3
        chosen = ((self.wrong_parity_at, _c.DPSIM_FAULT_PARITY), (self.missing_stop_at, _c.DPSIM_FAULT_STOP), (self.gap, _c.DPSIM_FAULT_GAP),
                  (self.truncate, _c.DPSIM_FAULT_TRUNCATE), (self.glitch, _c.DPSIM_FAULT_GLITCH))
        made.which = sum(flag for value, flag in chosen if value is not None)
        return ctypes.byref(made)


def _id(function: typing.Any, *arguments: typing.Any) -> int:
    return int(number(lambda into: function(*arguments, into), ctypes.c_uint32))


class Master(Handle):
    """Shared by both classes. A request returns its id, which Event.id repeats at its end."""

    def __init__(self, handle: int) -> None:
        super().__init__(handle, None)

    @property
    def station(self) -> int:
        """Its number on the bus."""
        return int(number(lambda into: lib.dpsim_master_station(self, into), ctypes.c_uint16))

    def start(self) -> None:
        """Class 1: listens for T_TO, claims the token and brings its slaves up. Class 2: joins the ring."""
        lib.dpsim_master_start(self)

    def stop(self) -> None:
        """Stops the master at once, even inside a telegram, as if it had died."""
        lib.dpsim_master_stop(self)

    def set_baud(self, baud: str) -> None:
        """Sends all later telegrams at another rate of BAUDS; slaves keep their states."""
        lib.dpsim_master_set_baud(self, baud_index(baud))

    @property
    def ring(self) -> RingStatus:
        """StateError: a single master."""
        got = filled(lambda into: lib.dpsim_master_get_ring(self, into), _c.dpsim_ring_status)
        stations = tuple(a for a in range(128) if got.stations[a // 8] >> a % 8 & 1)
        return RingStatus(RingState(got.state), stations, got.rotations, got.rotation_min, got.rotation_max, got.rotation_mean, got.token_retries,
                          got.stations_dropped, got.stations_found, got.claims, got.tokens_given_up)

    def read(self, peer: int, slot: int, index: int, count: int = 240) -> int:
        """DS_Read of up to `count` bytes. `peer`: class 1 the slave's address, class 2 the connection's number."""
        return _id(lib.dpsim_master_read, self, peer, slot, index, count)

    def write(self, peer: int, slot: int, index: int, data: bytes) -> int:
        """DS_Write of at most 240 bytes."""
        return _id(lib.dpsim_master_write, self, peer, slot, index, bytes(data), len(data))


class Master1(Master):
    """A master of class 1 (Bus.add_master)."""

    def add_slave(self, slave: Slave) -> None:
        """Before the start or in operation. ArgumentError: a value out of range, or an address already in use."""
        lib.dpsim_master_add_slave(self, ctypes.byref(slave._native()))  # pylint: disable=protected-access

    def set_clear(self, clear: bool) -> None:
        """Clear, or Operate, the initial mode."""
        lib.dpsim_master_set_clear(self, int(clear))

    def set_outputs(self, address: int, data: bytes) -> None:
        """Exactly output_length bytes of the slave; sent from the next exchange on."""
        lib.dpsim_master_set_outputs(self, address, bytes(data), len(data))

    def release(self, address: int) -> None:
        """Sends Set_Prm with Unlock and then ignores the slave until activate()."""
        lib.dpsim_master_release(self, address)

    def activate(self, address: int) -> None:
        """Brings it up again."""
        lib.dpsim_master_activate(self, address)

    def slave(self, address: int) -> SlaveStatus:
        """NotFoundError: the master has none with this address."""
        got = filled(lambda into: lib.dpsim_master_get_slave(self, address, into), _c.dpsim_slave_status)
        return SlaveStatus(SlaveState(got.state), text(got.reason), as_bytes(got.inputs, got.input_count), as_bytes(got.outputs, got.output_count),
                           as_bytes(got.diagnosis, got.diagnosis_count), got.data_exchanges, got.diagnoses, got.parameterisations, got.retries,
                           got.timeouts, got.errors, got.refusals)

    @property
    def status(self) -> MasterStatus:
        """Status of the whole master."""
        got = filled(lambda into: lib.dpsim_master_get_status(self, into), _c.dpsim_master_status)
        return MasterStatus(bool(got.running), bool(got.clear), got.cycles, got.cycle_time)

    # ---- acyclic requests, in the order of the calls
    def ask(self, service: str, address: int) -> int:
        """A service without data: one of SERVICES."""
        if service not in SERVICES:
            raise ValueError(f"service is {service}, expected {', '.join(SERVICES)}")
        return _id(lib.dpsim_master_ask, self, SERVICES[service], address)

    def global_control(self, group: int = 0, address: int = BROADCAST, *, clear: bool = False, freeze: typing.Optional[bool] = None,
                       sync: typing.Optional[bool] = None) -> int:
        """Freeze and Sync (True), Unfreeze and Unsync (False), Clear_Data, to the groups whose bits are set (0: all)."""
        command = _c.DPSIM_CONTROL_CLEAR_DATA if clear else 0
        command |= {None: 0, True: _c.DPSIM_CONTROL_FREEZE, False: _c.DPSIM_CONTROL_UNFREEZE}[freeze]
        command |= {None: 0, True: _c.DPSIM_CONTROL_SYNC, False: _c.DPSIM_CONTROL_UNSYNC}[sync]
        return _id(lib.dpsim_master_global_control, self, command, group, address)

    def set_slave_address(self, address: int, new_address: int, ident: int, lock: bool = False) -> int:
        """Set_Slave_Add; `lock`: forbids later changes."""
        return _id(lib.dpsim_master_set_slave_address, self, address, new_address, ident, int(lock))

    def request(self, telegram: Telegram) -> int:
        """Any request; FC holds bit 6 and the function, FCB and FCV are added. The master uses its own address as `sa`."""
        return _id(lib.dpsim_master_request, self, ctypes.byref(telegram._native()))  # pylint: disable=protected-access

    def send_raw(self, data: bytes, faults: typing.Optional[WireFaults] = None, wants_answer: bool = False) -> int:
        """Sends any bytes once, without repetition, with `faults`."""
        native = None if faults is None else faults._native()  # pylint: disable=protected-access
        return _id(lib.dpsim_master_send_raw, self, bytes(data), len(data), native, int(wants_answer))


class Master2(Master):
    """A master of class 2 (Bus.add_master2)."""

    def add_connection(self, slave: int, add_addr: bytes = b"", **members: typing.Any) -> int:
        """Adds a connection, closed, and returns its number. `members` are those of dpsim_connection_options: send_timeout and response_timeout
        (unit 10 ms), poll_interval_us, profile_ident, features and profile_features (two bytes each)."""
        options = sized(_c.dpsim_connection_options, slave=slave, add_addr_size=len(add_addr))
        options.add_addr[:len(add_addr)] = add_addr
        known = {name for name, *_ in _c.dpsim_connection_options._fields_} - {"size", "slave", "add_addr", "add_addr_size"}
        for key, value in members.items():
            if key not in known:
                raise TypeError(f"a connection has no {key}, it has {', '.join(sorted(known))}")
            setattr(options, key, (ctypes.c_uint8 * 2)(*value) if isinstance(value, (bytes, tuple)) else value)
        return _id(lib.dpsim_master_add_connection, self, ctypes.byref(options))

    def connect(self, connection: int) -> None:
        """Initiate; does nothing unless it is closed."""
        lib.dpsim_master_connect(self, connection)

    def abort(self, connection: int, reason: int = 0) -> None:
        """Aborts the connection with `reason` 0 to 15 of instance user; 0: an ordinary end."""
        lib.dpsim_master_abort(self, connection, reason)

    def connection(self, connection: int) -> ConnectionStatus:
        """NotFoundError: unknown connection."""
        got = filled(lambda into: lib.dpsim_master_get_connection(self, connection, into), _c.dpsim_connection_status)
        return ConnectionStatus(ConnectionState(got.state), None if got.sap < 0 else got.sap, got.send_timeout, got.max_length, got.open_requests)

    def transport(self, connection: int, slot: int, index: int, data: bytes) -> int:
        """DS_Transport."""
        return _id(lib.dpsim_master_transport, self, connection, slot, index, bytes(data), len(data))
