"""Host port, names of ports and checks of cocotbext.profibus on a chip that answers nothing."""
import re

import cocotb

import dsdpv1
from cocotbext.profibus import ChipPins, HostPort, PinChecker, Scoreboard, now, until, wait
from dsdpv1 import CYCLE, NS, US, AccessTiming
from dsdpv1.user import Read, Write, hold

NAMES = {"RESET": "~rst", "R_REQ": "user_req", "R_STA": "user_sta", "CSR": "cs_n", "RD": "rd_n", "WR": "wr_n", "A": "addr", "D_IN": "data_in",
         "D_OUT": "data_out", "D_OE": "~data_en_n", "PBRXD": "rx", "L_REQ": "~chip_req_n", "L_STA": "~chip_sta_n", "INTR0": "irq_n", "PBTXD": "tx",
         "PBRTS": "rts", "PBF": "pbf", "BR": "br", "READY": "ready"}


async def powered(dut):
    pins = ChipPins(dut, NAMES)
    await pins.power_on()
    await until(now() + 1 * US)
    return pins


@cocotb.test()
async def a_scoreboard_that_does_not_fail_says_where_they_differ(dut):
    """The model's first access begins access_interval cycles and some after its reset: this chip has none. Comes first, as it begins at tick 0."""
    pins = ChipPins(dut, NAMES)
    await pins.power_on()
    scoreboard, patient = Scoreboard(pins, fails=False), Scoreboard(pins, fails=False, tolerance=100 * US)
    model = dsdpv1.Chip()
    model.watch(["L_REQ"])
    await until(20 * CYCLE)
    pins.set("RESET", 1)
    model.set("RESET", 1, at=20 * CYCLE)
    model.advance(100 * US)
    await until(100 * US)
    scoreboard.check()
    patient.check()
    assert patient.difference is None, patient.difference
    difference = scoreboard.difference
    assert (difference.pin, difference.model, difference.dut) == ("L_REQ", 1, 0), difference
    assert difference.tick == model.changes()["tick"][0]
    assert f"cycle {difference.cycle} (" in str(difference)


@cocotb.test()
async def ports_of_other_names_and_polarities_are_the_pins(dut):
    try:
        ChipPins(dut)
    except AttributeError as error:
        assert "no port reset_i for the pin RESET" in str(error)
    else:
        assert False, "a missing port was not noticed"
    pins = await powered(dut)
    assert (dut.rst.value, pins.level("RESET")) == (1, 0)
    pins.set("RESET", 1)
    await wait(1)
    assert (dut.rst.value, pins.level("RESET")) == (0, 1)
    assert (pins.level("L_REQ"), pins.level("D_OUT")) == (0, dsdpv1.Z)
    pins.set("A", 0x5A)
    pins.set("CSR", 0)
    pins.set("RD", 0)
    await wait(1)
    assert pins.level("D_OUT") == 0x5A


def twice_in_a_hold():
    """A read, so that it is a program with an answer, and a write."""
    value = yield Read(0x25)
    yield Write(0x131, value)
    return value


async def margin(dut, ticks):
    """Violations of Ts when the write strobe is so long, and the worst margin."""
    pins = await powered(dut)
    checker = PinChecker(pins, mode="report")
    pins.set("RESET", 1)
    await wait(10 * US)
    host = HostPort(pins, AccessTiming(wr_low=ticks))
    before = now()
    assert await host.run(hold(twice_in_a_hold())) == 0x25
    assert now() - before > 100 * NS
    try:
        checker.finish()
    except AssertionError as error:
        assert re.match(r"\d+ violations?, the first \w+ at ", str(error)), error
    return [each.margin for each in checker.violations if each.rule == "TIMING_TS"], checker.results["TIMING_TS"].worst_margin


@cocotb.test()
async def a_strobe_that_is_a_tick_too_short_is_found(dut):
    """Table 15: Ts >= 12.5 ns, 150 ticks; at a precision of 1 ps a tick, 83 ps, is seen."""
    assert await margin(dut, 150) == ([], 0)
    short, worst = await margin(dut, 149)
    assert set(short) == {-1} and worst == -1, short


@cocotb.test(expect_error=AssertionError)
async def a_violation_fails_the_test_at_once(dut):
    pins = await powered(dut)
    PinChecker(pins)
    pins.set("RESET", 1)
    await wait(10 * US)
    await HostPort(pins, AccessTiming(wr_low=149)).run(hold(twice_in_a_hold()))
    await wait(1 * US)
    raise RuntimeError("it went on")


@cocotb.test()
async def a_checker_that_judged_nothing_fails_the_test(dut):
    checker = PinChecker(await powered(dut))
    try:
        checker.finish()
    except AssertionError as error:
        assert str(error) == "nothing was judged: nobody used the host port"
    else:
        raise RuntimeError("it passed")
