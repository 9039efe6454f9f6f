#!/usr/bin/env python3
"""The cost of an application's cycle over each host port: compares the table in docs/programmers_guide.md with runs of dsdpv1-sim.

    host_ports.py SIM            runs the ports that are fast enough for a test and compares their rows
    host_ports.py SIM --write    runs all and writes the table

Exit 1 when a row is another, or a run fails.
"""
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile

import guide

HEAD = ("| port | cycle | longest hold | longest wait of the chip | cycles a second |\n"
        "|---|---|---|---|---|\n")
RATES = {"9.6k": 9600, "19.2k": 19200, "38.4k": 38400, "57.6k": 57600, "115.2k": 115200, "230.4k": 230400, "460.8k": 460800, "1.8432M": 1843200}
FAST_US = 60_000  # a longer cycle is run by --write only

SCENARIO = """name: 244 bytes in and 244 bytes out
baud: 12M
end: {end}us
chip: {{kind: dsdpv1_rsu, {chip}}}
slaves:
  - name: card
    address: 5
    gsd: {gsd}
    modules: [{modules}]
    user_cpu: {{cycle: {cycle}us, behaviour: count, {user}}}
masters:
  - name: plc
    address: 2
    start: 1ms
    slaves: [{{slave: card, outputs: "A5*244"}}]
expect:
  - {{slave: card, dp_state: data_exch}}
"""
MODULES = ", ".join(['"16 bytes in, 16 bytes out"'] * 15 + ['"4 bytes in, 4 bytes out"'])


class Port:
    """A row: its name, the chip's and the user CPU's keys, the pins that move in a cycle, and the cycle, which leaves half of its time free."""

    def __init__(self, name, chip, user, pins, cycle_us):
        self.name, self.chip, self.user, self.pins, self.cycle_us = name, chip, user, pins, cycle_us
        self.cycles = 32 if cycle_us < FAST_US else 4  # that are measured


def ports():
    yield Port("parallel", "mode: parallel", "", ("R_REQ", "R_STA"), 4000)
    yield Port("SPI, 9 MHz", "mode: spi", "spi: {clock: 9000}", ("XSS",), 4000)
    for name, rate in RATES.items():
        yield Port(f"UART, {name[:-1]} {name[-1]}bit/s", f"mode: uart, uart_rate: {name}", "", ("RXD", "TXD"), 12_000_000_000 // rate)


def edges(wave):
    """The times in ps at which any pin of a VCD file changes."""
    now = 0
    for line in wave.read_text(encoding="utf-8").split("$enddefinitions $end\n")[1].splitlines():
        if line.startswith("#"):
            now = int(line[1:])
        elif now > 0:
            yield now


def exchanges(wave, pause):
    """How long each group of edges lasts that no pause separates, ps."""
    groups = []
    for at in edges(wave):
        if groups and at - groups[-1][1] < pause:
            groups[-1][1] = at
        else:
            groups.append([at, at])
    return [last - first for first, last in groups]


def simulate(sim, port, folder):
    scenario, wave, result = folder / "cost.yaml", folder / "cost.vcd", folder / "cost.json"
    scenario.write_text(SCENARIO.format(end=20_000 + (port.cycles + 4) * port.cycle_us, chip=port.chip, gsd=guide.ROOT / "scenarios/dsdpv1.gsd", modules=MODULES,
                                        cycle=port.cycle_us, user=port.user), encoding="utf-8")
    signals = [word for pin in port.pins for word in ("--wave-signals", f"card.{pin}")]
    done = subprocess.run([sim, "run", scenario, "--checks", "off", "--quiet", "--wave", wave, *signals, "--result", result], check=False,
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{port.name}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return exchanges(wave, port.cycle_us * 250_000), json.loads(result.read_text(encoding="utf-8"))["slaves"][0]


def us(ps):
    return f"{ps / 1e6:.1f} us" if ps < 1e10 else f"{ps / 1e9:.2f} ms"


def row(sim, port):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_host_port_") as folder:
        lasted, slave = simulate(sim, port, pathlib.Path(folder))
    cycles = lasted[-port.cycles - 1:-1]  # the last may be cut
    if len(cycles) < port.cycles:
        sys.exit(f"{port.name}: {len(cycles)} cycles instead of {port.cycles}")
    hold, wait = slave["handshake"]["user_longest_hold_ns"], slave["handshake"]["chip_longest_wait_ns"]
    return (f"| {port.name} | {us(max(cycles))} | {us(hold * 1000) if hold else 'none'} | {us(wait * 1000)} | "
            f"{1e12 / max(cycles):.1f} |\n")


def rows(sim, chosen):
    with concurrent.futures.ThreadPoolExecutor() as pool:
        return list(pool.map(lambda port: row(sim, port), chosen))


def main():
    sim, write = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:] == ["--write"]
    block = guide.Block("host_ports", "table of the host ports is stale")
    if write:
        block.write(HEAD + "".join(rows(sim, ports())))
        return
    fast = [port for port in ports() if port.cycle_us < FAST_US]
    stale = [line for line in rows(sim, fast) if line not in block.text]
    stale += [port.name for port in ports() if f"| {port.name} |" not in block.text]
    if stale:
        block.refuse("a run gives\n" + "".join(stale))


if __name__ == "__main__":
    main()
