# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The reference RTL in cocotb: a master brings it up through its pins, and the model checks each of its outputs.

Environment variables select what is played: FAULT enables a number of rtl_ref/dsdpv1/faults.txt; SCENARIO names a scenario whose pins are
replayed; MASTERS one whose masters are on the line.
"""
import os

import cocotb

import dsdpv1
from cocotbext.profibus import ChipPins, Clock, HostPort, PinChecker, PinSource, Scoreboard, Segment, now, until
from dsdpv1 import US

# Short times, so that a simulation takes seconds: the model gets the same.
QUICK = {"search_window_ms": 1, "ready_cycles": 256}


async def begin(dut, parameters=None):
    """Idle pins, clock, scoreboard."""
    dut.fault_i.value = int(os.environ.get("FAULT", "0"))
    pins = ChipPins(dut)
    await pins.power_on()
    Clock(dut.clk_i).start()
    return pins, Scoreboard(pins, parameters)


async def bring_up(dut, pins):
    """Power-on, initialisation, parameters, configuration, data exchange, both ways."""
    slave = dsdpv1.Slave(address=5, ident=0x0CC9, cfg=b"\x37", input_length=8, output_length=8)
    segment = Segment(dut.pbrxd_i, dut.pbtxd_o, dut.pbrts_o)
    host = HostPort(pins)
    await host.power_on(dsdpv1.Initialisation.of(slave))

    master = segment.add_master(address=2)
    master.add_slave(slave)
    master.set_outputs(5, bytes(range(1, 9)))
    master.start()
    await master.data_exchange(5)
    outputs = None
    while outputs is None:
        await until(now() + 20 * US)
        outputs = await host.exchange(inputs=b"\xCA\xFE" + bytes(6))
    assert outputs == bytes(range(1, 9)), outputs
    answer = await master.ask("read_inputs", 5)
    assert dsdpv1.decode(answer.data).telegram.data[:2] == b"\xCA\xFE", answer


@cocotb.test()
async def a_master_brings_the_chip_up(dut):
    """Every change of every output must match the model, and the host port must keep the rules of the user's side."""
    pins, scoreboard = await begin(dut, QUICK)
    checker = PinChecker(pins)
    await bring_up(dut, pins)
    scoreboard.check()
    checker.finish()
    assert checker.results["TIMING_TS"].count > 0
    dut._log.info(f"data exchange at {now() / US:.3f} us, {scoreboard.matched} changes are the model's")


@cocotb.test()
async def acyclic_requests_are_answered(dut):
    """MSAC_C1 and MSAC_C2, requested automatically by a scenario's masters; the user CPU is a callback."""
    pins, scoreboard = await begin(dut, QUICK)
    slave = dsdpv1.Slave(address=7, ident=0x0CC9, cfg=b"\x31", input_length=2, output_length=2, dpv1=True)
    objects = {(1, 2): b"\x11\x22\x33\x44"}

    def answer(request):
        key = request.slot, request.index
        if key not in objects:
            raise dsdpv1.Refuse(0xB0)
        if request.service != "read":
            objects[key] = request.data
        return objects[key]

    segment = Segment(dut.pbrxd_i, dut.pbtxd_o, dut.pbrts_o)
    segment.add_scenario(os.environ["MASTERS"])
    host = HostPort(pins)
    await host.power_on(dsdpv1.Initialisation.of(slave))
    await host.exchange(bytes(2))
    while not any(each.type == dsdpv1.EventType.CONNECTION_END for each in segment.events):
        await until(now() + 20 * US)
        await host.serve(answer)
    said = [each.text for each in segment.events if each.type == dsdpv1.EventType.ACYCLIC_DONE]
    assert said == ["c1_read: 11 22 33 44", "c1_write: done", "c2_read: AA BB CC", "c2_transport: 01 02 03 04 05"], said
    scoreboard.check()


@cocotb.test()
async def the_pins_of_a_scenario_are_replayed(dut):
    """The inputs of a run of the model; with a fault, the first differing cycle is reported."""
    pins, scoreboard = await begin(dut)
    run = dsdpv1.run(os.environ["SCENARIO"], changes=True)
    end = int(float(os.environ.get("END_US", "100")) * US)
    await PinSource(pins).play(run.changes, end=end)
    await until(end)
    scoreboard.check()
    dut._log.info(f"replayed up to {now() / US:.3f} us, {scoreboard.matched} changes are the model's")
