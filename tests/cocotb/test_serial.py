"""A host at the serial ports of the DSDPV1-RSU, the reference RTL: pins by the lists of its kind, the model beside it, the rules on it."""
import os

import cocotb

import dsdpv1
from cocotbext.profibus import ChipPins, Clock, PinChecker, Scoreboard, ScoreboardError, now, until, wait
from dsdpv1 import CYCLE, NS, US

READ_READY = bytes.fromhex("01000401D8C2")  # B004
REPLY = bytes.fromhex("8100C5BBE1")
SPI, UART, BIT = 1, 2, 26 * CYCLE  # MODE; 1.8432 Mbit/s, UBR 7
BEGIN = 2200 * CYCLE + 7  # of the frame: the start-up access takes 2065 cycles, and then B004 is C5
SCK = 120 * NS


async def power_on(dut, mode, checks="fail"):
    """After the start-up, with the scoreboard and the checks."""
    dut.fault_i.value = int(os.environ["FAULT"])
    pins = ChipPins(dut, kind="dsdpv1_rsu")
    await pins.power_on()
    for strap, level in (("MODE", mode), ("ADR", 1), ("UBR", 7)):
        pins.set(strap, level)
    Clock(dut.clk_i).start()
    scoreboard, checker = Scoreboard(pins, {"ready_cycles": 256}), PinChecker(pins, mode=checks)
    await until(20 * CYCLE)
    pins.set("RESET", 1)
    await until(BEGIN)
    return pins, scoreboard, checker


async def spi(pins, request, count, low=60 * NS):
    """A frame; `count` bytes after the request's, each bit at its level before SCK's rise."""
    pins.set("XSS", 0)
    await wait(100 * NS)
    bits = [byte >> bit & 1 for byte in request for bit in range(7, -1, -1)] + [1] * (8 * count)
    got = 0
    for bit in bits:
        pins.set("MOSI", bit)
        await wait(low)
        got = got << 1 | (pins.level("MISO") == 1)
        pins.set("SCK", 1)
        await wait(60 * NS)
        pins.set("SCK", 0)
    await wait(100 * NS)
    pins.set("XSS", 1)
    await wait(100 * NS)
    assert pins.level("MISO") == dsdpv1.Z
    return (got & (1 << 8 * count) - 1).to_bytes(count, "big")


async def uart(pins, request, count):
    """Characters without a pause, and those of the reply, sampled in the middle of each bit."""
    begin = now()
    for index, level in enumerate(level for byte in request for level in (0, *(byte >> bit & 1 for bit in range(8)), bin(byte).count("1") & 1, 1)):
        await until(begin + index * BIT)
        pins.set("RXD", level)
    while pins.level("TXD"):
        await wait(CYCLE)
    begin, bits = now() + BIT // 2, []
    for index in range(11 * count):
        await until(begin + index * BIT)
        bits.append(pins.level("TXD"))
    characters = [bits[at:at + 11] for at in range(0, len(bits), 11)]
    assert all(each[0] == 0 and each[10] == 1 and sum(each[1:10]) % 2 == 0 for each in characters), characters
    return bytes(sum(bit << at for at, bit in enumerate(each[1:9])) for each in characters)


@cocotb.test()
async def spi_answers_a_read_telegram(dut):
    pins, scoreboard, checker = await power_on(dut, SPI)
    reply = await spi(pins, READ_READY, len(REPLY))
    assert reply == REPLY, reply.hex()
    scoreboard.check()
    checker.finish()
    assert scoreboard.matched == 16, scoreboard.matched
    assert checker.results["TIMING_SCK_HIGH"].count == 8 * (len(READ_READY) + len(REPLY))


@cocotb.test()
async def uart_answers_a_read_telegram(dut):
    pins, scoreboard, checker = await power_on(dut, UART)
    assert await uart(pins, READ_READY, len(REPLY)) == REPLY
    scoreboard.check()
    checker.finish()
    assert scoreboard.matched > 20, scoreboard.matched


@cocotb.test()
async def a_low_sck_that_is_too_short_is_found(dut):
    """SP2: 50 ns."""
    pins, _, checker = await power_on(dut, SPI, checks="report")
    await spi(pins, READ_READY, len(REPLY), low=49 * NS)
    try:
        checker.finish()
    except AssertionError:
        pass
    assert {each.margin for each in checker.violations if each.rule == "TIMING_SCK_LOW"} == {-1 * NS}


@cocotb.test()
async def the_scoreboard_finds_bits_of_miso_in_the_wrong_order(dut):
    """Fault 129: the second bit of C5, the first that differs when the byte is reversed; at the pin spi_miso_delay after SCK's fall."""
    pins, scoreboard, _ = await power_on(dut, SPI)
    await spi(pins, READ_READY, len(REPLY))
    try:
        scoreboard.check()
    except ScoreboardError:
        pass
    difference = scoreboard.difference
    falls = 8 * (len(READ_READY) + 2) + 1
    assert (difference.tick, difference.pin, difference.model, difference.dut) == (BEGIN + 100 * NS + falls * SCK + 10 * NS, "MISO", 1, 0), difference
