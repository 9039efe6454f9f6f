"""The parts of cocotbext.profibus on two wires. Edges are compared with ticks of 1/12 ns, converted once."""
import cocotb
from cocotb.triggers import Edge, RisingEdge
from cocotb.utils import get_sim_time

import dsdpv1
from cocotbext.profibus import Clock, ProfibusMonitor, ProfibusSink, ProfibusSource, Segment, now, steps_of, until
from dsdpv1 import CYCLE, MS, US, Telegram, TelegramKind

STATUS = Telegram(TelegramKind.SD1, da=5, sa=2, fc=0x49)
ANSWER = Telegram(TelegramKind.SD1, da=2, sa=5, fc=0x00)


def nearest_step(tick):
    """In steps of 1 ps: a tick is 1000/12 of them, rounded to whole numbers, a half up."""
    return (2000 * tick + 12) // 24


@cocotb.test()
async def edges_of_the_clock_are_at_their_ticks(dut):
    """250 ticks are 20833.33 ps: after a million of them a clock of 20833 ps would be 333 ns late."""
    clock = Clock(dut.clk_i).start()
    for cycle in [*range(12), *range(1000, 1003), *range(4000, 4003)]:
        await until(cycle * CYCLE - 1)
        await RisingEdge(dut.clk_i)
        assert get_sim_time("step") == nearest_step(cycle * CYCLE), cycle
        assert now() == cycle * CYCLE
    clock.kill()


@cocotb.test()
async def steps_and_ticks_are_each_others_inverse(_dut):
    """Far from tick 0, too, where a floating-point number would be too coarse."""
    for base in (0, 10**9, 10**17):
        for tick in range(base, base + 1000):
            assert steps_of(tick) == nearest_step(tick)


@cocotb.test()
async def characters_arrive_as_they_were_sent(dut):
    """At a fast rate and at the slowest, whose bits are not multiples of each other; with the tick of each start bit."""
    for baud in ("12M", "45.45k"):
        source, sink = ProfibusSource(dut.line_i, baud), ProfibusSink(dut.line_o, baud)
        edges = cocotb.start_soon(edges_of(dut.line_o, source.bit))
        begin = await source.write(bytes([0x00, 0xFF, 0x55, 0x01]), wrong_parity_at=2)
        received = await sink.read(4)
        assert [each.byte for each in received] == [0x00, 0xFF, 0x55, 0x01]
        assert [each.parity_error for each in received] == [False, False, True, False]
        assert [each.start for each in received] == [begin + 11 * index * source.bit for index in range(4)]
        assert sink.empty()
        sink.close()
        edges.kill()


async def edges_of(signal, bit):
    """Every edge is a whole number of bits after the first, to the step nearest to its tick."""
    await Edge(signal)
    first = now()
    while True:
        await Edge(signal)
        assert (now() - first) % bit == 0
        assert get_sim_time("step") == nearest_step(now())


@cocotb.test()
async def the_monitor_hears_right_and_wrong_telegrams(dut):
    """With TSDR, and flags for violations."""
    source, monitor = ProfibusSource(dut.line_i), ProfibusMonitor(dut.line_o)
    begin = await source.write(STATUS)
    heard = await monitor.recv()
    assert (heard.data, heard.start, heard.error) == (STATUS.encode(), begin, "")
    await source.write(ANSWER, idle_bits=15)
    heard = await monitor.recv()
    assert (heard.station, heard.tsdr) == (5, 15 * source.bit)
    await source.write(STATUS, wrong_parity_at=1)
    heard = await monitor.recv()
    assert heard.character_errors
    await source.write(STATUS, idle_bits=20)
    await monitor.recv()
    assert monitor.statistics.flags["T_SYN violated"] == 1, monitor.statistics


@cocotb.test()
async def masters_of_both_classes_share_the_line(dut):
    """Class 2 takes part in the ring; a connection to a missing station ends, with its reason. The line of the DUT is the bus's."""
    segment = Segment(rxd=dut.line_i)
    heard = []
    ProfibusMonitor(dut.line_o, callback=heard.append)
    first, second = segment.add_master(2, ring=1, highest_address=9, gap_factor=1), segment.add_master2(3)
    first.start()
    second.start()
    await until(now() + 10 * MS)
    assert second.ring.stations == (2, 3), second.ring
    connection = second.add_connection(9, send_timeout=1)
    second.connect(connection)
    ends = []
    while not ends:
        await segment.told()
        ends = [each for each in segment.events if each.type == dsdpv1.EventType.CONNECTION_END]
    assert ends[0].outcome == dsdpv1.ConnectionEndCause.NO_ANSWER
    event = await first.ask("fdl_status", 7)
    assert event.outcome == dsdpv1.Outcome.NO_ANSWER
    await until(now() + 100 * US)
    assert [each.data for each in heard] == [each.data for each in segment.telegrams][:len(heard)] and len(heard) > 100
    assert [each.start for each in heard] == [each.start for each in segment.telegrams][:len(heard)]
