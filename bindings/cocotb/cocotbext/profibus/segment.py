# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The line in a simulator: the model's masters and monitor, with the DUT as a station."""
import typing

import cocotb
from cocotb.triggers import Event, ReadWrite

import dsdpv1
from dsdpv1 import NEVER, EventType, SlaveState

from ._cocotb import change_of
from .ticks import now, until

REQUESTS = ("ask", "global_control", "set_slave_address", "request", "send_raw", "read", "write", "transport")
_DONE = (EventType.REQUEST_DONE, EventType.ACYCLIC_DONE)


class Segment:
    """A PROFIBUS segment that shares a DUT's line.

        segment = Segment(rxd=dut.pbrxd_i, txd=dut.pbtxd_o, rts=dut.pbrts_o)
        master = segment.add_master(address=2)
        master.add_slave(slave)
        master.start()
        await master.data_exchange(5)
        event = await master.ask("slave_diag", 5)

    Bit times are exact: every edge is at its tick, converted once. Levels driven by DUTs at a tick are on the line before monitor and masters act.
    """

    def __init__(self, rxd: typing.Any = None, txd: typing.Any = None, rts: typing.Any = None, baud: str = "12M", name: str = "dut") -> None:
        """`rxd` receives the line; `txd` drives it while `rts` is high. More DUTs: connect()."""
        self.bus = dsdpv1.Bus(baud)
        self.telegrams: typing.List[dsdpv1.Heard] = []  # all, valid or not
        self.events: typing.List[dsdpv1.Event] = []
        self.listeners: typing.List[typing.Callable[[dsdpv1.Heard], typing.Any]] = [self.telegrams.append]
        self._receivers: typing.List[typing.Any] = []
        self._waiting: typing.Dict[typing.Tuple[typing.Optional[int], int], typing.Any] = {}
        self._told = Event()
        self._planned, self._level = NEVER, 1
        self.bus.watch(line=True, callback=self._line_changed)
        self.bus.on_telegram(self._telegram)
        self.bus.on_event(self._event)
        if rxd is not None:
            self.connect(rxd, txd, rts, name)

    # ---- stations
    def connect(self, rxd: typing.Any, txd: typing.Any, rts: typing.Any, name: typing.Optional[str] = None) -> dsdpv1.Station:
        """Connects another DUT. `txd` None: it only receives."""
        rxd.value = self._level
        self._receivers.append(rxd)
        station = self.bus.add_station(name)
        if txd is not None:
            for signal in (txd, rts):
                cocotb.start_soon(self._drive(station, signal, txd, rts))
        return station

    def add_master(self, address: int = 0, **options: typing.Any) -> "Master1":
        """Adds a master of class 1; options as in dsdpv1.Bus.add_master."""
        return Master1(self, self.bus.add_master(address, **options))

    def add_master2(self, address: int = 0, **options: typing.Any) -> "Master2":
        """Adds a master of class 2."""
        return Master2(self, self.bus.add_master2(address, **options))

    def add_scenario(self, path: typing.Any, settings: typing.Optional[typing.Mapping[str, typing.Any]] = None) -> typing.List["_Master"]:
        """Adds all masters of a scenario, which start and execute the script automatically (dsdpv1.Bus.add_scenario); the ends of the script's
        requests are events with id 0, and bus.left_out lists the ignored parts."""
        masters = self.bus.add_scenario(path, settings)
        self.plan()
        return [(Master1 if isinstance(each, dsdpv1.Master1) else Master2)(self, each) for each in masters]

    # ---- time
    def sync(self) -> None:
        """Runs the bus up to now. Call it before giving commands to the bus, and plan() after."""
        tick = now()
        if tick > self.bus.now:
            self.bus.run(tick)

    def plan(self) -> None:
        """Wakes the bus when it next has something to do."""
        wake = self.bus.next
        if wake < self._planned:
            self._planned = wake
            cocotb.start_soon(self._sleep(wake))

    async def _sleep(self, wake: int) -> None:
        while wake != NEVER and wake == self._planned:  # else an earlier one is planned
            await until(wake)
            await ReadWrite()  # changes of the DUTs at this tick come first
            if wake != self._planned:
                return
            self.sync()
            wake = self._planned = self.bus.next
            if wake <= now():
                wake = self._planned = now() + 1

    # ---- the line
    def _line_changed(self, _tick: int, _station: int, _pin: int, level: int) -> None:
        self._level = level
        for rxd in self._receivers:
            rxd.value = level

    async def _drive(self, station: dsdpv1.Station, signal: typing.Any, txd: typing.Any, rts: typing.Any) -> None:
        edge = change_of(signal)
        while True:
            await edge
            enabled, level = rts.value, txd.value
            if not (enabled.is_resolvable and level.is_resolvable):
                continue  # before the reset
            self.sync()
            station.drive(bool(enabled), int(level), at=now())
            self.plan()

    # ---- events
    def _telegram(self, heard: dsdpv1.Heard) -> None:
        for listener in self.listeners:
            listener(heard)

    def _event(self, event: dsdpv1.Event) -> None:
        self.events.append(event)
        if event.type in _DONE and event.id:
            self._waiting[(event.station, event.id)] = event
        self._told.set()

    async def told(self) -> None:
        """Waits for the next event of masters or monitor."""
        self._told.clear()
        await self._told.wait()

    async def result(self, station: int, request: int) -> dsdpv1.Event:
        """The event that ends a request of the master with this station."""
        while (station, request) not in self._waiting:
            await self.told()
        return typing.cast(dsdpv1.Event, self._waiting.pop((station, request)))

    def heard(self, service: str) -> typing.List[dsdpv1.Heard]:
        """The telegrams so far of one service, for example "Slave_Diag"."""
        return [each for each in self.telegrams if each.service == service]


class _Master:
    """Commands of the model's master, at the simulator's time. Requests are coroutines whose result is the event that ends them."""

    def __init__(self, segment: Segment, master: typing.Any) -> None:
        self._segment, self.model = segment, master

    def _command(self, name: str, *arguments: typing.Any, **options: typing.Any) -> typing.Any:
        self._segment.sync()
        result = getattr(self.model, name)(*arguments, **options)
        self._segment.plan()
        return result

    def __getattr__(self, name: str) -> typing.Any:
        attribute = getattr(self.model, name)
        if not callable(attribute):
            return attribute
        if name in REQUESTS:
            return lambda *arguments, **options: self._segment.result(self.model.station, self._command(name, *arguments, **options))
        return lambda *arguments, **options: self._command(name, *arguments, **options)


class Master1(_Master):
    """dsdpv1.Master1 in a simulator: add_slave, start, set_outputs, slave, ...; await ask, read, write, request, send_raw, ..."""

    async def state(self, address: int, wanted: SlaveState) -> None:
        """Waits until a slave has this state."""
        while self.model.slave(address).state != wanted:
            await self._segment.told()

    async def data_exchange(self, address: int) -> None:
        """Waits until a slave is in data exchange."""
        await self.state(address, SlaveState.DATA_EXCHANGE)


class Master2(_Master):
    """dsdpv1.Master2 in a simulator: add_connection, connect, ...; await read, write, transport."""

    async def state(self, connection: int, wanted: dsdpv1.ConnectionState) -> None:
        """Waits until a connection has this state."""
        while self.model.connection(connection).state != wanted:
            await self._segment.told()
