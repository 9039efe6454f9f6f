#!/usr/bin/env python3
"""The SPC3 family with every command: each row of ROWS does what its cell of docs/spc3_use.md says.

    combinations_test.py DSDPV1_SIM [NUMBER...]   all rows, or these; compares the page's table, too
    combinations_test.py --table                  prints the table of docs/spc3_use.md

Needs DSDPV1_LIBRARY for the C API and Python.
"""
import json
import os
import pathlib
import re
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3]))
from combinations import ROOT, Table, main  # pylint: disable=wrong-import-position

KINDS = ("apc3", "spc3", "vpc3")
SCENARIO = """name: x
baud: 12M
end: 12ms
chip: {kind: %s}
slaves:
  - {name: io, address: 5, init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: "31"}, user_cpu: {behaviour: constant, constant: "A1 A2"}}
masters:
  - {name: plc, address: 2, start: 2ms, slaves: [{slave: io, outputs: "01 02"}]}
expect:
  - {slave: io, dp_state: data_exch, outputs: "01 02", by: 11ms}
"""


def engines(cell):
    cell.engines_agree()


def outputs(cell):
    cell.passes("run", "x.yaml", "-q", "--wave", "x.vcd", "--capture", "x.pcapng", "--result", "x.json", "--report", "x.html", "--junit", "x.xml")
    wave = cell.read("x.vcd").decode()
    cell.expect("pins in the wave", [pin for pin in ("RESET", "RXD", "TXD", "RTS", "XCTS", "X_INT", "XDATAEXCH") if f" {pin} " not in wave], [])
    cell.expect("state in the result", json.loads(cell.read("x.json"))["slaves"][0]["dp_state"], "DATA_EXCH")


def checks(cell):
    cell.passes("run", "x.yaml", "-q", "--checks", "fail")
    done = cell.call("run", "x.yaml", "--no-progress", "--set", "checks.ACK_TIME.max=1ns")
    cell.expect("a limit that no user keeps", (done.returncode, "ACK_TIME" in done.stdout), (1, True), done.stdout[-1000:] + done.stderr)
    cell.passes("run", "x.yaml", "-q", "--set", "checks.ACK_TIME.max=1ns", "--checks", "off")


def inside(cell):
    cell.passes("run", "x.yaml", "-q", "--engine", "step", "--wave", "x.vcd", "--wave-inside")
    wave = cell.read("x.vcd").decode()
    for word in ("sD1\\x20N-\\x20U2\\x20F3", "sWAIT_CFG", "sDATA_EX", "sBAUD_CONTROL"):
        cell.expect("named states", word in wave or word.replace("\\x20", "_") in wave, True, word)


def saved(cell):
    cell.continues("8ms")


def golden(cell):
    (cell.folder / "goldens").mkdir()
    cell.passes("traces", "regenerate", "x.yaml", "--folder", "goldens", "--no-progress")
    for engine in ("skip", "step"):
        cell.passes("traces", "check", "x.yaml", "--folder", "goldens", "--no-progress", "--engine", engine)


def replay(cell):
    cell.passes("run", "x.yaml", "-q", "--capture", "x.pcapng")
    for words in (("--chip", cell.kind), ("--scenario", "x.yaml")):
        cell.replays_equal(5, *words)


def campaigns(cell):
    cell.passes("sweep", "x.yaml", "--param", "user_cpu.cycle=50us,200us", "--out", "sweep", "--no-progress", "-q", "--jobs", "1")
    cell.passes("regress", "x.yaml", "--no-progress", "--jobs", "1")


def serve(cell):
    cell.passes("serve", "x.yaml", "--tcp", "0", "--for", "12ms")


def without_chip(cell):
    cell.passes("run", "x.yaml", "-q", "--wave", "a.vcd", "--capture", "x.pcapng")
    cell.passes("compare", "a.vcd", "a.vcd")
    cell.passes("decode", "x.pcapng")
    cell.passes("gsd", ROOT / "scenarios/dsdpv1.gsd")


def c_api_and_python(cell):
    import dsdpv1  # pylint: disable=import-outside-toplevel  # the table needs none
    cell.expect("Python", dsdpv1.run(cell.folder / "x.yaml").verdict, "PASSED")
    chip = dsdpv1.Chip(cell.kind)
    chip.poke(0x50, 0xA5)
    cell.expect("peek", chip.peek(0x50), 0xA5)
    cell.expect("buffers after RESET", (chip.peek(0x08), chip.peek(0x0A), chip.peek(0x0C)), (0xE1, 0xE1, 0x09))
    read_at_the_pins(cell, chip)


def read_at_the_pins(cell, chip):
    """An access to 50H on the asynchronous Intel bus."""
    chip.set("RESET", 0)
    for tick, pin, level in ((2000, "AB", 0x50), (2000, "XCS", 0), (2300, "XRD_R_W", 0)):
        chip.set(pin, level, tick)
    cell.expect("DB at XREADY", (chip.sample(4600), chip.level("XREADY_XDTACK")), (0xA5, 0))
    chip.set("XRD_R_W", 1, 4700)
    cell.expect("DB after it", chip.level("DB_OUT"), -1)
    chip.set("XCS", 1)
    cell.expect("read", chip.read(0x50), 0xA5)


def by_spi(cell):
    """More of it: telegrams_test.py, tests/spc3/spi_test.cpp, tests/kinds/spc3/board."""
    if cell.kind != "vpc3":
        cell.is_refused('bus is "spi", expected intel_async', "run", "x.yaml", "--set", "chip.bus=spi")
        return
    spi = ("--set", "chip.bus=spi", "--set", "masters.plc.start=15ms", "--set", "end=25ms", "--set", "expect.0.by=24ms")
    cell.engines_agree(*spi)
    cell.expect("SPI: frames in the log", "  13 00 04" in cell.read("skip.log").decode(), True)
    cell.expect("SPI: signals in the wave", [name for name in ("XSS", "SCK", "MISO", "spi_request", "spi_reply") if f" {name} " not in cell.read("skip.vcd").decode()], [])
    cell.continues("8ms", *spi)


def pins_of(cell):
    """As the library lists them, for cocotb and simulators; CLKOUT2/4 has no edges (A43)."""
    import dsdpv1  # pylint: disable=import-outside-toplevel  # the table needs none
    return [pin.name for pin in dsdpv1.kind_of(cell.kind).pins]


def simulators(cell):
    """The modules have a port for each pin. What they do: tests/cocotb/test_spc3.py, tests/bindings_sv/simulator_test.cpp."""
    folder = pathlib.Path(os.environ["DSDPV1_LIBRARY"]).resolve().parents[1] / "bindings/systemverilog"
    for module in ("model", "scoreboard"):
        text = (folder / f"{cell.kind}_{module}.sv").read_text(encoding="utf-8")
        missing = [pin for pin in pins_of(cell) if not re.search(rf"\b{pin.lower().removesuffix('_in').removesuffix('_out')}_[io]\b", text)]
        cell.expect(f"{module}: pins without a port", missing, [])


def systemc_pins(cell):
    """What they do: tests/systemc/spc3_pins_test.cpp."""
    header = (ROOT / "model/systemc/spc3_pins.hpp").read_text(encoding="utf-8")
    missing = [pin for pin in pins_of(cell) if pin != "CLKOUT2_4" and f'{{"{re.sub("^DB_.*", "DB", pin)}"}}' not in header]
    cell.expect("pins without a port", missing, [])


def systemc(cell):
    cell.is_refused("a user CPU moves their pins, expected --view pins", "run", "x.yaml", "--view", "tlm")


def reference_rtl(cell):
    for engine in ("rtl", "lockstep"):
        cell.is_refused(f"the scenario has {cell.kind}, and that kind has no reference RTL", "run", "x.yaml", "--engine", engine)


def first_change(vcd, pin):
    """The time in ps at which it falls."""
    short = re.search(rf"\$var \w+ \d+ (\S+) {pin} ", vcd).group(1)
    fall = re.search(rf"^0{re.escape(short)}$", vcd, re.M)
    return int(vcd[:fall.start()].rpartition("\n#")[2].split()[0])


def own_rtl(cell):
    """RTL that never moves an output differs at the model's first change. Verilator compiles it once."""
    if cell.kind != "apc3" or not shutil.which("verilator"):
        return
    (cell.folder / "rtl").mkdir()
    wires = (ROOT / "tests/cocotb/wires.sv").read_text(encoding="utf-8")
    (cell.folder / "rtl/dead.sv").write_text("/* verilator lint_off UNUSED */\n" + wires[wires.index("module spc3_pins_only"):], encoding="utf-8")
    own = ("--rtl", "rtl", "--top", "spc3_pins_only")
    cell.passes("run", "x.yaml", "-q", "--wave", "x.vcd")
    fell = first_change(cell.read("x.vcd").decode(), "XREADY_XDTACK")
    (cell.folder / "goldens").mkdir()
    cell.passes("traces", "regenerate", "x.yaml", "--folder", "goldens", "--no-progress")
    for command in (("cosim", "x.yaml", "--stimulus", "x.stimulus"), ("traces", "check", "x.yaml", "--folder", "goldens", "--no-progress")):
        done = cell.call(*command, *own)
        said = done.stdout + done.stderr
        found = re.search(r"cycle (\d+) \(.*\n.*XREADY_XDTACK.*: (?:model|golden) 0, (?:RTL|here still) 1", said)
        cell.expect(command, (done.returncode, found is not None), (1, True), said[-1500:])
        if found:
            cell.expect("the cycle", int(found.group(1)), round(fell / 1e6 * 48), said[-1500:])
        if command[0] == "cosim":
            cell.expect("no stimulus", "no stimulus " in said and not (cell.folder / "x.stimulus").exists(), True, said[-1500:])


def random_rtl(cell):
    for command in (("rtl-random",), ("rtl-faults",), ("verify-rtl", "--rtl", ".", "--top", "x")):
        cell.is_refused(f"--chip is {cell.kind}, expected dsdpv1", *command, "--chip", cell.kind)


def board(cell):
    """More of it: tests/kinds/spc3/board."""
    cell.is_refused("--gdb needs a slave whose user_cpu has kind: arm", "run", "x.yaml", "--gdb", "0")
    cell.is_refused("is not an ELF file", "run", "x.yaml", "--set", "user_cpu.kind=arm", "--set", "user_cpu.elf=x.yaml")


def process(cell):
    cell.is_refused("kind is \"process\", expected native, arm", "run", "x.yaml", "--set", "user_cpu.kind=process")


def accept(cell):
    cell.is_refused(f"--chip is {cell.kind}, expected dsdpv1", "accept", "--native", "--chip", cell.kind)


def calibrate(cell):
    cell.passes("run", "x.yaml", "-q", "--wave", "x.vcd")
    cell.is_refused("shows no pin of the chip", "calibrate", "x.vcd")


def not_there(cell):
    cell.is_refused("has no DPV1", "run", "x.yaml", "--set", "slaves.io.init.dpv1=true")
    cell.is_refused("expected 0, 1 or 2", "run", "x.yaml", "--set", "slaves.io.init.cfg_mode=3")
    cell.is_refused("does not tell whether inputs were taken", "run", "x.yaml", "--set", "user_cpu.overwrite_inputs=false")
    for action, why in (("do: wrong_length", "has one length of inputs"), ("do: answer_acyclic, answering: never", "has no DPV1"),
                        ("do: hold_dpram, for: 1us", "hold_dpram"), ("do: write_chip, bytes: 06 00", "expected two of the address and one or more values")):
        text = SCENARIO % cell.kind + f"script: [{{at: 1ms, slave: io, {action}}}]\n"
        cell.write("y.yaml", text)
        cell.is_refused(why, "run", "y.yaml")


ROWS = [  # what, how, the function
    ("`run --engine skip`, `step`", "yes", engines),
    ("`--wave`, `--log`, `--trace`, `--capture`, `--result`, `--report`, `--junit`", "yes", outputs),
    ("`--checks`", "[their own](checks.md#the-checks-of-the-spc3-family)", checks),
    ("`--wave-inside`", "states of MAC, DP, watchdog and buffers in words", inside),
    ("`--save`, `--restore`, `--rewind-on`", "yes", saved),
    ("`traces`, `--golden`", "yes", golden),
    ("`replay`", "with `--chip`, or `--scenario`", replay),
    ("`sweep`, `regress`", "yes", campaigns),
    ("`serve`", "yes", serve),
    ("`compare`, `decode`, `gsd`", "yes: about lines and files", without_chip),
    ("C API, Python", "scenarios; a chip with its pins, `read`, `write`, `load`, `store`, `peek`, `poke`", c_api_and_python),
    ("SPI", "`vpc3`: [yes](spc3.md#a59), in all of the above; the C API's `read` and `write` are refused; `apc3`, `spc3`: refused", by_spi),
    ("cocotb, SystemVerilog, VPI", "[their pins](systemverilog.md#the-other-chips)", simulators),
    ("SystemC module of the pins", "[yes](systemc.md#spc3pinmodule)", systemc_pins),
    ("`--view tlm`", "refused: its user CPU has no pins there; the [SystemC module](systemc.md#spc3tlmmodule) has no scenario", systemc),
    ("`--engine rtl`, `lockstep`", "refused: no reference RTL", reference_rtl),
    ("`cosim --rtl`, `traces check --rtl`", "[RTL of yours](cosim.md#rtl-of-the-spc3-family), by its pins", own_rtl),
    ("`rtl-random`, `rtl-faults`, `verify-rtl`", "refused: no random users", random_rtl),
    ("ARM board, `--gdb`", "[yes](arm_board.md#a-chip-of-the-spc3-family), on the asynchronous Intel bus, or at SPI", board),
    ("host process", "refused: `user_cpu` has not this `kind`", process),
    ("`accept`", "refused: its stimuli are for firmware of a DSDPV1", accept),
    ("`calibrate`", "refused: the pins are not those of a DSDPV1", calibrate),
    ("DPV1, `wrong_length`, `overwrite_inputs: false`, `hold_dpram`", "refused: the chips have none of it", not_there),
]


if __name__ == "__main__":
    sys.exit(main(Table(ROOT / "docs/spc3_use.md", "with the SPC3 family", ROWS, {kind: SCENARIO % kind for kind in KINDS})))
