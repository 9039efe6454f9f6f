#!/usr/bin/env python3
"""RTL of a user's own, of every kind, at every host port, with parameters of the chip and without, by every entrance; and maps that are wrong.

    own_rtl_combinations_test.py DSDPV1_SIM FOLDER

The RTL is a copy of the reference with other names and polarities and an input of its own. It is built in FOLDER once for each top.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
PORT = re.compile(r"^  (input|output) +logic +(?:\[(\d+):0\] +)?(\w+?)_([io]),?(?: *//.*)?$", re.MULTILINE)
INVERTED = ("reset", "csr", "intr0", "d_oe", "miso_oe", "xss", "pbtxd")
PARTS = {"dsdpv1": ("dsdpv1", ["parallel"]), "dsdpv1_r": ("dsdpv1", ["parallel"]), "dsdpv1_rsu": ("dsdpv1_rsu", ["parallel", "spi", "uart"])}
COMMON = {"access_interval": 64, "ready_cycles": 5000, "rts_lead": 3, "rts_trail": 7, "intr_low": 70, "intr_gap": 90, "search_window_ms": 1,
          "search_window_bits": 150, "baud_control_ms": 3, "fcb_rule": "content"}
SERIAL = {"spi_reply_gap": 2, "spi_write_gap": 100, "serial_block_crc": 1, "u_timer": 30000, "uart_gaps": [9, 3, 5, 11, 21, 41, 101, 201],
          "uart_min_tsdr": 20, "uart_cfg_length": 1}
SWAPPED_CRC = 166  # of faults.txt
SLAVE = """slaves: [{name: io, address: 5, init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: "31"}}]
masters: [{name: plc, address: 2, slaves: [{slave: io, outputs: "01 02"}]}]
"""
FAILURES = []
cells = 0


def check(right, what, said=""):
    global cells
    cells += 1
    if not right:
        FAILURES.append(f"{what}\n{said}")


class Copy:
    """The reference with this top: my_TOP has a port pad_NAME for each of NAME_i and NAME_o."""

    def __init__(self, top):
        self.top, self.folder = "my_" + top, FOLDER / top
        shutil.rmtree(self.folder / "rtl", ignore_errors=True)
        self.reference = ROOT / "rtl_ref"
        source = (self.reference / top / f"{top}.sv").read_text(encoding="utf-8")
        self.ports = PORT.findall(source) + [("input", "7", "fault", "i")]
        self.parameters = {**COMMON, **(SERIAL if "spi_reply_gap" in source else {})}
        self.copy_files(top)
        self.write_top(top)

    def copy_files(self, top):
        """The list names the files relative to its own folder."""
        library = self.folder / "rtl" / "library"
        library.mkdir(parents=True)
        files = (self.reference / top / "files.txt").read_text(encoding="utf-8").split()
        for path in [self.reference / each for each in files] + [*self.reference.glob("*.svh"), ROOT / "registers/dsdpv1_regs.svh"]:
            shutil.copy2(path, library)
        names = "\n".join(pathlib.PurePath(each).name for each in files)
        (library / "chip.f").write_text(f"// as other simulators read it\n+incdir+.\n{names}\n")

    def write_top(self, top):
        def level(name):
            return f"{'~' if name in INVERTED else ''}pad_{name}"

        def port(direction, msb, name, side):
            return f"  {direction} logic {f'[{msb}:0] ' if msb else ''}pad_{'q' if (name, side) == ('d', 'o') else name}"

        lines = [f"module {self.top} (", ",\n".join(port(*each) for each in self.ports), "  , input logic [2:0] pad_scan);"]
        for direction, msb, name, side in self.ports:
            if direction == "output":  # with its other polarity, and spoilt when scan is not 0
                pad = "pad_q" if name == "d" else f"pad_{name}"
                lines += [f"  logic {f'[{msb}:0] ' if msb else ''}out_{name};", f"  assign {pad} = {'~' if name in INVERTED else ''}out_{name}"
                          f"{' ^ (pad_scan != 3`d5)'.replace('`', chr(39)) if name == 'pbrts' else ''};"]
        connected = [f".{name}_{side}({level(name) if direction == 'input' else f'out_{name}'})" for direction, _, name, side in self.ports]
        lines += [f"  {top} u_chip ({', '.join(connected)});", "endmodule\n"]
        (self.folder / "rtl" / "top.sv").write_text("\n".join(lines))

    def pins(self, name="pins.yaml", *, leave_out=(), **changes):
        """The map; `changes` replace a line each. The lines by their first words."""
        pins = []
        for direction, _, port, side in self.ports:
            if port in self.parameters or port in ("clk", "fault"):
                continue
            pin = {"d": "D_IN" if side == "i" else "D_OUT"}.get(port, port.upper())
            pad = "pad_q" if (port, side) == ("d", "o") else f"pad_{port}"
            pins.append(f"  {pin}: {{port: {pad}, inverted: true}}" if port in INVERTED else f"  {pin}: {pad}")
        lines = {"clock": "clock: pad_clk", "tie": "tie: {pad_scan: 0x5, pad_fault: 0}",
                 "chip": f"chip: {{{', '.join(f'{each}: {{port: pad_{each}}}' for each in self.parameters)}}}",
                 "defines": "defines: {DSDPV1_RUN_TIME_LIMITS: , SINGLE_FAULTS: 1}", "files": "files: [top.sv]",
                 "file_list": "file_list: library/chip.f", **changes}
        text = [text for key, text in lines.items() if key not in leave_out]
        (self.folder / name).write_text("\n".join([*text, "pins:", *pins, ""]))
        return name

    def call(self, command, *words, pins="pins.yaml"):
        return subprocess.run([SIM, command, "--rtl", "rtl", "--top", self.top, "--pins", pins, *map(str, words)], cwd=self.folder, capture_output=True,
                              text=True, check=False)

    def result(self, *words, **more):
        (self.folder / "r.json").unlink(missing_ok=True)
        done = self.call(*words, "--result", "r.json", **more)
        path = self.folder / "r.json"
        return done, json.loads(path.read_text()) if path.exists() else None


def of_kind(parameters, kind):
    return {key: value for key, value in parameters.items() if kind == "dsdpv1_rsu" or key in COMMON}


def by_scenario(copy, kind, mode, parameters):
    chip = {"kind": kind, **({"mode": mode} if mode != "parallel" else {}), **parameters}
    (copy.folder / "x.yaml").write_text(f"name: x\nbaud: 12M\nend: 3ms\nchip: {json.dumps(chip)}\n{SLAVE}")
    done, result = copy.result("cosim", "x.yaml")
    lockstep = (result or {}).get("lockstep") or {}
    check(lockstep.get("cycles", 0) >= 3 * 48000 - 1 and lockstep["difference"] is None, f"cosim, {kind}, {mode}, {parameters}", done.stdout + done.stderr)


def settings(parameters):
    return [word for key, value in parameters.items() for word in ("--set", f"chip.{key}={value}")]


def at_random(copy, kind, mode, parameters):
    done, result = copy.result("rtl-random", "--chip", kind, "--mode", mode, "--cycles", 1000, *settings(parameters))
    check(done.returncode == 0 and result["chip"] == kind and result["cycles"] >= 1000, f"rtl-random, {kind}, {mode}, {parameters}",
          done.stdout + done.stderr)
    if mode == "parallel":  # the search of the rate is short, also without --set, because the map takes its times: blocks arrive
        read = result["coverage"]["situations"]["written and read"]
        check(all(read[f"Set_Prm, {cells}"] > 0 for cells in ("header", "data", "CRC", "flag")), f"cells read back, {kind}, {mode}", str(read))


def replayed(copy, kind, mode, parameters):
    stimulus = {"parallel": "dsdpv1/user_blocks", "spi": "dsdpv1_rsu/spi_blocks", "uart": "dsdpv1_rsu/news"}[mode]
    path = ROOT / f"tests/cosim/stimuli/{stimulus}.stimulus"
    counts = []
    for command in ("rtl-random", "cosim"):
        done, result = copy.result(command, "--chip", kind, "--replay", path, *settings(parameters))
        check(done.returncode == 0 and result["chip"] == kind, f"{command} --replay, {kind}, {mode}, {parameters}", done.stdout + done.stderr)
        counts.append((result or {}).get("pin_changes"))
    check(counts[0] == counts[1], f"replay is the same by both commands, {kind}, {mode}", str(counts))


def defect_is_found(copy, kind, mode):
    """It is in the DPRAM alone, and only a user who reads sees it."""
    pins = copy.pins("swapped.yaml", tie=f"tie: {{pad_scan: 5, pad_fault: {SWAPPED_CRC}}}")
    stimulus = {"parallel": "dsdpv1/user_blocks", "spi": "dsdpv1_rsu/spi_blocks", "uart": "dsdpv1_rsu/news"}[mode]
    short = settings({"search_window_ms": 1, "search_window_bits": 150})
    done, result = copy.result("rtl-random", "--chip", kind, "--replay", ROOT / f"tests/cosim/stimuli/{stimulus}.stimulus", *short, pins=pins)
    pin = {"parallel": "D_OUT", "spi": "MISO", "uart": "TXD"}[mode]
    check(done.returncode == 1 and f"pin {pin}: " in result["difference"]["what"], f"swapped CRC, {kind}, {mode}", done.stdout + done.stderr)


def faults_are_found(copy, kind, mode):
    """A list of faults in one's own RTL: one that pins show, one that only a user who reads sees, and none; and a stimulus with one of them."""
    pins = copy.pins("faults.yaml", tie="tie: {pad_scan: 5}", fault="fault: pad_fault")
    folder, name = {"parallel": ("dsdpv1", "user_blocks"), "spi": ("dsdpv1_rsu", "spi_blocks"), "uart": ("dsdpv1_rsu", "news")}[mode]
    stimulus = ROOT / f"tests/cosim/stimuli/{folder}/{name}.stimulus"
    played = copy.folder / "played"
    shutil.rmtree(played, ignore_errors=True)
    played.mkdir()
    shutil.copy2(stimulus, played)
    (copy.folder / "faults.txt").write_text(f"46 interrupt {name} INTR0 is short\n{SWAPPED_CRC} dpram_move {name} CRC bytes are swapped\n255 nothing - none\n")
    done = copy.call("rtl-faults", "--chip", kind, "--mode", mode, "--list", "faults.txt", "--directed", "played", "--cycles", 10000, "--tsv", "kills.tsv", pins=pins)
    rows = [line.split("\t") for line in (copy.folder / "kills.tsv").read_text().splitlines()[1:]]
    pin = {"parallel": "D_OUT", "spi": "MISO", "uart": "TXD"}[mode]
    check(done.returncode == 1 and [row[3] for row in rows] == ["yes", "yes", "no"] and rows[0][6:] == [name, "pin INTR0: model 0, RTL 1"] and
          rows[1][6] == name and rows[1][7].startswith(f"pin {pin}: "), f"rtl-faults, {kind}, {mode}", done.stdout + done.stderr)
    done, result = copy.result("rtl-random", "--chip", kind, "--mode", mode, "--fault", 46, "--replay", stimulus, pins=pins)
    check(done.returncode == 1 and result["fault"] == 46 and "pin INTR0: " in result["difference"]["what"], f"--fault, {kind}, {mode}", done.stdout + done.stderr)


def fault_beyond_the_port(copy):
    (copy.folder / "wide.txt").write_text("46 interrupt - INTR0 is short\n256 nothing - its number has 9 bits\n")
    done = copy.call("rtl-faults", "--list", "wide.txt", pins=copy.pins("faults.yaml", tie="tie: {pad_scan: 5}", fault="fault: pad_fault"))
    check(done.returncode == 2 and not done.stdout and re.fullmatch(r"faults.yaml:\d+: fault of pad_fault is 256, expected a number of 8 bits\n", done.stderr),
          "a fault beyond the port", done.stdout + done.stderr)


def wrong(copy, line, words, *more, **changes):
    """One line that names the file, the line of the map and `words`; exit 2."""
    pins = copy.pins("wrong.yaml", **changes)
    number = next((i for i, text in enumerate((copy.folder / pins).read_text().splitlines(), 1) if line and text.lstrip().startswith(line)), 0)
    done = copy.call("rtl-random", "--cycles", "1", *more, pins=pins)
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


def scenario_without_mapping(copy):
    """Not even a scenario's parameter is dropped in silence."""
    copy.pins("few.yaml", chip="chip: {}", tie="tie: {pad_scan: 5, pad_fault: 0, " + ", ".join(f"pad_{key}: 1" for key in COMMON) + "}")
    (copy.folder / "x.yaml").write_text(f"name: x\nbaud: 12M\nend: 5ms\nchip: {{search_window_ms: 5}}\n{SLAVE}")
    done = copy.call("cosim", "x.yaml", pins="few.yaml")
    check(done.returncode == 2 and "chip.search_window_ms is not the default" in done.stderr, "cosim without chip: in the map", done.stdout + done.stderr)


def crossed(copy):
    """What the map says reaches the RTL: two parameters exchanged are a difference."""
    copy.pins("crossed.yaml", chip=(copy.folder / copy.pins()).read_text().split("\n")[2].replace("port: pad_rts_lead", "port: x").replace(
        "port: pad_rts_trail", "port: pad_rts_lead").replace("port: x", "port: pad_rts_trail"))
    done = copy.call("rtl-random", "--replay", ROOT / "tests/cosim/stimuli/dsdpv1/user_blocks.stimulus", *settings(COMMON), pins="crossed.yaml")
    check(done.returncode == 1 and "pin PBRTS: " in done.stdout, "crossed parameters", done.stdout + done.stderr)


def main():
    copies = {top: Copy(top) for top in ("dsdpv1", "dsdpv1_rsu")}
    for kind, (top, modes) in PARTS.items():
        copy = copies[top]
        copy.pins()
        for mode in modes:
            for parameters in ({}, of_kind(copy.parameters, kind)):
                for entrance in (by_scenario, at_random, replayed):
                    entrance(copy, kind, mode, parameters)
            defect_is_found(copy, kind, mode)
            faults_are_found(copy, kind, mode)
    copy = copies["dsdpv1"]
    crossed(copy)
    scenario_without_mapping(copy)
    fault_beyond_the_port(copy)
    wrong_maps(copy)
    print(f"{cells} cells")
    sys.exit("\n".join(FAILURES) or 0)


if __name__ == "__main__":
    main()
