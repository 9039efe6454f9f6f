#!/usr/bin/env python3
"""RTL of a user's own, of every kind, at every host port, by every command, with parameters of the chip and without; and what surrounds it.

    own_rtl_combinations_test.py DSDPV1_SIM FOLDER dsdpv1|dsdpv1_rsu   of this top; what surrounds it with the first one
    own_rtl_combinations_test.py --table                               prints the table of docs/cosim.md

The RTL is a copy of the reference (own_rtl_copy.py). It is built in FOLDER twice for each top, the second time with its inside.
"""
import dataclasses
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import typing

from own_rtl_copy import COMMON, ROOT, SWAPPED_CRC, Copy, tied

KINDS = {"dsdpv1": ("dsdpv1", ["parallel"]), "dsdpv1_r": ("dsdpv1", ["parallel"]), "dsdpv1_rsu": ("dsdpv1_rsu", ["parallel", "spi", "uart"])}
SLAVE = """slaves: [{name: io, address: 5, init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: "31"}}]
masters: [{name: plc, address: 2, slaves: [{slave: io, outputs: "01 02"}]}]
"""
END_US = 1300  # data are exchanged from 1121 us on
STIMULI = ROOT / "tests/cosim/stimuli"
UNTOLD = "chip.intr_low is not the default and the RTL is not told"
SHORT = {"search_window_ms": 1, "search_window_bits": 150}
FAILURES = []
cells = 0


def check(right, what, said=""):
    global cells
    cells += 1
    if not right:
        FAILURES.append(f"{what}\n{said[-2000:]}")


def said(done):
    return done.stdout + done.stderr


def is_one_line(done):
    return done.stderr.count("\n") == 1 and not done.stdout


def settings(parameters):
    return [word for key, value in parameters.items() for word in ("--set", f"chip.{key}={value}")]


class Cell:
    """A kind at one of its host ports."""

    def __init__(self, copy, kind, mode):
        self.copy, self.kind, self.mode = copy, kind, mode
        self.parameters = {key: value for key, value in copy.parameters.items() if kind == "dsdpv1_rsu" or key in COMMON}
        self.pin = {"parallel": "D_OUT", "spi": "MISO", "uart": "TXD"}[mode]
        self.stimulus = STIMULI / {"parallel": "dsdpv1/user_blocks", "spi": "dsdpv1_rsu/spi_blocks", "uart": "dsdpv1_rsu/news"}[mode]
        self.stimulus = self.stimulus.with_suffix(".stimulus")

    def scenario(self, parameters):
        """Without the SPI replies' gap: its driver reads at once."""
        parameters = {key: value for key, value in parameters.items() if key != "spi_reply_gap"}
        chip = {"kind": self.kind, **({"mode": self.mode} if self.mode != "parallel" else {}), **parameters}
        (self.copy.folder / "x.yaml").write_text(f"name: x\nbaud: 12M\nend: {END_US}us\nchip: {json.dumps(chip)}\n{SLAVE}")
        return "x.yaml"

    def empty(self, name):
        shutil.rmtree(self.copy.folder / name, ignore_errors=True)
        return name


# --- each runs a command on a cell with these parameters and this map, and returns its output and whether it has compared -------------------


def by_scenario(cell, parameters, pins):
    done, result = cell.copy.result("cosim", cell.scenario(parameters), pins=pins)
    lockstep = (result or {}).get("lockstep") or {}
    return done, lockstep.get("cycles", 0) >= END_US * 48 - 1 and lockstep["difference"] is None


def at_random(cell, parameters, pins):
    done, result = cell.copy.result("rtl-random", "--chip", cell.kind, "--mode", cell.mode, "--cycles", 1000, "--jobs", 1, *settings(parameters), pins=pins)
    if done.returncode != 0:
        return done, False
    right = result["chip"] == cell.kind and result["cycles"] >= 1000
    if cell.mode == "parallel":  # the search of the rate is short, also without --set, because the map takes its times: blocks arrive
        read = result["coverage"]["situations"]["written and read"]
        right &= all(read[f"Set_Prm, {each}"] > 0 for each in ("header", "data", "CRC", "flag"))
    return done, right


def replayed(cell, parameters, pins):
    """By both commands, which play it alike."""
    (done, one), (other, two) = (cell.copy.result(command, "--chip", cell.kind, "--replay", cell.stimulus, *settings(parameters), pins=pins)
                                 for command in ("cosim", "rtl-random"))
    same = other.returncode == done.returncode and (one is None or {**one, "chip": cell.kind} == two)
    return (done if same else other), same and one is not None and one["chip"] == cell.kind and one["cycles"] > 0


def regressed(cell, parameters, pins):
    """Two runs at a time with one build: one with a parameter of --set."""
    scenario, low = cell.scenario({each: parameters[each] for each in parameters if each != "intr_low"}), parameters.get("intr_low")
    done = cell.copy.call("regress", scenario, "--engine", "cosim", "--out", cell.empty("regression"), "--jobs", 2, "--no-progress",
                          *(["--set", f"chip.intr_low=100,{low}"] if low else []), pins=pins)
    return done, done.stdout.count("\npassed") == (2 if low else 1)


def against_golden(cell, parameters, pins):
    scenario, goldens = cell.scenario(parameters), cell.empty("goldens")
    (cell.copy.folder / goldens).mkdir()
    made = cell.copy.run("traces", "regenerate", scenario, "--folder", goldens, "--no-progress")
    done = cell.copy.call("traces", "check", scenario, "--folder", goldens, "--no-progress", pins=pins)
    return done, made.returncode == 0 and " changes are the same" in done.stdout


def by_wave(cell, parameters, pins):
    """A wave with the inside of both; inputs reach the RTL's at the next edge of CLK. A fault is a pin with the wrong polarity in the map."""
    if pins == "pins.yaml":
        cell.copy.call("cosim", cell.scenario(parameters), "--wave", "inside.fst", "--wave-from", "1100us", "--wave-to", "1250us")
    done = cell.copy.run("compare", "inside.fst", "inside.fst", "--scope-a", "io", "--scope-b", "io.rtl", "--pins", pins, "--tolerance", "1cycles",
                         "--z", "expected")
    return done, f" {cell.pin.split('_')[0]} " in done.stdout and done.stdout.endswith("EQUAL\n")


def verified(cell, parameters, pins):
    """The scenario at this port and, once, random cases at all ports of the chip: they alone take --set."""
    random = cell.mode == "parallel" or pins == "few.yaml"
    done = cell.copy.call("verify-rtl", cell.scenario(parameters), "--chip", cell.kind, "--only", "scenarios,random" if random else "scenarios",
                          "--cycles", 3, "--out", cell.empty("verification"), "--no-progress", *(settings(parameters) if random else []), pins=pins)
    return done, done.stdout.count("\npassed") == (1 if not random else 4 if cell.kind == "dsdpv1_rsu" else 2)


def faults_of_own(cell, parameters, pins, number=46):
    """One fault; by its stimulus alone, which with other times of the ports does not reach it."""
    parameters = {key: value for key, value in parameters.items() if key in ("intr_low", "intr_gap", "fcb_rule")}
    folder = cell.copy.folder / cell.empty("directed")
    folder.mkdir()
    shutil.copy2(cell.stimulus, folder)
    if pins == "alive.yaml":
        number = 250  # no fault
    (cell.copy.folder / "list.txt").write_text(f"{number} interrupt {cell.stimulus.stem} INTR0 is short\n")
    done = cell.copy.call("rtl-faults", "--chip", cell.kind, "--mode", cell.mode, "--list", "list.txt", "--directed", "directed", "--cycles", 1,
                          *settings(parameters), pins=f"faults_{pins}")
    return done, "1 of 1 faults found" in done.stdout


@dataclasses.dataclass
class Row:
    """A command, and what it says of a fault and of a parameter that the map lacks."""
    command: str
    run: typing.Callable
    fault: typing.Callable = lambda cell: ("swapped.yaml", f"pin {cell.pin}")  # the map, and how it is named
    few: str = "few.yaml"
    untold: str = UNTOLD
    refused: int = 2
    few_in_words: str = ""
    fault_in_words: str = "1"


def spoilt(_):
    return "spoilt.yaml", "pin PBRTS"


def in_scenario(cell):
    """At the serial ports the user reads no CRC that the chip has written."""
    return ("swapped.yaml", f"pin {cell.pin}") if cell.mode == "parallel" else spoilt(cell)


def polarity(cell):
    return "polarity.yaml", f"  {cell.pin.split('_')[0]} "


ROWS = [
    Row("`cosim SCENARIO`", by_scenario, in_scenario),
    Row("`rtl-random`", at_random, spoilt),
    Row("`rtl-random --replay`, `cosim --replay`", replayed),
    Row("`regress --engine cosim`", regressed, in_scenario, refused=1, few_in_words="1, that run is `refused`"),
    Row("`traces check --rtl`", against_golden, in_scenario),
    Row("`compare --pins`", by_wave, polarity, "unknown.yaml", "unknown name watchdog"),
    Row("`verify-rtl`", verified, spoilt),
    Row("`rtl-faults`", faults_of_own, lambda _: ("alive.yaml", "0 of 1 faults found"), fault_in_words="1, if not found"),
]
NOT_FOR_OWN_RTL = [["rtl-random", "--campaign"], ["sweep", "x.yaml"], ["serve", "x.yaml"], ["accept", "x.yaml"], ["calibrate", "x.csv"], ["run", "x.yaml"],
                   ["replay", "x.csv", "--as", "5"], ["traces", "regenerate", "x.yaml"], ["demo"]]


def table():
    lines = ["| command | default parameters | others, taken by the map | one that the map lacks | a fault |", "|---|---|---|---|---|"]
    lines += [f"| {row.command} | 0 | 0 | {row.few_in_words or row.refused} | {row.fault_in_words} |" for row in ROWS]
    names = ", ".join(f"`{' '.join(word for word in words if '.' not in word and word not in ('--as', '5'))}`" for words in NOT_FOR_OWN_RTL)
    return "\n".join([*lines, f"| {names} | 2: not for RTL of your own | | | |", ""])


def serve(row, cell):
    name = f"{row.command}, {cell.kind}, {cell.mode}"
    for parameters in ({}, cell.parameters):
        done, compared = row.run(cell, parameters, "pins.yaml")
        check(done.returncode == 0 and compared, f"{name}, {parameters}", said(done))
    pins, named = row.fault(cell)
    done, _ = row.run(cell, SHORT, pins)
    check(done.returncode == 1 and named in done.stdout, f"{name}, a fault", said(done))
    done, _ = row.run(cell, {"intr_low": 70}, row.few)
    check(done.returncode == row.refused and row.untold in said(done) and (row.refused != 2 or is_one_line(done)), f"{name}, a parameter that the map lacks", said(done))


def faults_are_found(cell):
    """A list of faults in one's own RTL: one that pins show, one that only a user who reads sees, and none; and a stimulus with one of them."""
    copy, name = cell.copy, cell.stimulus.stem
    (copy.folder / cell.empty("played")).mkdir()
    shutil.copy2(cell.stimulus, copy.folder / "played")
    (copy.folder / "faults.txt").write_text(f"46 interrupt {name} INTR0 is short\n{SWAPPED_CRC} dpram_move {name} CRC bytes are swapped\n255 nothing - none\n")
    done = copy.call("rtl-faults", "--chip", cell.kind, "--mode", cell.mode, "--list", "faults.txt", "--directed", "played", "--cycles", 10000,
                     "--tsv", "kills.tsv", pins="faults_pins.yaml")
    rows = [line.split("\t") for line in (copy.folder / "kills.tsv").read_text().splitlines()[1:]]
    check(done.returncode == 1 and [row[3] for row in rows] == ["yes", "yes", "no"] and rows[0][6:] == [name, "pin INTR0: model 0, RTL 1"] and
          rows[1][6] == name and rows[1][7].startswith(f"pin {cell.pin}: "), f"rtl-faults, {cell.kind}, {cell.mode}", said(done))
    done, result = copy.result("rtl-random", "--chip", cell.kind, "--mode", cell.mode, "--fault", 46, "--replay", cell.stimulus, pins="faults_pins.yaml")
    check(done.returncode == 1 and result["fault"] == 46 and "pin INTR0: " in result["difference"]["what"], f"--fault, {cell.kind}, {cell.mode}", said(done))


def fault_beyond_the_port(copy):
    (copy.folder / "wide.txt").write_text("46 interrupt - INTR0 is short\n256 nothing - its number has 9 bits\n")
    done = copy.call("rtl-faults", "--list", "wide.txt", pins="faults_pins.yaml")
    check(done.returncode == 2 and is_one_line(done) and re.fullmatch(r"faults_pins.yaml:\d+: fault of pad_fault is 256, expected a number of 8 bits\n", done.stderr),
          "a fault beyond the port", said(done))


def maps(copy):
    copy.pins()
    copy.pins("swapped.yaml", tie=tied("swapped CRC"))
    copy.pins("spoilt.yaml", tie=tied("spoilt PBRTS"))
    ports = ", ".join(f"{each}: {{port: pad_{each}}}" for each in copy.parameters if each != "intr_low")
    few = f"chip: {{{ports}}}"
    copy.pins("few.yaml", chip=few, tie=tied(pad_intr_low=100))
    for name in ("faults_pins.yaml", "faults_alive.yaml"):
        copy.pins(name, tie="tie: {pad_scan: 5}", fault="fault: pad_fault")
    copy.pins("faults_few.yaml", chip=few, tie="tie: {pad_scan: 5, pad_intr_low: 100}", fault="fault: pad_fault")
    copy.pins("unknown.yaml", chip="chip: {watchdog: WATCHDOG}")
    text = (copy.folder / "pins.yaml").read_text().replace("D_OUT: pad_q", "D_OUT: {port: pad_q, inverted: true}")
    for pin in ("MISO", "TXD"):
        text = text.replace(f"{pin}: pad_{pin.lower()}", f"{pin}: {{port: pad_{pin.lower()}, inverted: true}}")
    (copy.folder / "polarity.yaml").write_text(text)


def refused(copy, words, *more):
    """One line, exit code 2."""
    done = copy.run(*more)
    check(done.returncode == 2 and words in done.stderr and is_one_line(done), " ".join(map(str, more)), said(done))


def not_for_own_rtl(copy):
    for words in NOT_FOR_OWN_RTL:
        refused(copy, "--rtl", *words, *copy.own())
    refused(copy, "--rtl excludes --no-dpram", "rtl-random", *copy.own(), "--no-dpram")


def options_that_would_be_ignored(copy, other):
    """`other`: of another kind."""
    cell = Cell(copy, "dsdpv1", "parallel")
    scenario, own = cell.scenario({}), copy.own()
    copy.pins("tolerant.yaml", tolerance="tolerance: {INTR0: 1}")
    refused(copy, "tolerant.yaml: has a tolerance, goldens have none", "traces", "check", scenario, *copy.own("tolerant.yaml"))
    refused(copy, "--set is for stimuli and random", "verify-rtl", scenario, *own, "--only", "scenarios", "--set", "chip.intr_low=70")
    refused(copy, "unknown key watchdog", "verify-rtl", *own, "--only", "random", "--set", "chip.watchdog=1")
    refused(copy, "x.yaml: is about a dsdpv1, expected a dsdpv1_r as in --chip", "verify-rtl", scenario, *own, "--chip", "dsdpv1_r")
    for command in ("verify-rtl", "rtl-random"):
        refused(copy, "--cycles", command, *own, "--cycles", 0)
    refused(copy, "--report is of run", "regress", scenario, "--engine", "cosim", "--report", *own)
    refused(copy, "--engine cosim and --rtl go together", "regress", scenario, *own)
    refused(copy, "--engine excludes --rtl", "traces", "check", scenario, "--engine", "rtl", *own)
    refused(copy, "only the dsdpv1_rsu has that port", "rtl-random", *own, "--mode", "spi", "--cycles", 1)
    refused(copy, "expected --mode for it", "rtl-random", *own, "--chip", "dsdpv1_rsu", "--set", "chip.mode=spi", "--cycles", 1)
    refused(copy, "unknown name MODE", "rtl-random", "--rtl", "rtl", "--top", copy.top, "--pins", other.folder / other.pins(), "--cycles", 1)
    (copy.folder / "dpram.yaml").write_text("dpram: ram\n")
    refused(copy, "dpram.yaml:1: unknown name dpram", "rtl-random", *copy.own("dpram.yaml"))
    before = (copy.folder / "rtl/top.sv").read_bytes()
    refused(copy, "--result would replace a file of --rtl", "rtl-random", *own, "--replay", cell.stimulus, "--result", "rtl/top.sv")
    check((copy.folder / "rtl/top.sv").read_bytes() == before, "the source is as it was")


def wrong(copy, line, words, *more, **changes):
    """One line that names the file, the line of the map and `words`; exit 2."""
    pins = copy.pins("wrong.yaml", **changes)
    number = next((i for i, text in enumerate((copy.folder / pins).read_text().splitlines(), 1) if line and text.lstrip().startswith(line)), 0)
    done = copy.call("rtl-random", "--cycles", 1, *more, pins=pins)
    begin = f"wrong.yaml:{number}: " if number else "wrong.yaml: "
    check(done.returncode == 2 and done.stderr.startswith(begin) and words in done.stderr and done.stderr.count("\n") == 1 and not done.stdout,
          f"{begin}... {words} ...", done.stdout + done.stderr)


def wrong_maps(copy):
    ports = {key: f"{{port: pad_{key}}}" for key in COMMON}

    def chip(**changes):
        return f"chip: {{{', '.join(f'{key}: {value}' for key, value in {**ports, **changes}.items())}}}"

    wrong(copy, "fault:", "port pad_fault is tie and fault", fault="fault: pad_fault")
    wrong(copy, "", "fault: is missing, expected fault: INPUT", "--fault", 3)
    wrong(copy, "", "my_dsdpv1's input pad_scan is not in the map", tie="tie: {pad_fault: 0}")
    wrong(copy, "tie:", "my_dsdpv1 has no port pad_scam that is an input, for tie", tie="tie: {pad_scan: 5, pad_fault: 0, pad_scam: 0}")
    wrong(copy, "tie:", "tie of pad_scan is 8, expected a number of 3 bits", tie="tie: {pad_scan: 8, pad_fault: 0}")
    wrong(copy, "tie:", "port pad_a is A and tie", tie="tie: {pad_scan: 5, pad_fault: 0, pad_a: 0}")
    wrong(copy, "clock:", "my_dsdpv1 has no port pad_clock that is an input, for CLK", clock="clock: pad_clock")
    wrong(copy, "clock:", "port pad_a of my_dsdpv1 has 11 bits, CLK has 1", clock="clock: pad_a")
    wrong(copy, "chip:", "has no port pad_br that is an input, for chip.rts_lead", chip=chip(rts_lead="{port: pad_br}"))
    wrong(copy, "chip:", "my_dsdpv1 has no parameter LEAD for chip.rts_lead", chip=chip(rts_lead="LEAD"), tie="tie: {pad_scan: 5, pad_fault: 0, pad_rts_lead: 4}")
    wrong(copy, "chip:", "unknown name mode", chip=chip(mode="MODE"))
    wrong(copy, "parameters:", "my_dsdpv1 has no parameter DEPTH for parameters", parameters="parameters: {DEPTH: 4}")
    without = chip().replace("intr_low: {port: pad_intr_low}, ", "")
    wrong(copy, "", "chip.intr_low is not the default and the RTL is not told, expected chip: {intr_low: PARAMETER}", "--set", "chip.intr_low=70", chip=without)
    wrong(copy, "file_list:", "library/chop.f is not in rtl", file_list="file_list: library/chop.f")
    wrong(copy, "files:", "tap.sv is not in rtl", files="files: [tap.sv]")
    wrong(copy, "include:", "lib is not in rtl", include="include: [lib]")


def crossed(copy):
    """What the map says reaches the RTL: two parameters exchanged are a difference."""
    copy.pins("crossed.yaml", chip=(copy.folder / copy.pins()).read_text().split("\n")[2].replace("port: pad_rts_lead", "port: x").replace(
        "port: pad_rts_trail", "port: pad_rts_lead").replace("port: x", "port: pad_rts_trail"))
    done = copy.call("rtl-random", "--replay", ROOT / "tests/cosim/stimuli/dsdpv1/user_blocks.stimulus", *settings(COMMON), pins="crossed.yaml")
    check(done.returncode == 1 and "pin PBRTS: " in done.stdout, "crossed parameters", done.stdout + done.stderr)


class Stub:
    """RTL without a chip, which builds in a moment: its PBRTS, or its BR, is high from the begin."""
    PORTS = ("input logic clk_i, reset_i, pbrxd_i, r_req_i, r_sta_i, csr_i, rd_i, wr_i, input logic [10:0] a_i, input logic [7:0] d_i,\n"
             "  output logic pbtxd_o, pbrts_o, l_req_o, l_sta_o, intr0_o, pbf_o, br_o, ready_o, d_oe_o, output logic [7:0] d_o")

    def __init__(self, sim, folder):
        self.sim, self.folder, self.source = sim, folder, folder / "my rtl" / "stub.sv"
        shutil.rmtree(folder, ignore_errors=True)
        self.source.parent.mkdir(parents=True)

    def write(self, high="pbrts", ports=PORTS, more=""):
        levels = "; ".join(f"assign {name}_o = {int(name in (high, 'pbtxd', 'intr0', 'pbf'))}" for name in
                           ("pbtxd", "pbrts", "l_req", "l_sta", "intr0", "pbf", "br", "ready", "d_oe", "d") if f"{name}_o" in ports)
        self.source.write_text(f"module stub ({ports});\n{more}  {levels};\nendmodule\n")

    def words(self, *more, rtl="my rtl"):
        return [self.sim, "rtl-random", "--rtl", rtl, "--top", "stub", "--replay", str(STIMULI / "dsdpv1/c1.stimulus"), *more]

    def begin(self, *more):
        return subprocess.Popen(self.words(*more), cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)

    def call(self, *more, **rtl):
        return subprocess.run(self.words(*more, **rtl), cwd=self.folder, capture_output=True, text=True, check=False)


def builds(stub):
    """In a path with spaces: each command sees the RTL as it is now."""
    def right(done, pin, when):
        check(done.returncode == 1 and f"pin {pin}: model 0, RTL 1" in done.stdout, f"{when}: {pin}", said(done))

    stub.write()
    two = [stub.begin("--difference", name) for name in ("a.vcd", "b.vcd")]
    for each in two:
        out, err = each.communicate()
        check(each.returncode == 1 and "pin PBRTS: model 0, RTL 1" in out, "two commands at a time", out + err)
    stub.write("br")
    right(stub.call(), "BR", "changed RTL is built again")
    for how in (signal.SIGINT, signal.SIGKILL):
        stub.write("pbrts" if how == signal.SIGINT else "br", more=f"  // before {how.name}\n")
        log = stub.folder / "build/cosim/verilator.log"
        log.unlink(missing_ok=True)
        broken = stub.begin()
        while not log.exists() and broken.poll() is None:
            os.sched_yield()
        if broken.poll() is None:
            os.killpg(broken.pid, how)
        broken.communicate()
        check(broken.returncode in (-how, 130), f"interrupted by {how.name}", str(broken.returncode))
        right(stub.call(), "PBRTS" if how == signal.SIGINT else "BR", f"after {how.name}")
    check([each.name for each in stub.source.parent.iterdir()] == ["stub.sv"], "nothing is written into the folder of the RTL")


def rtl_that_cannot_be_built(stub):
    def says(words, what, *more, **rtl):
        done = stub.call(*more, **rtl)
        check(done.returncode == 2 and words in done.stderr and is_one_line(done), what, said(done))

    stub.write()
    says("a build: has a space, in which make cannot build", "a build folder with a space", "--build", "a build")
    stub.write(ports=stub.PORTS.replace("clk_i, ", ""))
    says("stub has no port clk_i that is an input, for CLK", "a top without a clock")
    shutil.move(stub.folder / "my rtl", stub.folder / "rtl")
    (stub.folder / "rtl/stub.sv").write_text("module stub (input logic clk_i);\n  assign ;\nendmodule\n")
    says("rtl/stub.sv:2:", "a syntax error has its file and line", rtl="rtl")


def surroundings(sim, folder, copy):
    crossed(copy)
    wrong_maps(copy)
    fault_beyond_the_port(copy)
    not_for_own_rtl(copy)
    options_that_would_be_ignored(copy, Copy(sim, folder, "dsdpv1_rsu"))
    stub = Stub(sim, folder / "stub")
    builds(stub)
    rtl_that_cannot_be_built(stub)


def main():
    check(table() in (ROOT / "docs/cosim.md").read_text(encoding="utf-8"), "docs/cosim.md has another table, expected that of --table")
    sim, folder, top = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    copy = Copy(sim, folder, top)
    maps(copy)
    for kind, (its_top, modes) in KINDS.items():
        for mode in modes if its_top == top else []:
            cell = Cell(copy, kind, mode)
            for row in ROWS:
                serve(row, cell)
            faults_are_found(cell)
    if top == "dsdpv1":
        surroundings(sim, folder, copy)
    print(f"{cells} cells")
    sys.exit("\n".join(FAILURES) or 0)


if __name__ == "__main__":
    if sys.argv[1:] == ["--table"]:
        print(table(), end="")
    else:
        main()
