#!/usr/bin/env python3
"""A large VCD, the same for the same size, as a simulator dumps a chip: a clock, strobes, buses, a bit of everything.

    large_vcd.py FILE MEGABYTES
"""
import random
import sys

SIGNALS = 400   # each a wire, a byte or a word
STEPS = 2000    # of different content; then they begin again


def code(number):
    """Base 94, as most simulators call their signals."""
    text = ""
    while True:
        text += chr(33 + number % 94)
        number //= 94
        if number == 0:
            return text


def main():
    path, size = sys.argv[1], int(sys.argv[2]) * 1_000_000
    chance = random.Random(1)
    widths = [chance.choice((1, 1, 1, 8, 32)) for _ in range(SIGNALS)]

    def change(number):
        if widths[number] == 1:
            return f"{chance.randrange(2)}{code(number)}\n"
        return f"b{chance.randrange(1 << widths[number]):b} {code(number)}\n"

    steps = ["".join(change(number) for number in chance.sample(range(1, SIGNALS), 5)) for _ in range(STEPS)]
    steps = [f"{number % 2}!\n{text}" for number, text in enumerate(steps)]
    with open(path, "w", encoding="ascii") as file:
        file.write("$timescale 1 ps $end\n$scope module chip $end\n")
        file.writelines(f"$var wire {width} {code(number)} s{number} $end\n" for number, width in enumerate(widths))
        file.write("$upscope $end\n$enddefinitions $end\n#0\n$dumpvars\n")
        file.writelines(f"{'0' if width == 1 else 'b0 '}{code(number)}\n" for number, width in enumerate(widths))
        file.write("$end\n")
        time = 0
        while file.tell() < size:
            block = []
            for text in steps:
                time += 10417
                block.append(f"#{time}\n{text}")
            file.write("".join(block))


main()
