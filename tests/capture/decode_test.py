#!/usr/bin/env python3
"""The output of `dsdpv1-sim decode` for captures and recordings of the line, compared with the capture or log of the same run.

    decode_test.py SIM CASE
"""
import csv
import gzip
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zipfile
import zlib

from vcd_line import changes_of
from wireshark import ROOT, SIM, capture, expect, failures, sim

RATES = {"12M": 12_000_000, "6M": 6_000_000, "3M": 3_000_000, "1.5M": 1_500_000, "500k": 500_000, "187.5k": 187_500, "93.75k": 93_750,
         "45.45k": 45_454.5, "19.2k": 19_200, "9.6k": 9_600}
EXCHANGE = """
name: Start-up and exchange
baud: {baud}
end: {end}us
chip: {{search_window_ms: 1}}
slaves:
  - {{name: demo, address: 5, init: {{ident: 1, max_inputs: 2, max_outputs: 2, cfg: "31"}}}}
masters:
  - {{name: plc, address: 2, start: 100us, slaves: [{{slave: demo}}]}}
"""


def telegrams(text):
    """(bytes, words) of every printed telegram, valid or not."""
    found = []
    for block in re.split(r"^(?=telegram |wrong telegram)", text, flags=re.M):
        if block.startswith(("telegram", "wrong")):
            found.append((" ".join(re.findall(r"^ +\d+  ([0-9A-F]{2})  ", block, re.M)), block.split(" ns: ")[1].split("\n")[0]))
    return found


def times(text):
    return [float(time) for time in re.findall(r" ([0-9.]+) ns: ", text)]


def decoded(folder, file, *options, status=0):
    return sim(folder, "decode", file, *options, status=status).stdout


def as_the_log(folder):
    """A capture decodes to the same telegrams as the log of its run, whatever its link type."""
    for name, link, status in (("dpv1_c1", "profibus", 0), ("read_services", "user7", 1), ("baud_change", "user0", None)):
        packets, log = capture(folder, ROOT / f"scenarios/{name}.yaml", link=link)
        text = decoded(folder, packets, status=status)
        expect(f"{name}: bytes", [each[0] for each in telegrams(text)], [entry["bytes"] for entry in log])
        expect(f"{name}: words", telegrams(text) == telegrams(decoded(folder, folder / "log.jsonl", status=None)) or name == "read_services",
               True)


def classic(folder):
    """The same as pcap of either byte order, micro- and nanoseconds."""
    packets, _ = capture(folder, ROOT / "scenarios/dpv1_c1.yaml")
    wanted = decoded(folder, packets)
    data = [bytes.fromhex(each[0].replace(" ", "")) for each in telegrams(wanted)]
    for order, magic, unit in (("<", 0xA1B2C3D4, 1000), (">", 0xA1B2C3D4, 1000), ("<", 0xA1B23C4D, 1), (">", 0xA1B23C4D, 1)):
        file = struct.pack(order + "IHHiIII", magic, 2, 4, 0, 0, 65535, 257)
        for ns, telegram in zip(times(wanted), data):
            file += struct.pack(order + "IIII", 0, int(ns) // unit, len(telegram), len(telegram)) + telegram
        (folder / "classic.pcap").write_bytes(file)
        text = decoded(folder, "classic.pcap")
        expect(f"{order} {magic:X}: telegrams", telegrams(text) == telegrams(wanted), True)
        late = max(abs(a - b) for a, b in zip(times(text), times(wanted)))
        expect(f"{order} {magic:X}: times", late < unit, True)


def rewritten(folder):
    """Files converted by another program: editcap's pcapng and pcap, with today's times."""
    packets, _ = capture(folder, ROOT / "scenarios/dpv1_c1.yaml")
    wanted = decoded(folder, packets)
    first = times(wanted)[0]
    for form in ("pcapng", "nsecpcap"):
        subprocess.run(["editcap", "-F", form, "-t", "1700000000", packets, "other"], cwd=folder, check=True, capture_output=True)
        text = decoded(folder, "other")
        expect(f"{form}: telegrams", telegrams(text) == telegrams(wanted), True)
        start = times(text)[0]
        expect(f"{form}: times", all(abs((a - start) - (b - first)) < 1 for a, b in zip(times(text), times(wanted))), True)


# ------------------------------------------------------------------------------------------------- recordings of the line
def characters_of(text, bits):
    """(ps, level) of the line as the telegrams of a capture were sent: start bit, eight bits, even parity, stop bit."""
    changes = [(0, 1)]
    for start, (data, _) in zip(times(text), telegrams(text)):
        for number, byte in enumerate(bytes.fromhex(data.replace(" ", ""))):
            frame = [0] + [byte >> bit & 1 for bit in range(8)] + [byte.bit_count() & 1, 1]
            for bit, level in enumerate(frame):
                if level != changes[-1][1]:
                    changes.append((int(start * 1000 + (number * 11 + bit) * 1e12 / bits), level))
    return changes


def vcd(changes, end):
    """As a simulator writes it, in units of 10 ps, the line among others."""
    head = ("$timescale 10 ps $end\n$scope module top $end\n$var wire 1 ! clk $end\n$scope module dut $end\n"
            "$var wire 8 \" PBRXD_count $end\n$var wire 1 # PBRXD $end\n$upscope $end\n$upscope $end\n$enddefinitions $end\n")
    return head + "#0\nb0 \"\n0!\n" + "".join(f"#{ps // 10}\n{level}#\n" for ps, level in changes) + f"#{end // 10}\n1!\n"


def saleae(changes, end):
    del end
    return "Time [s],Channel 0,Channel 1\n" + "".join(f"{ps / 1e12:.9f},0,{level}\n" for ps, level in changes)


def levels(changes, end, rate):
    """Samples at a fixed rate."""
    result = bytearray()
    for (ps, level), (until, _) in zip(changes, changes[1:] + [(end, None)]):
        del ps
        result += bytes([level]) * (int(until * rate / 1e12) - len(result))
    return bytes(result)


def write_sigrok(path, samples, rate):
    """As libsigrok: in pieces, the line is the second of two channels."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("version", "2")
        archive.writestr("metadata", "[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\ntotal probes=2\n"
                         f"samplerate={rate}\ntotal analog=0\nprobe1=clock\nprobe2=RxD\nunitsize=1\n")
        size = len(samples) // 3 + 1
        for part in range(3):
            archive.writestr(f"logic-1-{part + 1}", bytes(2 * level for level in samples[part * size:(part + 1) * size]))


def write_old_sigrok(path, samples, rate):
    """As libsigrok 0.1: blanks around the sign, all samples in one piece."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("version", "1")
        archive.writestr("metadata", "[global]\nsigrok version = 0.1.0\n[device 1]\ndriver = fx2lafw\ncapturefile = logic-1\nunitsize = 1\n"
                         f"total probes = 2\nsamplerate = {rate / 1e6:g} MHz\nprobe1 = clock\nprobe2 = RxD\n")
        archive.writestr("logic-1", bytes(2 * level for level in samples))


def expect_same(what, got, wanted):
    """A telegram in progress at the end of the run is only in the recording, truncated."""
    count = len(wanted)
    differ = [(a, b) for a, b in zip(got, wanted) if a != b]
    expect(what, (differ[:1], len(got) in (count, count + 1)), ([], True))


def at_rate(folder, name):
    bits = RATES[name]
    scenario = folder / "exchange.yaml"
    scenario.write_text(EXCHANGE.format(baud=name, end=int(30e9 / bits)), encoding="utf-8")
    # At the slow rates the wave of a run holds some 200 MB of pins, and the line is made from the capture.
    wave = folder / "wave.vcd"
    packets, log = capture(folder, scenario, *(["--wave", wave] if bits > 1e6 else []))
    wanted = decoded(folder, packets, status=None)
    changes, end = changes_of(wave) if bits > 1e6 else characters_of(wanted, bits), int(30e9 / bits) * 1_000_000
    inverted = [(ps, 1 - level) for ps, level in changes]
    rate = int(bits * 8)
    (folder / "saleae.csv").write_text(saleae(changes, end), encoding="utf-8")
    (folder / "inverted.csv").write_text(saleae(inverted, end), encoding="utf-8")
    (folder / "simulator.vcd").write_text(vcd(changes, end), encoding="utf-8")
    (folder / "simulator.vcd.gz").write_bytes(gzip.compress((folder / "simulator.vcd").read_bytes()))
    samples = levels(changes, end, rate)
    write_sigrok(folder / "session.sr", samples, rate)
    write_old_sigrok(folder / "old.sr", samples, rate)
    rows = "\n".join(f"{level}" for level in samples)
    (folder / "sigrok.csv").write_text(f"; CSV generated by libsigrok 0.5.2\n; Channels (1/1): D0\nMETA samplerate: {rate}\nlogic\n{rows}\n",
                                       encoding="utf-8")
    for what, options in (("saleae.csv", ["--signal", "Channel 1"]), ("inverted.csv", ["--signal", "Channel 1", "--invert"]),
                          ("session.sr", []), ("simulator.vcd", []), ("sigrok.csv", []), *([("old.sr", []), ("simulator.vcd.gz", [])] if name == "12M" else [])):
        text = decoded(folder, what, *options, status=None)
        expect(f"{name}, {what}: the rate is found", f" at {name}\n" in text, True)
        expect_same(f"{name}, {what}", telegrams(text), telegrams(wanted))
    if bits > 1e6:
        expect_same(f"{name}, wave of the run", telegrams(decoded(folder, wave, status=None)), telegrams(wanted))
    given = decoded(folder, "session.sr", "--baud", name, status=None)
    expect_same(f"{name}, given", telegrams(given), telegrams(wanted))
    expect(f"{name}: something was sent", len(log) > 20, True)


def every_rate(folder):
    """A recording decodes to the same as the capture of the run, at each of the ten rates."""
    for name in RATES:
        at_rate(folder, name)


def by_pipe(folder):
    """Standard input and pipes are read like files."""
    packets, _ = capture(folder, ROOT / "scenarios/read_services.yaml")
    wanted = decoded(folder, packets, status=1)
    for way in (packets.open("rb"), subprocess.PIPE):
        done = subprocess.run([SIM, "decode"], capture_output=True, text=False, check=False,
                              **({"stdin": way} if way != subprocess.PIPE else {"input": packets.read_bytes()}))
        expect("the same", done.stdout.decode() == wanted, True)


def for_programs(folder):
    """--table and --json contain the printed telegrams, valid or not."""
    packets, log = capture(folder, ROOT / "scenarios/read_services.yaml")
    text = decoded(folder, packets, "--table", "all.tsv", "--json", "all.json", status=1)
    wanted = telegrams(text)
    rows = list(csv.DictReader((folder / "all.tsv").open(encoding="utf-8"), delimiter="\t"))
    objects = json.loads((folder / "all.json").read_text(encoding="utf-8"))
    expect("table: bytes", [row["bytes"] for row in rows], [each[0] for each in wanted])
    expect("json: bytes", [each["bytes"] for each in objects], [each[0] for each in wanted])
    expect("json: words, or why not", [each.get("wrong", each.get("words")) for each in objects], [each[1] for each in wanted])
    expect("times", [float(row["at_ns"]) for row in rows], times(text))
    expect("numbers", ([row["number"] for row in rows], [each["number"] for each in objects]),
           ([str(i + 1) for i in range(len(log))], [i + 1 for i in range(len(log))]))
    diagnosis = next(row for row in rows if row["service"] == "Slave_Diag" and row["sa"] == "5")
    expect("a row", {key: diagnosis[key] for key in ("baud", "type", "sa", "da", "fc", "dsap", "ssap", "wrong")},
           {"baud": "3M", "type": "SD2", "sa": "5", "da": "2", "fc": "08", "dsap": "62", "ssap": "60", "wrong": ""})
    expect("something is wrong", any(row["wrong"] for row in rows), True)
    quiet = decoded(folder, packets, "--quiet", "--table", "quiet.tsv", status=1)
    expect("quiet", (quiet, (folder / "quiet.tsv").read_bytes() == (folder / "all.tsv").read_bytes()), ("", True))
    (folder / "cut_off.pcapng").write_bytes(packets.read_bytes()[:-10])
    sim(folder, "decode", "cut_off.pcapng", "--table", "cut_off.tsv", status=2)
    expect("nothing half-written", sorted(path.name for path in folder.glob("cut_off*")), ["cut_off.pcapng"])


def every_form(folder):
    """Text, a log, captures and recordings, each printed, as a table, as JSON, as a capture, and replayed from that."""
    scenario = folder / "exchange.yaml"
    scenario.write_text(EXCHANGE.format(baud="1.5M", end=12_000), encoding="utf-8")
    wave = folder / "wave.vcd"
    packets, log = capture(folder, scenario, "--wave", wave, "--log-whole")
    wanted = telegrams(decoded(folder, packets))
    rows = "".join(f"I ({number}) RX: {each['bytes']}\n" for number, each in enumerate(log))
    (folder / "pasted.txt").write_text(rows, encoding="utf-8")
    (folder / "bytes.txt").write_text(" ".join(each["bytes"] for each in log), encoding="utf-8")
    changes, end = changes_of(wave), 12_000_000_000
    (folder / "saleae.csv").write_text(saleae(changes, end), encoding="utf-8")
    write_sigrok(folder / "session.sr", levels(changes, end, 12_000_000), 12_000_000)
    text, line = ["--baud", "1.5M"], ["--signal", "Channel 1"]
    for file, options in (("pasted.txt", text), ("bytes.txt", text), ("log.jsonl", text), (packets.name, []), ("saleae.csv", line),
                          ("session.sr", []), (wave.name, [])):
        printed = decoded(folder, file, *options, "--table", "t.tsv", "--json", "t.json", "--pcapng", "t.pcapng", status=None)
        expect_same(f"{file}: printed", telegrams(printed), wanted)
        count = len(telegrams(printed))
        table = list(csv.DictReader((folder / "t.tsv").open(encoding="utf-8"), delimiter="\t"))
        expect(f"{file}: table", [(row["bytes"], bool(row["at_ns"])) for row in table], [(each, True) for each, _ in telegrams(printed)])
        expect(f"{file}: JSON", len(json.loads((folder / "t.json").read_text(encoding="utf-8"))), count)
        expect(f"{file}: capture", telegrams(decoded(folder, "t.pcapng", status=None)), telegrams(printed))
        for source, more in (("t.pcapng", []), (file, options)):
            replayed = sim(folder, "replay", source, "--as", "5", *more, "-q", "--json", "r.json", status=0)
            expect(f"{file}: replayed", (replayed.stderr, json.loads((folder / "r.json").read_text(encoding="utf-8"))["equal"]), ("", True))
    expect("text without a rate", sim(folder, "replay", "bytes.txt", "--as", "5", status=2).stderr,
           "bytes.txt: does not say its baud rate, name it with --baud, expected 12M to 9.6k\n")
    expect("no capture without a rate", sim(folder, "decode", "bytes.txt", "-q", "--pcapng", "x.pcapng", status=2).stderr,
           "bytes.txt:1: does not say its baud rate, --pcapng needs it, name it with --baud\n")
    expect("nothing half-written", (folder / "x.pcapng").exists(), False)
    decoded(folder, "bytes.txt", "-q", "--table", "untimed.tsv")
    expect("no rate, no times", {row.split("\t")[1] for row in (folder / "untimed.tsv").read_text(encoding="utf-8").splitlines()[1:]}, {""})


def foreign_tables(folder):
    """Tables of oscilloscopes and of analysers' decoders, after their public descriptions: volts, dates, decimal commas, characters."""
    scenario = folder / "exchange.yaml"
    scenario.write_text(EXCHANGE.format(baud="500k", end=20_000), encoding="utf-8")
    packets, _ = capture(folder, scenario)
    text = decoded(folder, packets)
    wanted = telegrams(text)
    changes, end = characters_of(text, 500_000), 20_000_000_000
    samples = [3.1 - 0.02 * (i % 3) if level else 0.2 + 0.03 * (i % 2) for i, level in enumerate(levels(changes, end, 4_000_000))]
    comma = "".join(f"{i / 4:.2f};{volts:.2f}\n".replace(".", ",") for i, volts in enumerate(samples))
    rows = {"scope.csv": "Time;Channel A\n(us);(V)\n\n" + comma,
            "dates.csv": "Time,line\n" + "".join(
                f"2026-11-29T23:59:{59 + ps // 10**12:02d}.{ps % 10**12 // 1000:09d}Z,{level}\n" for ps, level in changes),
            "sequence.csv": "X,CH1,Start,Increment,\nSequence,Volt,-1.0e-3,2.5e-7,\n" + "".join(
                f"{i},{volts:.2f},,\n" for i, volts in enumerate(samples)),
            "logic1.csv": "Time [s],Value,Parity Error,Framing Error\n", "logic2.csv": "name,type,start_time,duration,data,error\n"}
    for start, (data, _) in zip(times(text), wanted):
        for number, byte in enumerate(data.split()):
            at = start / 1e9 + number * 11 / 500_000
            rows["logic1.csv"] += f"{at:.9f},0x{byte},,\n"
            rows["logic2.csv"] += f'"Async Serial","data",{at:.9f},0.000022,0x{byte},\n'
    for name, table in rows.items():
        (folder / name).write_text(table, encoding="utf-8")
        printed = decoded(folder, name, status=None)
        expect(f"{name}: the rate is found", " at 500k\n" in printed, True)
        expect_same(name, telegrams(printed), wanted)
    wrong = rows["logic1.csv"].splitlines()
    (folder / "wrong.csv").write_text("\n".join([*wrong[:3], wrong[3] + "Error", *wrong[4:]]) + "\n", encoding="utf-8")
    expect("a framing error stays one", "wrong character" in decoded(folder, "wrong.csv", status=1), True)
    (folder / "plant.ptd").write_bytes(bytes(100))
    expect("ProfiTrace", sim(folder, "decode", "plant.ptd", status=2).stderr,
           "plant.ptd: is a message file of ProfiTrace, which is not read, expected its messages exported as text\n")


def archive_of(folder, **members):
    with zipfile.ZipFile(folder / "made.sr", "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name.replace("_", "-"), content)
    return (folder / "made.sr").read_bytes()


def damaged(archive, old, new):
    expect("there is something to be damaged", old in archive, True)
    return archive.replace(old, new)


def metadata(**others):
    keys = {"capturefile": "logic-1", "samplerate": "1 MHz", "unitsize": "1", "probe1": "D0"} | others
    return "[device 1]\n" + "".join(f"{key}={value}\n" for key, value in keys.items())


def bad_files(folder):
    """One line and exit code 2, and no more memory than usual, whatever the file is."""
    packets, _ = capture(folder, ROOT / "scenarios/dpv1_c1.yaml")
    good = packets.read_bytes()
    ethernet = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 1)
    huge = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 257) + struct.pack("<IIII", 0, 0, 2**31, 2**31)
    idle = archive_of(folder, metadata=metadata(), logic_1_1=bytes([1]) * 300_000_000)
    samples = b"\1" * 999
    whole = archive_of(folder, metadata=metadata(), logic_1_1=samples)
    bad = {
        "cut_off.pcapng": (good[:5000], "ends in the middle of a packet, at byte 5000, expected whole packets; it was cut off"),
        "ethernet.pcap": (ethernet, "packets of link type 1, expected 257 (PROFIBUS) and 147 to 162 (USER0 to USER15)"),
        "huge.pcap": (huge, "a packet of 2147483648 bytes before byte 40, expected up to 262144"),
        "header.pcap": (huge[:20], "ends in the middle of a packet, at byte 20, expected whole packets; it was cut off"),
        "no.sr": (b"PK\x03\x04" + bytes(1000), "is no whole ZIP archive, expected a session of sigrok"),
        "other.zip": (archive_of(folder, readme="hello"), "has no metadata, expected a session of sigrok"),
        "empty.sr": (archive_of(folder, metadata=metadata()), "has no samples, expected a session of sigrok"),
        "damaged.sr": (damaged(whole, struct.pack("<I", zlib.crc32(samples)), b"none"), "a member of the archive is damaged, expected"),
        "shorter.sr": (damaged(whole, struct.pack("<I", len(samples)), struct.pack("<I", 2000)), "a member of the archive is damaged, expected"),
        "cut_off.sr": (whole[:-30], "is no whole ZIP archive"),
        "rate.sr": (archive_of(folder, metadata=metadata(samplerate="often")), "its metadata has no logic samples"),
        "idle.sr": (idle, "no right telegram at any of the ten baud rates, expected a recording of the line"),
        "cut_off.vcd": (b"$timescale 1 ns $end\n$scope mod", ""),
        "no_wire.vcd": (b"$timescale 1 ns $end\n$enddefinitions $end\n", "no signal of one bit, expected a recording of the line"),
        "cut_off.fst": (b"\0" + (329).to_bytes(8, "big") + bytes(100), ""),
        "binary": (bytes(range(256)) * 4096, ""),
    }
    for name, (content, words) in bad.items():
        (folder / name).write_bytes(content)
        done = subprocess.run(["sh", "-c", f"ulimit -v 600000; exec {SIM} decode {name}"], cwd=folder, capture_output=True,
                              text=True, check=False)
        expect(f"{name}: exit code", done.returncode, 2)
        expect(f"{name}: one line", (done.stderr.count("\n"), done.stderr.startswith(f"{name}: {words}") or words == ""), (1, True))
    expect("an empty file is no telegram", sim(folder, "decode", "/dev/null", status=1).stdout, "no telegram\n")
    endless = subprocess.run(["sh", "-c", f"ulimit -v 600000; exec {SIM} decode /dev/zero"], capture_output=True, text=True, check=False)
    expect("/dev/zero", (endless.returncode, endless.stderr.count("\n")), (2, 1))


CASES = {case.__name__: case for case in (as_the_log, classic, rewritten, every_rate, by_pipe, for_programs, every_form, foreign_tables, bad_files)}

with tempfile.TemporaryDirectory(prefix="dsdpv1_decode_") as folder_name:
    CASES[sys.argv[2]](pathlib.Path(folder_name))
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
