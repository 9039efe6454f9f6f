"""Scenarios of the speed table that are not in scenarios/: as JSON, which is YAML."""
import json

import programs

IDENT = 0x0CC9
IDLE = 8  # slaves that are never addressed, beside the busy one


def identifiers(io):
    """Configuration for as many inputs as outputs, at most 16 of each in one byte."""
    return [0x30 | (min(16, io - done) - 1) for done in range(0, io, 16)]


def slave(address, io, **user_cpu):
    cfg = identifiers(io)
    return {"name": f"s{address}", "address": address, "user_cpu": user_cpu,
            "init": {"ident": IDENT, "max_inputs": io, "max_outputs": io, "max_prm": 10, "max_cfg": len(cfg), "cfg": cfg}}


def scenario(name, baud, end, slaves, served):
    """One master, as fast as the bus allows, that brings up and serves the slaves `served`; at the end they are in data exchange."""
    names = [each["name"] for each in served]
    return {"name": name, "baud": baud, "end": end, "slaves": slaves,
            "masters": [{"name": "plc", "address": 0, "bus": {"min_slave_interval": 0, "gap_factor": 0},
                         "slaves": [{"slave": each} for each in names]}],
            "expect": [{"slave": each, "dp_state": "data_exch"} for each in names]}


def many(count, end):
    slaves = [slave(address, 8, behaviour="loop_back", cycle="1ms") for address in range(1, count + 1)]
    return scenario(f"{count} slaves in data exchange", "12M", end, slaves, slaves)


def slow_line():
    slaves = [slave(5, 32, behaviour="loop_back", cycle="1ms")]
    return scenario("32 bytes each way at 1.5 Mbit/s", "1.5M", "2s", slaves, slaves)


def serial_port(mode, **port):
    """A slave whose user CPU exchanges data over a serial host port of the DSDPV1-RSU without a pause."""
    slaves = [slave(5, 32, behaviour="loop_back", cycle="1us", **port)]
    return {**scenario(f"32 bytes each way, without a pause over {mode}", "1.5M", "200ms", slaves, slaves), "chip": {"kind": "dsdpv1_rsu", "mode": mode}}


def with_idle(count):
    """A busy slave, and others that are initialised and receive everything but are never addressed; their user CPUs do nothing."""
    busy = slave(1, 16, behaviour="loop_back", cycle="1ms")
    idle = [slave(address, 16, behaviour="idle", cycle="10s") for address in range(2, count + 2)]
    return scenario(f"A busy slave and {count} that nobody addresses", "12M", "2s", [busy, *idle], [busy])


def loop(name):
    """A board whose firmware loops and never initialises its chip, without traffic on the bus."""
    return {"name": name, "baud": "12M", "end": "1ms", "allow": [{"event": "HOST_NOT_OWNER", "slave": "board"}], "expect": [{"slave": "board", "dp_state": "offline"}],
            "slaves": [{"name": "board", "address": 5, "gsd": str(programs.ROOT / "scenarios" / "dsdpv1.gsd"), "modules": ["8 bytes in, 8 bytes out"],
                        "user_cpu": {"kind": "arm", "elf": str(programs.FOLDER / "firmware" / f"{name}.elf"), "fsmc": {"hclk": 72}}, "release_reset": "20us"}]}


SCENARIOS = {"1m5": slow_line(), "spi_9m": serial_port("spi", spi={"clock": 9000}), "uart_1m8": serial_port("uart"), "slaves_32": many(32, "40ms"), "slaves_125": many(125, "100ms"),
             "one_busy": with_idle(0), "spc3_busy": {**with_idle(0), "chip": {"kind": "apc3"}}, "with_idle": with_idle(IDLE),
             **{name: loop(name) for name in ("loop_ram", "loop_gpio", "loop_dpram")}}


def write_all(folder):
    """Each as FOLDER/NAME.yaml."""
    for name, content in SCENARIOS.items():
        (folder / f"{name}.yaml").write_text(json.dumps(content), encoding="utf-8")
