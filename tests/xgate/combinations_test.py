#!/usr/bin/env python3
"""An XGate-DPS10 with every command, by UART and SPI: each row of ROWS does what its cell of docs/xgate.md says.

    combinations_test.py DSDPV1_SIM [NUMBER...]   all rows, or these; compares the page's table, too
    combinations_test.py --table                  prints the table of docs/xgate.md

Needs DSDPV1_LIBRARY for the C API and Python.
"""
import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from combinations import ROOT, Table, main  # pylint: disable=wrong-import-position

SCENARIO = """name: x
baud: 12M
end: 60ms
chip: {kind: xgate, port: %s, rate: 1000000, answer_delay: 50us, power_up: 2ms}
masters:
  - {name: plc, address: 1, slaves: [{slave: io, outputs: 01 02 03, dpv1: true, alarms: {process: true}}]}
slaves:
  - name: io
    address: 5
    init: {ident: 0x0F01, max_inputs: 3, max_outputs: 3, cfg: 12 22, dpv1: true}
    user_cpu: {cycle: 1ms, answer_ms: 5, dpv1: {objects: [{slot: 1, index: 1, data: "01 02 03 04"}]}}
script:
  - {at: 30ms, do: c1_read, slave: io, slot: 1, index: 1, length: 4}
  - {at: 40ms, do: set_diagnosis, slave: io, type: external, bytes: 05 02 07 28 A5}
expect:
  - {slave: io, dp_state: data_exch, outputs: 01 02 03, by: 25ms}
  - {reply_of: c1_read, reply: "01 02 03 04", by: 45ms}
  - {slave: io, event: ALARM_ACK, by: 55ms}
"""


def only(cell, kind):
    return cell.kind == kind


def engines(cell):
    cell.engines_agree()


def outputs(cell):
    files = {"--log": "x.log", "--result": "x.json", "--report": "x.html", "--junit": "x.xml", "--capture": "x.pcapng", "--wave": "x.vcd"}
    cell.passes("run", "x.yaml", "-q", *(word for pair in files.items() for word in pair))
    cell.expect("state", json.loads(cell.read("x.json"))["slaves"][0]["dp_state"], "DATA_EXCH")
    cell.expect("a frame in the log", " 7E 20 03 11 " in cell.read("x.log").decode(), True)
    wave = cell.read("x.vcd").decode()
    cell.expect("pins in the wave", [pin for pin in ("RESET", "PBTXD", "RXD", "TXD", "NSS", "SCK", "MISO", "INT", "LED1A") if f" {pin} " not in wave], [])


def checks(cell):
    cell.passes("run", "x.yaml", "-q", "--checks", "fail")
    done = cell.call("run", "x.yaml", "--no-progress", "--set", "checks.INT_SERVED.max=1ns")
    cell.expect("a limit that no host keeps", (done.returncode, "INT_SERVED" in done.stdout), (1, True), done.stdout[-1000:] + done.stderr)
    cell.passes("run", "x.yaml", "-q", "--set", "checks.INT_SERVED.max=1ns", "--checks", "off")


def reasons(cell):
    cell.expect("advice", "Send a command when the answer to the last one is complete." in cell.passes("reasons", "xgate_lost"), True)
    cell.expect("a check", "6 MHz" in cell.passes("reasons", "--checks"), True)


def saved(cell):
    """In start-up, with a request open, with an alarm open."""
    for at in ("5ms", "31ms", "40500us"):
        cell.continues(at)
    cell.passes("run", "x.yaml", "-q", "--wave", "x.vcd", "--rewind-on", "ALARM_ACK", "50us")


def golden(cell):
    (cell.folder / "goldens").mkdir()
    cell.passes("traces", "regenerate", "x.yaml", "--folder", "goldens", "--no-progress")
    for engine in ("skip", "step"):
        cell.passes("traces", "check", "x.yaml", "--folder", "goldens", "--no-progress", "--engine", engine)


def replay(cell):
    """The host's first command comes at another time than in the recording: equal inputs show no difference."""
    text = cell.scenario.replace("cycle: 1ms,", "cycle: 1ms, behaviour: constant, constant: 00 00 00,")
    cell.write("x.yaml", "".join(line for line in text.splitlines(True) if "ALARM" not in line and "set_diagnosis" not in line))
    cell.passes("run", "x.yaml", "-q", "--capture", "x.pcapng")
    cell.replays_equal(5, "--scenario", "x.yaml")
    cell.replays_equal(5, "--chip", "xgate")


def campaigns(cell):
    text = cell.passes("sweep", "x.yaml", "--param", "chip.answer_delay=50us,500us", "--no-progress", "--out", "points")
    cell.expect("points", "2 of 2 points" in text, True, text)
    cell.passes("regress", "x.yaml", "--no-progress", "--jobs", "1")


def serve(cell):
    cell.passes("serve", "x.yaml", "--tcp", "0", "--for", "60ms")


def outside(cell):
    """More of it: tests/serve/outside_test.py. No host program comes: nothing is exchanged."""
    words = ("serve", "x.yaml", "--tcp", "0", "--user-tcp", "0", "--for", "20ms")
    if only(cell, "spi"):
        cell.is_refused("needs a slave with a UART for its user CPU", *words)
    else:
        cell.expect("without a host", cell.call(*words).returncode, 1)


def board(cell):
    """More of it: scenarios/xgate_arm_uart.yaml and xgate_arm_spi.yaml."""
    arm = ("--set", "user_cpu.kind=arm", "--set", "user_cpu.elf=x.yaml")
    cell.is_refused("--gdb needs a slave whose user_cpu has kind: arm", "run", "x.yaml", "--gdb", "0")
    cell.write("x.yaml", cell.scenario.replace("cycle: 1ms, answer_ms: 5, ", ""))
    cell.is_refused("is not an ELF file", "run", "x.yaml", *arm)
    cell.write("y.yaml", cell.scenario.replace("cycle: 1ms, answer_ms: 5, ", "").replace("script:\n", "script:\n  - {at: 20ms, slave: io, do: flip_bit}\n"))
    cell.is_refused("flip_bit is of no use with kind: arm", "run", "y.yaml", *arm)


def process(cell):
    cell.is_refused('kind is "process", expected native', "run", "x.yaml", "--set", "user_cpu.kind=process")


def files(cell):
    cell.passes("run", "x.yaml", "-q", "--wave", "a.vcd", "--capture", "x.pcapng")
    cell.passes("compare", "a.vcd", "a.vcd")
    cell.expect("decode", "Alarm_Ack slot 7" in cell.passes("decode", "x.pcapng"), True)
    cell.passes("gsd", ROOT / "scenarios/xgate.gsd")


def c_api_and_python(cell):
    import dsdpv1  # pylint: disable=import-outside-toplevel  # the table needs none
    cell.expect("Python", dsdpv1.run(cell.folder / "x.yaml").verdict, "PASSED")
    cell.expect("pins", [pin.name for pin in dsdpv1.kind_of("xgate").pins][4:7], ["RXD", "TXD", "NSS"])


def systemc(cell):
    cell.is_refused("a user CPU moves their pins, expected --view pins", "run", "x.yaml", "--view", "tlm")


def rtl(cell):
    for words in (("run", "x.yaml", "--engine", "rtl"), ("run", "x.yaml", "--engine", "lockstep"), ("cosim", "x.yaml", "--rtl", ".", "--top", "x")):
        cell.is_refused("RTL is for chips of the kinds", *words)
    for words in (("rtl-random",), ("rtl-faults",), ("verify-rtl", "--rtl", ".", "--top", "x"), ("accept", "--native")):
        cell.is_refused("--chip is xgate, expected dsdpv1", *words, "--chip", "xgate")


def calibrate(cell):
    cell.passes("run", "x.yaml", "-q", "--wave", "x.vcd")
    cell.expect("of its line", re.search(r"[1-9]\d* rulings confirmed, 0 contradicted", cell.passes("calibrate", "x.vcd")) is not None, True)


def other_chips(cell):
    more = "  - {name: other, address: 6, chip: {kind: apc3}, init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: \"31\"}}\n"
    text = cell.scenario.replace("script:", more + "script:").replace("process: true}}]", "process: true}}, {slave: other, outputs: 05 06}]")
    cell.write("x.yaml", text + "  - {slave: other, dp_state: data_exch, outputs: 05 06, by: 25ms}\n")
    cell.passes("run", "x.yaml", "-q")


def orders(cell):
    """More of it: scenarios/xgate_faults.yaml."""
    def ordered(action):
        script = cell.scenario.replace("script:\n", f"script:\n  - {{at: 20ms, slave: io, do: {action}}}\n")
        cell.write("y.yaml", script + "allow: [{event: XGATE_LOST}]\n")
        return ("run", "y.yaml", "-q", "--checks", "report")
    for action in ("flip_bit", "cut_telegram", "pause_telegram, for: 3ms", "host_telegram, bytes: 7E 01 01 11 01", "pause_user, for: 1ms"):
        cell.passes(*ordered(action))
    if only(cell, "spi"):
        cell.is_refused("talk_over_reply is of no use with port: spi of the chip, expected port: uart", *ordered("talk_over_reply"))
    else:
        cell.passes(*ordered("talk_over_reply"))


def not_served(cell):
    for action in ("wrong_length", "verdict, of: prm", "hold_dpram, for: 1us"):
        cell.write("y.yaml", cell.scenario.replace("script:\n", f"script:\n  - {{at: 20ms, slave: io, do: {action}}}\n"))
        done = cell.call("run", "y.yaml")
        cell.expect(action, (done.returncode, done.stderr.count("\n")), (2, 1), done.stdout[-300:] + done.stderr)
    for key in ("judge_prm=refuse", "overwrite_inputs=false"):
        cell.is_refused("the program of xgate does not serve it", "run", "x.yaml", "--set", f"user_cpu.{key}")
    cell.is_refused("always exchanges", "run", "x.yaml", "--set", "user_cpu.behaviour=idle")


ROWS = [  # what, how, the function
    ("`run --engine skip`, `step`", "yes: equal pins, log and wave", engines),
    ("`--log`, `--wave`, `--result`, `--report`, `--junit`, `--capture`", "yes; log and wave have the host's frames in words", outputs),
    ("`--checks`", "[of the host](checks.md#the-checks-of-the-host-of-an-xgate-dps10)", checks),
    ("`reasons`", "yes", reasons),
    ("`--save-at`, `--restore`, `--rewind-on`", "yes, also with a request or an alarm that is open", saved),
    ("`traces`", "yes", golden),
    ("`replay`", "with `--chip xgate`, or `--scenario`; a host takes milliseconds, so that inputs which change and diagnoses come at another time, and differ", replay),
    ("`sweep`, `regress`", "yes", campaigns),
    ("`serve`", "yes", serve),
    ("`serve --user-pty`, `--user-tcp`", "[a host program of yours](#a-host-program-on-your-pc), by UART; by SPI refused", outside),
    ("ARM board, `--gdb`", "[firmware as the host](arm_board.md#an-xgate-dps10), without faults on order", board),
    ("host process", "refused: `user_cpu` has not this `kind`", process),
    ("`compare`, `decode`, `gsd`", "yes: about lines and files", files),
    ("C API, Python", "scenarios; [a module](#in-programs) by its host's bytes", c_api_and_python),
    ("`--view tlm`", "refused: the host moves pins", systemc),
    ("`--engine rtl`, `lockstep`, `cosim`, `rtl-random`, `rtl-faults`, `verify-rtl`, `accept`", "refused: no RTL, no random hosts", rtl),
    ("`calibrate`", "its line: rulings S and V of a slave", calibrate),
    ("other chips on the line", "yes", other_chips),
    ("faults on order: `flip_bit`, `cut_telegram`, `pause_telegram`, `host_telegram`, `pause_user`; `talk_over_reply`", "yes; the last by UART only", orders),
    ("`judge_*`, `overwrite_inputs`, `behaviour: idle`, `verdict`, `wrong_length`, `hold_dpram`", "refused: the module judges, the host has none of it", not_served),
]

if __name__ == "__main__":
    sys.exit(main(Table(ROOT / "docs/xgate.md", "an XGate-DPS10 with", ROWS, {port: SCENARIO % port for port in ("uart", "spi")})))
