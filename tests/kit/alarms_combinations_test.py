#!/usr/bin/env python3
"""Alarms with every command: each row of ROWS does what its cell of docs/alarms.md says.

    alarms_combinations_test.py ALARMER [NUMBER...]   all rows, or these; compares the page's table, too
    alarms_combinations_test.py --table               prints the table of docs/alarms.md
"""
import json
import pathlib
import socket
import sys
import time

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path += [str(TESTS), str(TESTS / "serve"), str(TESTS / "faults")]
from combinations import ROOT, Table, main  # pylint: disable=wrong-import-position

SLAVE = "  - {name: mine, address: 8, init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, max_prm: 3, cfg: \"31\"}, user_cpu: {cycle: %s, raise: %d}}\n"
SCENARIO = """name: x
baud: 12M
end: 15ms
chip: {kind: alarmer}
masters:
  - {name: plc, address: 1, slaves: [{slave: mine, dpv1: true, alarms: {process: true, mode: 3}}]}
slaves:
%sexpect:
  - {slave: mine, dp_state: data_exch, by: 8ms}
  - {slave: mine, event: ALARM, count: 10}
  - {slave: mine, event: ALARM_ACK, count: 10}
""" % (SLAVE % ("1ms", 31))
ALARM_SAP = 51


def engines(cell):
    cell.engines_agree()
    cell.engines_agree("--set", "masters.plc.slaves.0.alarms.extra_sap=true")


def outputs(cell):
    cell.passes("run", "x.yaml", "-q", "--log", "x.jsonl", "--result", "x.json", "--report", "x.html", "--junit", "x.xml", "--capture", "x.pcapng")
    codes = [event["code"] for event in json.loads(cell.read("x.json"))["events"]]
    cell.expect("events", (codes.count("ALARM"), codes.count("ALARM_ACK")), (14, 14))
    cell.expect("report", b"ALARM_ACK" in cell.read("x.html"), True)
    text = cell.passes("decode", "x.pcapng")
    cell.expect("decode", "Alarm_Ack slot 1, Alarm_Type: process alarm, Alarm_Specifier: appears, sequence number 1" in text, True)


def saved(cell):
    """With an alarm open, with one acknowledged but not yet answered to the master, and between two."""
    for at in ("1050us", "1130us", "4500us"):
        cell.continues(at)
    cell.passes("run", "x.yaml", "-q", "--wave", "x.vcd", "--rewind-on", "ALARM_ACK", "50us")


def replay(cell):
    """The user CPU hands the recorded alarms over; without --chip a DSDPV1 takes their place, which refuses Alarm_Ack (V1)."""
    cell.passes("run", "x.yaml", "-q", "--capture", "x.pcapng")
    for engine in ("skip", "step"):
        text = cell.replays_equal(8, "--chip", "alarmer", "--engine", engine)
        cell.expect("acknowledgements", "  MSAC1                28        28     28 " in text, True, text)
    done = cell.call("replay", "x.pcapng", "--as", "8", "--no-progress")
    cell.expect("without --chip", (done.returncode, "model           8 -> 1  response DL (data low), passive station  MSAC1: Alarm_Ack refused" in done.stdout),
                (1, True), done.stdout)


def campaigns(cell):
    text = cell.passes("sweep", "x.yaml", "--param", "masters.0.slaves.0.alarms.mode=0,1,7", "--no-progress", "--out", "points")
    cell.expect("points", "3 of 3 points" in text, True, text)
    cell.expect("regress", "passed\tx.yaml" in cell.passes("regress", "x.yaml", "--no-progress", "--engine", "skip"), True)


def acknowledge_one(host):
    """High priority in an exchange, the block in Slave_Diag, Alarm_Ack, the poll: what is in the block and in the answer."""
    import dp_host  # pylint: disable=import-outside-toplevel  # the table needs none
    end = time.monotonic() + dp_host.WANTED_S * 20
    while host.request(bytes(2))[6] != 0x0A:
        if time.monotonic() > end:
            raise dp_host.Silent("no answer of high priority")
    block = host.diagnosis()[6:]
    if (got := host.request(bytes([0x5C, block[2], block[1], block[3]]), (ALARM_SAP, ALARM_SAP))) != dp_host.SHORT_ACKNOWLEDGE:
        raise dp_host.Silent("no acknowledgement but " + got.hex())
    while (answer := host.request(b"", (ALARM_SAP, ALARM_SAP))) == dp_host.SHORT_ACKNOWLEDGE:
        pass
    return block, answer[9:-2]


def serve(cell):
    """A master at the port acknowledges."""
    import dp_host  # pylint: disable=import-outside-toplevel  # the table needs none
    from bench import Serve  # pylint: disable=import-outside-toplevel
    from flood import tcp_number  # pylint: disable=import-outside-toplevel
    alone = "name: x\nbaud: 500k\nend: 1s\nchip: {kind: alarmer}\nslaves:\n" + SLAVE % ("50ms", 31)
    served = Serve(cell.program, str(cell.folder), alone, port=("--tcp", "0"))
    try:
        with socket.create_connection(("127.0.0.1", tcp_number(served)), timeout=30) as connection:
            host = dp_host.DpHost(connection)
            host.find(30)
            host.insist(host.diagnosis, 30)
            host.acknowledged(dp_host.SET_PRM, dp_host.PARAMETERS + bytes([0x80, 0x40, 3]))
            host.acknowledged(dp_host.CHK_CFG, dp_host.CONFIGURATION)
            for _ in range(2):
                block, answer = acknowledge_one(host)
                cell.expect("answer", answer.hex(), bytes([0x5C, block[2], block[1], block[3]]).hex(), block.hex())
    finally:
        served.settle()
    cell.expect("acknowledged in the log", (cell.folder / "serve.log").read_text(encoding="utf-8").count("ALARM_ACK: "), 2)


ROWS = [  # what, how, the function
    ("`run --engine skip`, `step`, both SAPs", "yes: equal pins, log and wave", engines),
    ("`--log`, `--result`, `--report`, `--junit`, `--capture`, `decode`", "yes, in words", outputs),
    ("`--save-at`, `--restore`, `--rewind-on`", "yes, also with an alarm that is open", saved),
    ("`replay`", "with `--chip NAME`, if the program hands over diagnoses (`Parts::diagnosis`); a DSDPV1 in its place differs in Alarm_Ack", replay),
    ("`sweep`, `regress`", "yes", campaigns),
    ("`serve`", "yes: the master at the port acknowledges", serve),
]

if __name__ == "__main__":
    sys.exit(main(Table(ROOT / "docs/alarms.md", "alarms with", ROWS, {"": SCENARIO})))
