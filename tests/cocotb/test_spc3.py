"""The pins of the SPC3 family: names of ports, power-on, and the scoreboard on a chip that never changes an output."""
import cocotb

import dsdpv1
from cocotbext.profibus import ChipPins, Scoreboard, until
from dsdpv1 import CYCLE, NS, US

READ = [("AB", 0x016, 0), ("XCS", 0, 0), ("XRD_R_W", 0, 0), ("XRD_R_W", 1, 300 * NS), ("XCS", 1, 300 * NS)]  # pin, level, ticks after the begin


@cocotb.test()
async def the_scoreboard_names_the_first_output_that_does_not_move(dut):
    pins = ChipPins(dut, kind="apc3")
    await pins.power_on()
    scoreboard = Scoreboard(pins, fails=False)
    model = dsdpv1.Chip("apc3")
    model.watch(["XREADY_XDTACK"])
    await until(1 * US)
    assert (dut.reset_i.value, pins.level("RESET"), pins.level("DB_OUT")) == (1, 1, dsdpv1.Z)
    assert (pins.level("XCS"), pins.level("XTEST0"), pins.level("XINT_MOT"), pins.level("RXD")) == (1, 1, 0, 1)
    begin = 20 * US + 77
    for pin, level, tick in [("RESET", 0, 10 * US), *((pin, level, begin + after) for pin, level, after in READ)]:
        await until(tick)
        pins.set(pin, level)
        model.set(pin, level, at=tick)
    await until(40 * US)
    model.advance(40 * US)
    scoreboard.check()
    difference = scoreboard.difference
    assert (difference.pin, difference.model, difference.dut) == ("XREADY_XDTACK", 0, 1), difference
    assert difference.tick == model.changes()["tick"][0]
    assert difference.tick % CYCLE == 0 and begin < difference.tick < begin + 10 * CYCLE


@cocotb.test()
async def each_name_of_the_family_has_these_pins(dut):
    apc3 = ChipPins(dut, kind="apc3")
    spc3 = ChipPins(dut, kind="spc3")
    assert spc3.kind.pins == apc3.kind.pins and spc3.enables == {"DB_OUT": "DB_OE"}
    try:
        ChipPins(dut, kind="dsdpv1")
    except AttributeError as error:
        assert "has no port r_req_i for the pin R_REQ" in str(error), error
    else:
        assert False, "pins of another chip were found"
    try:
        ChipPins(dut, kind="vpc3")
    except AttributeError as error:
        assert "has no port ab11_i for the pin AB11" in str(error), error
    else:
        assert False, "a VPC3+ has the pins of SPI, too"
