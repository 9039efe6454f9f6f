# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""Events of a bus's masters and monitor."""
import dataclasses
import enum
import typing

from . import _c
from ._library import as_bytes, text
from .units import LINE


class SlaveState(enum.IntEnum):
    """The state of a slave in its class-1 master."""

    OFFLINE = _c.DPSIM_SLAVE_OFFLINE
    DIAGNOSE = _c.DPSIM_SLAVE_DIAGNOSE
    CLEAR = _c.DPSIM_SLAVE_CLEAR
    SET_PRM = _c.DPSIM_SLAVE_SET_PRM
    CHK_CFG = _c.DPSIM_SLAVE_CHK_CFG
    AWAIT_READY = _c.DPSIM_SLAVE_AWAIT_READY
    DATA_EXCHANGE = _c.DPSIM_SLAVE_DATA_EXCHANGE
    RELEASING = _c.DPSIM_SLAVE_RELEASING
    RELEASED = _c.DPSIM_SLAVE_RELEASED


class RingState(enum.IntEnum):
    """The state of a master in the token ring."""

    OFF = _c.DPSIM_RING_OFF
    LISTEN_TOKEN = _c.DPSIM_RING_LISTEN_TOKEN
    CLAIM_TOKEN = _c.DPSIM_RING_CLAIM_TOKEN
    ACTIVE_IDLE = _c.DPSIM_RING_ACTIVE_IDLE
    USE_TOKEN = _c.DPSIM_RING_USE_TOKEN
    GAP_POLL = _c.DPSIM_RING_GAP_POLL
    PASS_TOKEN = _c.DPSIM_RING_PASS_TOKEN
    OUT = _c.DPSIM_RING_OUT


class ConnectionState(enum.IntEnum):
    """The state of a connection of a class-2 master."""

    CLOSED = _c.DPSIM_CONNECTION_CLOSED
    INITIATING = _c.DPSIM_CONNECTION_INITIATING
    CONNECTING = _c.DPSIM_CONNECTION_CONNECTING
    OPEN = _c.DPSIM_CONNECTION_OPEN
    BUSY = _c.DPSIM_CONNECTION_BUSY
    ABORTING = _c.DPSIM_CONNECTION_ABORTING


class ConnectionEndCause(enum.IntEnum):
    """Why a connection ended."""

    SLAVE_ABORT = _c.DPSIM_END_SLAVE_ABORT
    MASTER = _c.DPSIM_END_MASTER
    REFUSED = _c.DPSIM_END_REFUSED
    NO_CHANNEL = _c.DPSIM_END_NO_CHANNEL
    NO_ANSWER = _c.DPSIM_END_NO_ANSWER
    STOPPED = _c.DPSIM_END_STOPPED


class Outcome(enum.IntEnum):
    """The outcome of an acyclic request."""

    SENT = _c.DPSIM_OUTCOME_SENT
    ANSWERED = _c.DPSIM_OUTCOME_ANSWERED
    NO_ANSWER = _c.DPSIM_OUTCOME_NO_ANSWER
    BAD_ANSWER = _c.DPSIM_OUTCOME_BAD_ANSWER
    ABORTED = _c.DPSIM_OUTCOME_ABORTED


class AcyclicOutcome(enum.IntEnum):
    """The outcome of an acyclic service."""

    POSITIVE = _c.DPSIM_ACYCLIC_POSITIVE
    NEGATIVE = _c.DPSIM_ACYCLIC_NEGATIVE
    TIMEOUT = _c.DPSIM_ACYCLIC_TIMEOUT
    REFUSED = _c.DPSIM_ACYCLIC_REFUSED
    NO_ANSWER = _c.DPSIM_ACYCLIC_NO_ANSWER
    WRONG_ANSWER = _c.DPSIM_ACYCLIC_WRONG_ANSWER
    LOST = _c.DPSIM_ACYCLIC_LOST


class EventType(enum.IntEnum):
    """The subject of an Event."""

    FLAG = _c.DPSIM_EVENT_FLAG  # the monitor: text
    SLAVE_STATE = _c.DPSIM_EVENT_SLAVE_STATE
    INPUTS = _c.DPSIM_EVENT_INPUTS
    DIAGNOSIS = _c.DPSIM_EVENT_DIAGNOSIS
    REQUEST_DONE = _c.DPSIM_EVENT_REQUEST_DONE
    ACYCLIC_DONE = _c.DPSIM_EVENT_ACYCLIC_DONE
    CONNECTION_STATE = _c.DPSIM_EVENT_CONNECTION_STATE
    CONNECTION_END = _c.DPSIM_EVENT_CONNECTION_END
    RING_STATE = _c.DPSIM_EVENT_RING_STATE


_STATES: typing.Dict[int, typing.Type[enum.IntEnum]] = {EventType.SLAVE_STATE: SlaveState, EventType.CONNECTION_STATE: ConnectionState,
                                                       EventType.RING_STATE: RingState}
_OUTCOMES: typing.Dict[int, typing.Type[enum.IntEnum]] = {EventType.REQUEST_DONE: Outcome, EventType.ACYCLIC_DONE: AcyclicOutcome,
                                                         EventType.CONNECTION_END: ConnectionEndCause}


@dataclasses.dataclass(frozen=True)
class Event:
    """One event. `before` and `after` are states, `outcome` is of the enum for the type; None if a type has none."""

    tick: int
    type: EventType
    id: int  # of the request, of the connection, of the flag
    station: typing.Optional[int]  # of the master; None: the monitor
    address: typing.Optional[int]  # of the slave
    before: typing.Optional[enum.IntEnum]
    after: typing.Optional[enum.IntEnum]
    outcome: typing.Optional[enum.IntEnum]
    codes: typing.Tuple[int, int, int]  # Error_Decode, Error_Code_1, Error_Code_2 (tables 28, 29)
    data: bytes
    text: str


def event_of(native: typing.Any) -> Event:
    """Makes an event from the library's struct."""
    state, outcome = _STATES.get(native.type), _OUTCOMES.get(native.type)
    before, after = (None, None) if state is None else (state(getattr(native, "from")), state(native.to))
    return Event(native.tick, EventType(native.type), native.id, None if native.station == LINE else native.station,
                 None if native.address == 255 else native.address, before, after, None if outcome is None else outcome(native.outcome),
                 (native.codes >> 16 & 0xFF, native.codes >> 8 & 0xFF, native.codes & 0xFF), as_bytes(native.data, native.data_size), text(native.text))
