#!/usr/bin/env python3
"""The output of tshark for captures, with share/wireshark/profibus_dp, compared with the run's log of its telegrams.

    tshark_test.py SIM CASE
"""
import collections
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from random import Random

from wireshark import DISSECTOR, ROOT, SIM, capture, expect, failures, fields, sim, tshark

KINDS = {"10": "SD1", "68": "SD2", "A2": "SD3", "DC": "SD4", "E5": "SC"}
DAMAGED = """
name: Damage of every kind
baud: 500k
end: 30ms
slaves:
  - {name: demo, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: "31"}}
masters:
  - {name: plc, address: 2, start: 1ms, slaves: []}
script:
  - {at: 2ms, do: telegram, bytes: "10 05 02 49 50 16"}
  - {at: 4ms, do: telegram, bytes: "10 05 02 49 51 16"}
  - {at: 6ms, do: telegram, bytes: "10 05 02 49 50 16", faults: {wrong_parity_at: 3}}
  - {at: 8ms, do: telegram, bytes: "68 05 05 68 85 82 6D 3C 3E EE 16", faults: {truncate_after: 7}}
  - {at: 10ms, do: telegram, bytes: "68 05 06 68 85 82 6D 3C 3E EE 16"}
  - {at: 12ms, do: telegram, bytes: "10 05 02 49 50 17"}
  - {at: 14ms, do: telegram, bytes: "10 05 02 49 50 16", faults: {gap_before: 2, gap_bits: 4}}
  - {at: 16ms, do: telegram, bytes: "10 05 02 49 50 16", faults: {missing_stop_at: 1}}
  - {at: 18ms, do: telegram, bytes: "42 05 02 49 50 16"}
allow:
  - {event: BUS_CHARACTER_ERROR}
  - {event: BUS_TELEGRAM_ERROR}
  - {event: BUS_GAP}
  - {event: BUS_T_SYN_VIOLATED}
  - {event: BUS_TWO_MASTERS}
"""
COLLISION = """
name: Two slaves at one address
baud: 1.5M
end: 60ms
chip: {search_window_ms: 5}
slaves:
  - {name: a, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: "31"}}
  - {name: b, address: 7, init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: "31", set_slave_address: true}}
masters:
  - {name: plc, address: 2, start: 1ms, slaves: []}
script:
  - {at: 40ms, do: set_slave_address, master: plc, slave: b, new_address: 5}
  - {at: 50ms, do: slave_diag, master: plc, slave: a}
allow:
  - {event: BUS_COLLISION}
expect:
  - {slave: a, dp_state: wait_prm}
"""


def of_log(entry):
    """The log's data about a telegram, in the format requested from tshark."""
    data = entry["bytes"].split()
    wrong = "wrong" in entry and entry["wrong"] != "character errors"
    return ("wrong" if wrong else KINDS[data[0]], f"{entry['tsdr_bits']:.2f}" if "tsdr_bits" in entry else "")


def shipped_scenarios(folder):
    """Every telegram is dissected, none malformed; types, pairs and response times are those of the log."""
    for name in ("dpv1_c1", "dpv1_c2_two_masters", "diagnosis", "sync_freeze", "set_slave_address", "read_services", "two_slaves",
                 "reinitialise", "baud_change", "min_tsdr_45k45"):
        packets, log = capture(folder, ROOT / f"scenarios/{name}.yaml")
        rows = fields(folder, packets, "pbdl.type", "pbdl.wrong", "pbdl.tsdr_bits", "_ws.malformed", "_ws.lua.error", "_ws.lua.text")
        expect(f"{name}: packets", len(rows), len(log))
        expect(f"{name}: malformed", [row for row in rows if any(row[3:])], [])
        got = [("wrong" if row[1] else row[0], f"{float(row[2]):.2f}" if row[2] else "") for row in rows]
        differ = [(number, a, of_log(b)) for number, (a, b) in enumerate(zip(got, log), 1) if not alike(a, of_log(b))]
        expect(f"{name}: type and TSDR", differ, [])


def alike(got, wanted):
    """A hundredth of a bit time is less than a nanosecond at 12 Mbit/s, which is what the capture rounds to."""
    if got[0] != wanted[0] or bool(got[1]) != bool(wanted[1]):
        return False
    return not got[1] or abs(float(got[1]) - float(wanted[1])) < 0.03


def services(folder):
    """Fields of the services, as scenario and log have them."""
    packets, log = capture(folder, ROOT / "scenarios/dpv1_c1.yaml")
    rows = fields(folder, packets, "pbdp.service", "pbdl.fc.request", "pbdp.v1.error_code_1", "pbdp.v1.slot", "pbdp.ident",
                  "pbdp.prm.dpv1_status_1.dpv1_enable", "pbdp.prm.wd_ms", "pbdp.cfg.input_bytes", "pbdp.diag.status_1.station_not_ready")
    refused = [int(row[2], 16) for row in rows if row[2]]
    expect("Error_Code_1 of the answers", refused, [0xB6, 0xB2, 0xB7, 0xB8])
    prm = [row for row in rows if row[:2] == ["Set_Prm", "1"]]
    expect("Set_Prm: ident, DPV1_Enable", {(row[4], row[5]) for row in prm}, {("0x0cc9", "1")})
    expect("Chk_Cfg: input bytes", {row[7] for row in rows if row[0] == "Chk_Cfg"}, {"1"})
    for service in ("Set_Prm", "Chk_Cfg", "Slave_Diag"):
        count = sum(row[0] == service and row[1] == "1" for row in rows)
        told = sum(bool(re.search(f"request .*  {service}", entry["text"])) for entry in log)
        expect(f"{service} requests", (count, told > 0), (told, True))


def damage(folder):
    """Planted faults are shown by expert infos, flags and comments."""
    scenario = folder / "damaged.yaml"
    scenario.write_text(DAMAGED, encoding="utf-8")
    packets, _ = capture(folder, scenario, status=None)
    text = tshark(folder, packets, "-V", "-Y", "pbdl.damaged or pbdl.wrong")
    for words in ("Wrong FCS, 0x50 is right", "Damaged on the line: character error: wrong parity in byte 49",
                  "No right telegram: cut off", "No right telegram: LE and LEr differ", "No right telegram: wrong end delimiter",
                  "gap: 4.00 bit times before byte 2", "low stop bit in byte 05", "No right telegram: 0x42 is no start delimiter"):
        expect(f"'{words}' is said", words in text, True)
    expect("bytes after a wrong one are there", "420502495016" in tshark(folder, packets, "-x").replace(" ", ""), True)
    flags = dict(zip(("crc", "symbol", "short", "unaligned", "gap", "start"), zip(*fields(
        folder, packets, "frame.packet_flags_crc_error", "frame.packet_flags_symbol_error",
        "frame.packet_flags_packet_too_short_error", "frame.packet_flags_unaligned_frame_error",
        "frame.packet_flags_wrong_inter_frame_gap_error", "frame.packet_flags_start_frame_delimiter_error"))))
    counts = {name: sum(value == "1" for value in column) for name, column in flags.items()}
    # After the low stop bit the receiver starts its characters at other edges, which causes a wrong FCS and gaps as well.
    expect("packets with each flag", counts, {"crc": 2, "symbol": 2, "short": 1, "unaligned": 2, "gap": 2, "start": 1})


def collision(folder):
    """Two slaves that answer at once, here with the same bits."""
    scenario = folder / "collision.yaml"
    scenario.write_text(COLLISION, encoding="utf-8")
    packets, _ = capture(folder, scenario)
    damaged = [row for row in fields(folder, packets, "frame.packet_flags", "frame.comment", "pbdp.service", "pbdl.damaged") if row[3]]
    expect("damaged", damaged, [["0x80000000", "collision: b drives while a does", "Slave_Diag", "1"]])


def link_types(folder):
    """The dissector accepts 257 and all USER types, except those that its settings ignore."""
    scenario = ROOT / "scenarios/read_services.yaml"
    for link in ("profibus", "user0", "user15"):
        packets, log = capture(folder, scenario, link=link)
        rows = fields(folder, packets, "pbdl.type")
        expect(f"{link}: dissected", sum(bool(row[0]) for row in rows), len(log))
    left = tshark(folder, packets, "-o", "pbdl.links:147-150", "-Y", "pbdl")
    expect("USER15 when it is not wanted", left, "")


def installed(folder):
    """One copy into the folder of plugins is enough."""
    shutil.copytree(DISSECTOR, folder / ".local/lib/wireshark/plugins/profibus_dp")
    packets, log = capture(folder, ROOT / "scenarios/read_services.yaml")
    rows = fields(folder, packets, "pbdl.type", installed=True)
    expect("dissected", sum(bool(row[0]) for row in rows), len(log))


def statistics(folder):
    """The listing counts what the log has."""
    packets, log = capture(folder, ROOT / "scenarios/dpv1_c2_two_masters.yaml")
    text = tshark(folder, packets, "-q", "-o", "pbdl.statistics:TRUE")
    got = {name: int(count) for name, count in re.findall(r"^  (SD\d|SC|wrong) +(\d+)$", text, re.M)}
    expect("telegrams by type", got, dict(collections.Counter(of_log(entry)[0] for entry in log)))
    station = re.search(r"^ +5 +(\d+) +(\d+) +(\d+) +(\d+) .* (\S+) \.\. (\S+)$", text, re.M)
    bits = [entry["tsdr_bits"] for entry in log if "tsdr_bits" in entry and (" 5 -> " in " " + entry["text"] or entry["text"].startswith("SC"))]
    expect("answers of station 5", int(station.group(2)), len(bits))
    expect("TSDR of station 5", [abs(float(station.group(5)) - min(bits)) < 0.02, abs(float(station.group(6)) - max(bits)) < 0.02],
           [True, True])


def same_bytes(folder):
    """A capture depends only on the scenario, not on the date or the execution of the chips."""
    scenario = ROOT / "scenarios/read_services.yaml"
    first = capture(folder, scenario)[0].read_bytes()
    for options in ((), ("--engine", "step"), ("--view", "tlm")):
        expect(f"the same with {options}", capture(folder, scenario, *options)[0].read_bytes() == first, True)


def killed(folder):
    """The file left by a killed run is read as far as it goes."""
    command = [SIM, "run", ROOT / "scenarios/dpv1_c2_two_masters.yaml", "-q", "--engine", "step", "--capture", "killed.pcapng"]
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL) as process:
        part = folder / f"killed.pcapng.{process.pid}.part"
        while not (part.exists() and part.stat().st_size > 8192) and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
    expect("no capture under its name", (folder / "killed.pcapng").exists(), False)
    done = sim(folder, "decode", part, status=None)
    told = re.findall(r"^telegram (\d+), packet", done.stdout, re.M)
    expect("telegrams are decoded", len(told) > 100, True)


def telegram(da, sa, fc, data, dsap=None, ssap=None):
    body = bytes([da | (0x80 if dsap else 0), sa | (0x80 if ssap else 0), fc, *([dsap] if dsap else []), *([ssap] if ssap else []), *data])
    return bytes([0x68, len(body), len(body), 0x68]) + body + bytes([sum(body) % 256, 0x16])


def as_pcap(folder, packets):
    file = struct.pack("<IHHiIII", 0xA1B23C4D, 2, 4, 0, 0, 65535, 147)
    for number, packet in enumerate(packets):
        file += struct.pack("<IIII", 0, number * 100_000, len(packet), len(packet)) + packet
    (folder / "made.pcap").write_bytes(file)
    return folder / "made.pcap"


def any_bytes(folder):
    """With any bytes of a service, however few, the dissector has no error."""
    random = Random(1)
    packets = []
    for sap in (*range(47, 63), None):
        for size in (*range(16), 40, 100, 240):
            for fc, dsap, ssap in ((0x6D, sap, 62), (0x08, 62, sap)):
                packets.append(telegram(5, 2, fc, random.randbytes(size), sap and dsap, sap and ssap))
    for function in (0x48, 0x51, 0x56, 0x57, 0x58, 0x5C, 0x5E, 0x5F, 0xD7, 0xDE):
        for size in (*range(16), 240):
            data = bytes([function]) + random.randbytes(size)
            packets += [telegram(5, 2, 0x6D, data, 51, 51), telegram(2, 5, 0x08, data, 51, 51)]
    packets += [packet[:random.randrange(1, len(packet))] for packet in packets]
    packets += [random.randbytes(random.randrange(1, 40)) for _ in range(300)]
    rows = fields(folder, as_pcap(folder, packets), "pbdl.type", "_ws.malformed", "_ws.lua.error")
    expect("packets", len(rows), len(packets))
    expect("errors", [(number, packets[number].hex()) for number, row in enumerate(rows) if any(row[1:])], [])
    expect("all are PROFIBUS", all(row[0] for row in rows), True)


def rare_services(folder):
    """Telegrams that no scenario sends: alarms, channel diagnosis, special identifiers, structured parameters, repeated requests."""
    read = telegram(2, 5, 0x08, bytes([0x10, 0x04, 0, 2, 0x0C, 0xC9, 0x84, 0xC3, 0xA6, 0x42, 0x05]), 62, 60)
    packets = as_pcap(folder, [
        telegram(5, 2, 0x6D, bytes([0x5C, 3, 2, 0x0C]), 50, 51),
        telegram(5, 2, 0x6D, bytes([0xC2, 0x81, 0x40, 0x11, 0x22, 0x57]), 62, 62),
        telegram(5, 2, 0x5D, bytes([0x88, 10, 20, 11, 0x0C, 0xC9, 1, 0x84, 0x40, 0x0B, 6, 129, 0, 0, 7, 8]), 61, 62),
        telegram(5, 2, 0x5D, b"", 60, 62), read, telegram(5, 2, 0x5D, b"", 60, 62),
        telegram(5, 2, 0x6D, bytes([0x5E, 7, 0, 0]), 18, 19),
        bytes([0xA2, 5, 2, 0x6D, *range(8), (5 + 2 + 0x6D + 28) % 256, 0x16])])
    text = tshark(folder, packets, "-V")
    for words in ("Alarm_Ack slot 3, process", "Sequence number: 1", "Special format: output and input (3)", "Manufacturer data: 1122",
                  "[Watchdog / ms: 200]", "Structure_Type: User_Prm_Data (129)", "Error: line break (6)", "Modules with diagnosis: 0x05",
                  "A request again, with the same FCB", "Start delimiter: SD3, 8 bytes of data", "Outputs: 0001020304050607",
                  "PROFIBUS DP, SAP 18 request"):
        expect(f"'{words}' is said", words in text, True)


def channels(folder):
    """An Initiate opens MSAC2 at any SAP of a master, until the Abort; decode and the dissector name the same services."""
    initiate, own = bytes([0x57, 0, 0, 0, 0, 100, 1, 0, 0, 0, 0, 0]), 19
    read = bytes([0x5E, 1, 2, 3])
    telegrams = [telegram(5, 2, 0x6D, read, 30, own), telegram(5, 2, 0x6D, initiate, 49, own),
                 telegram(2, 5, 0x08, bytes([0x56, 30, 0, 100]), own, 49), telegram(5, 2, 0x6D, read, 30, own),
                 telegram(2, 5, 0x08, read, own, 30), telegram(5, 2, 0x6D, read, 30, 20), telegram(5, 2, 0x6D, bytes([0x58, 1, 0x13]), 30, own),
                 telegram(5, 2, 0x6D, read, 30, own), telegram(5, 2, 0x6D, read, 48, 50)]
    packets = as_pcap(folder, telegrams)
    services = ["SAP 30", "MSAC2 Initiate", "MSAC2 Initiate", "MSAC2", "MSAC2", "SAP 30", "MSAC2", "SAP 30", "MSAC2"]
    expect("dissector", [row[0] for row in fields(folder, packets, "pbdp.service")], services)
    sim(folder, "decode", packets, "-q", "--table", "made.tsv")
    rows = (folder / "made.tsv").read_text(encoding="utf-8").splitlines()[1:]
    expect("decode", [row.split("\t")[9] for row in rows], services)


CASES = {case.__name__: case for case in (shipped_scenarios, services, damage, collision, link_types, installed, statistics, channels, any_bytes, rare_services, same_bytes, killed)}

with tempfile.TemporaryDirectory(prefix="dsdpv1_tshark_") as name:
    CASES[sys.argv[2]](pathlib.Path(name))
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
