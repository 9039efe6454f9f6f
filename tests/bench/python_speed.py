#!/usr/bin/env python3
"""Millions of changes of all pins per second that reach numpy arrays: the chip of the row core_16, with the edges of its requests passed in one
call per millisecond. Prints ROW<TAB>VALUE."""
import sys
import time

import numpy as np

import dsdpv1
from dsdpv1 import CYCLE, US, Telegram, TelegramKind

BIT = dsdpv1.bit_ticks("12M")
IO = 16
CFG = bytes([0x3F])  # 16 bytes each way
EXCHANGES = 200  # a turn
TURNS = 40
PAUSE = (12 + 11 * (IO + 9) + 33) * BIT  # TSDR, the answer, T_SYN


def edges(telegram, start):
    """Changes of PBRXD, and the tick of the end."""
    bits = [bit for byte in telegram.encode() for bit in (0, *(byte >> i & 1 for i in range(8)), bin(byte).count("1") & 1, 1)]
    pin, level, found = dsdpv1.kind_of().pin("PBRXD").number, 1, []
    for index, bit in enumerate(bits):
        if bit != level:
            found.append((start + index * BIT, 0, pin, bit))
        level = bit
    return found, start + len(bits) * BIT


def in_data_exchange():
    """A chip, brought up."""
    chip = dsdpv1.Chip()
    user = dsdpv1.User(chip)
    user.wait(20 * CYCLE)
    user.power_on(dsdpv1.Initialisation(5, 0x0CC9, CFG, IO, IO))
    parameters = bytes([0x80, 0, 0, 11, 0x0C, 0xC9, 0])
    for request in (Telegram(TelegramKind.SD1, 100, 2, 0x49), Telegram(TelegramKind.SD2, 5, 2, 0x6D, parameters, 61, 62),
                    Telegram(TelegramKind.SD2, 5, 2, 0x5D, CFG, 62, 62)):
        changes, end = edges(request, chip.now + 50 * US)
        chip.set_many(changes)
        chip.advance(end + 100 * US)
    return chip


def turn_of_requests():
    """The edges of EXCHANGES exchanges from tick 0 on, and how long that is."""
    found, now = [], 0
    for index in range(EXCHANGES):
        fc = 0x5D if index % 2 else 0x7D
        changes, end = edges(Telegram(TelegramKind.SD2, 5, 2, fc, bytes([0x5A] * IO)), now)
        found += changes
        now = end + PAUSE
    return np.array(found, dsdpv1.CHANGE), now


def rate():
    chip, (requests, duration) = in_data_exchange(), turn_of_requests()
    before, count, start = chip.status.data_exchanges, 0, time.process_time()
    chip.watch()
    for _ in range(TURNS):
        stimulus = requests.copy()
        stimulus["tick"] += np.uint64(chip.now)
        begin = chip.now
        chip.set_many(stimulus)
        chip.advance(begin + duration)
        count += len(chip.changes())
    taken = time.process_time() - start
    if chip.status.data_exchanges - before != TURNS * EXCHANGES:
        sys.exit("exchanges were lost")
    return count / taken / 1e6


if __name__ == "__main__":
    print(f"python\t{rate()}")
