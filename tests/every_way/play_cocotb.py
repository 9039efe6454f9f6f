"""Changes of inputs to the model in Icarus, by cocotbext.profibus; each change of an output at its time step. The files are named by INPUTS, OUTPUTS, END."""
import os

import cocotb
import numpy as np
from cocotb.utils import get_sim_time

import dsdpv1
from cocotbext.profibus import ChipPins, PinSource, now, until


@cocotb.test()
async def play(dut):
    pins = ChipPins(dut)
    await pins.power_on()
    with open(os.environ["OUTPUTS"], "w", encoding="ascii") as out:
        outputs = [each.name for each in pins.kind.pins if not each.input]
        # The initial levels are reported after the one step of power_on.
        pins.watch(outputs, lambda _, pin, level: out.write(f"{get_sim_time('step') if now() > 0 else 0} {pin} {level}\n"))
        with open(os.environ["INPUTS"], encoding="ascii") as lines:
            changes = [(int(tick), 0, int(pin), int(level)) for tick, pin, level in map(str.split, lines)]
        await PinSource(pins).play(np.array(changes, dtype=dsdpv1.CHANGE))
        await until(int(os.environ["END"]))
