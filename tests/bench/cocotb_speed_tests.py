"""The simulations of cocotb_speed.py: the reference RTL is brought up by master and host port of the package with the model as scoreboard; and the
same inputs once more from a recording, by cocotb alone. Each writes its CPU seconds."""
import json
import pathlib
import time

import cocotb
from cocotb.triggers import Timer
from cocotb.utils import get_sim_time
from test_rtl import QUICK, begin, bring_up

from cocotbext.profibus import ChipPins, Clock

STIMULUS = pathlib.Path("stimulus.json")


def write(name, value):
    pathlib.Path(f"{name}.json").write_text(json.dumps(value), encoding="utf-8")


@cocotb.test()
async def record(dut):
    """Ports and their values by step."""
    dut.fault_i.setimmediatevalue(0)
    pins, changes = ChipPins(dut), []
    await pins.power_on()
    Clock(dut.clk_i).start()
    names = [each.name for each in pins.kind.pins]
    inputs = [each.name for each in pins.kind.pins if each.input]

    def told(_tick, pin, level):
        changes.append((int(get_sim_time("step")), pins.port(names[pin])._name, max(level, 0)))

    pins.watch(inputs, told)
    await bring_up(dut, pins)
    STIMULUS.write_text(json.dumps({"changes": changes, "end": int(get_sim_time("step"))}), encoding="utf-8")
    write("record", 0)


@cocotb.test()
async def with_the_package(dut):
    start = time.process_time()
    pins, scoreboard = await begin(dut, QUICK)
    await bring_up(dut, pins)
    scoreboard.check()
    write("with_the_package", time.process_time() - start)


@cocotb.test()
async def alone(dut):
    stimulus = json.loads(STIMULUS.read_text(encoding="utf-8"))
    start = time.process_time()
    dut.fault_i.setimmediatevalue(0)
    await ChipPins(dut).power_on()
    Clock(dut.clk_i).start()
    now = int(get_sim_time("step"))
    for step, port, value in stimulus["changes"]:
        if step > now:
            await Timer(step - now, "step")
            now = step
        getattr(dut, port).value = value
    await Timer(stimulus["end"] - now, "step")
    write("alone", time.process_time() - start)
