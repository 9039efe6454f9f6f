#!/usr/bin/env python3
"""`dsdpv1-sim replay` on captures of runs, as they are and with planted differences.

    replay_test.py SIM CASE
"""
import csv
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile

import pcapng

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "capture"))
from vcd_line import changes_of

SIM = str(pathlib.Path(sys.argv[1]).resolve())
ROOT = pathlib.Path(__file__).resolve().parents[3]
# The windows of the search are short, so that slow rates are found soon. The inputs change with nearly every exchange.
SCENARIO = """
name: Start-up and exchange
baud: {baud}
end: {end}us
chip: {{search_window_ms: 1}}
slaves:
  - name: demo
    address: 5
    init: {{ident: 0x1234, max_inputs: 4, max_outputs: 4, cfg: "33"}}
    user_cpu: {{behaviour: {behaviour}, cycle: {cycle}us}}
masters:
  - {{name: plc, address: 2, start: 100us, bus: {{min_slave_interval: {interval}}}, slaves: [{{slave: demo, outputs: "01 02 03 04"}}]}}
"""
DIAGNOSIS = """
script:
  - {{at: {half}us, do: set_diagnosis, slave: demo, type: external, bytes: "03 A5 5A"}}
"""
# Outputs come back as inputs, each 300 us.
SLOW_LOOP = """name: loop
baud: 12M
end: 12ms
masters: [{{name: plc, slaves: [{{slave: a, outputs: 01 02 03 04}}]}}]
slaves: [{{name: a, address: 5, init: {{ident: 0x0B0D, max_inputs: 4, max_outputs: 4, cfg: 13 23}}, user_cpu: {{cycle: 300us, start_delay: {delay}us}}}}]
script: [{{at: 9ms, do: set_outputs, slave: a, bytes: 11 22 33 44}}]
"""

failures = []


def expect(what, got, wanted):
    if got != wanted:
        failures.append(what)
        print(f"{what}:\n  wanted {wanted}\n  got    {got}")


def sim(folder, *arguments, status=0):
    done = subprocess.run([SIM, *map(str, arguments)], cwd=folder, capture_output=True, text=True, check=False)
    if status is not None and done.returncode != status:
        sys.exit(f"dsdpv1-sim {arguments}: exit code {done.returncode} in the place of {status}\n{done.stdout}{done.stderr}")
    return done


def record(folder, baud="12M", behaviour="count", diagnosis=DIAGNOSIS, **outputs):
    """Runs the scenario at the rate and returns its capture. The scenario is kept as run.yaml."""
    bit = 1e6 / pcapng.BITS[baud]
    end = int(max(40000, 30000 * bit))
    cycle = max(40, int(300 * bit))
    text = (SCENARIO + diagnosis).format(baud=baud, end=end, cycle=cycle, interval=max(600, 2 * cycle), half=int(end * 0.7),
                                         behaviour=behaviour)
    (folder / "run.yaml").write_text(text, encoding="utf-8")
    options = [word for name, value in outputs.items() for word in (f"--{name.replace('_', '-')}", value)]
    sim(folder, "run", "run.yaml", "-q", "--no-progress", "--capture", "run.pcapng", *options)
    return folder / "run.pcapng"


def moment_ms(ns):
    """As reports show it: to the nanosecond, or to the microsecond where that is exact."""
    return f"{ns / 1e6:.6f}".removesuffix("000") + " ms"


def replayed(folder, capture, *options, status=0, slave=5):
    """The result as JSON, with the text beside it."""
    done = sim(folder, "replay", capture, "--as", slave, "--json", "replay.json", *options, status=status)
    return json.loads((folder / "replay.json").read_text(encoding="utf-8")), done.stdout


def is_equal(folder, what, capture, *options):
    result, text = replayed(folder, capture, *options, status=None)
    expect(f"{what}: equal", (result["equal"], result["first_difference"], result["unasked"]), (True, None, []))
    expect(f"{what}: most is compared", result["compared"] > 15, True)
    late = result["verdicts"]["the user CPU was not as quick"]
    expect(f"{what}: the user CPU keeps up", late <= result["compared"] // 20, True)
    expect(f"{what}: says so", re.fullmatch(r"EQUAL(, \d+ violations? allowed)?", text.splitlines()[-1]) is not None, True)
    return result


# --- equal ------------------------------------------------------------------------------------------------------------
def analyser_csv(changes, bits, inverted=False, jitter=0.12, seed=1):
    """As a logic analyser exports it, each edge off by up to `jitter` of a bit."""
    shaken, now = random.Random(seed), 0
    rows = ["Time [s],D0,D1"]
    for ps, level in changes:
        now = max(now + 1e-12, ps / 1e12 + shaken.uniform(-jitter, jitter) / bits)
        rows.append(f"{now:.12f},0,{level ^ inverted}")
    return "\n".join(rows) + "\n"


def every_rate(folder):
    """The capture of a run, the wave of its line and a logic analyser's table of it, with jitter: all are equal, at each rate."""
    for baud, bits in pcapng.BITS.items():
        capture = record(folder, baud, wave="line.vcd", wave_signals="bus.line")
        (folder / "line.csv").write_text(analyser_csv(changes_of(folder / "line.vcd"), bits, inverted=True), encoding="utf-8")
        result = is_equal(folder, f"{baud}, telegrams", capture)
        expect(f"{baud}: TSDR of the model", 10.9 <= result["tsdr_bits"]["model"]["min"] <= 11.3, True)
        is_equal(folder, f"{baud}, wave", "line.vcd")
        shaken = is_equal(folder, f"{baud}, analyser", "line.csv", "--signal", "D1", "--invert")
        expect(f"{baud}: the jitter is in the recorded TSDR",
               shaken["tsdr_bits"]["recorded"]["max"] - shaken["tsdr_bits"]["recorded"]["min"] > 0.05, True)


def shipped_scenarios(folder):
    """The model does the same as each slave of each shipped scenario, in the capture of its run. With --scenario it gets the verdicts that the
    script gives."""
    more = {"power_on_12m": [(5, "--gsd", ROOT / "scenarios/dsdpv1.gsd")], "diagnosis": [(5, "--engine", "step")],
            "baud_change": [(5, "--baud", "12M")]}
    more |= {name: [(slave, "--scenario", ROOT / f"scenarios/{name}.yaml") for slave in slaves]
             for name, slaves in {"judging_modes": (7, 10), "spc3_judging": (7, 10)}.items()}
    played = 0
    for file in sorted((ROOT / "scenarios").glob("*.yaml")):
        sim(folder, "run", file, "-q", "--no-progress", "--capture", "run.pcapng", "--result", "run.json")
        slaves = json.loads((folder / "run.json").read_text(encoding="utf-8"))["slaves"]
        if not pcapng.read(folder / "run.pcapng")[1]:
            done = sim(folder, "replay", "run.pcapng", "--as", slaves[0]["address"], status=2)
            expect(file.stem, done.stderr, "run.pcapng: holds no telegram, expected a capture of the line\n")
            continue
        for slave, *options in [(each["address"],) for each in slaves] + more.get(file.stem, []):
            result, _ = replayed(folder, "run.pcapng", *options, slave=slave, status=None)
            counts = result["verdicts"]
            expect(f"{file.stem} {slave} {options}", (result["equal"], result["differences"][:1]), (True, []))
            own = counts["the recorded slave had left data exchange"] + counts["DPV1, the user CPU's own"]
            asked = sum(counts.values()) - counts["before the recorded slave answered"]
            expect(f"{file.stem} {slave}: most is compared", result["compared"] + own >= 0.7 * asked, True)
            played += 1
    expect("slaves", played > 45, True)


def coarse_times(folder):
    """pcap has no rate and may have microseconds only: less exact than the bus, which is reported."""
    _, packets = pcapng.read(record(folder, "500k"))
    pcapng.classic(folder / "ns.pcap", packets, 1)
    pcapng.classic(folder / "us.pcap", packets, 1000)
    is_equal(folder, "nanoseconds", "ns.pcap", "--baud", "500k")
    result, text = replayed(folder, "us.pcap", "--baud", "500k")
    expect("microseconds: unit", result["resolution_ns"], 1000)
    expect("microseconds: said", "whole multiples of 1us, 0.5 bit times" in text, True)
    missing = sim(folder, "replay", "us.pcap", "--as", "5", status=2)
    expect("no rate", missing.stderr, "us.pcap: does not say its baud rate, name it with --baud, expected 12M to 9.6k\n")


def logs(folder):
    """A log with all bytes can be played; one that is cut, or has no rate, ends in one line."""
    record(folder, "1.5M", log="run.jsonl")
    is_equal(folder, "JSON lines", "run.jsonl", "--baud", "1.5M")
    text = sim(folder, "run", "run.yaml", "-q", "--no-progress", "--log", "whole.log", "--log-whole")
    expect("nothing is said", text.stdout, "")
    is_equal(folder, "text", "whole.log", "--baud", "1.5M")
    expect("no rate", sim(folder, "replay", "run.jsonl", "--as", "5", status=2).stderr,
           "run.jsonl: does not say its baud rate, name it with --baud, expected 12M to 9.6k\n")
    (folder / "cut.log").write_text("   1.000 ns  bus  telegram  words  68 05 ... (49 bytes)\n", encoding="utf-8")
    expect("cut", sim(folder, "replay", "cut.log", "--as", "5", "--baud", "1.5M", status=2).stderr,
           "cut.log:1: has not all bytes, expected a log with all of them (--log-whole, .jsonl)\n")


def reference_rtl(folder):
    """The reference RTL in the model's place answers as it does."""
    capture = record(folder, "1.5M")
    is_equal(folder, "the reference RTL", capture, "--engine", "rtl")
    refused = sim(folder, "replay", capture, "--as", "5", "--engine", "rtl", "--wave", "x.vcd", "--wave-inside", status=2)
    expect("no inside", refused.stderr,
           "dsdpv1-sim replay: --wave-inside is about the model, it needs --engine step or skip\n")


def repetitions(folder, engine="skip"):
    """The scenario's fcb_rule decides about a request with the FCB of the one before but with other bytes (S26)."""
    telegram = 'script: [{at: 20ms, do: telegram, bytes: "68 07 07 68 05 02 5D 09 08 07 06 82 16"}]\n'
    text = SCENARIO.format(baud="12M", end=30000, behaviour="loop_back", cycle=50, interval=600) + telegram
    for rule in ("letter", "content"):
        (folder / f"{rule}.yaml").write_text(text.replace("chip: {", f"chip: {{fcb_rule: {rule}, "), encoding="utf-8")
        sim(folder, "run", f"{rule}.yaml", "--capture", f"{rule}.pcapng", "--quiet")
    for recorded in ("letter", "content"):
        for rule in ("letter", "content"):
            done = sim(folder, "replay", f"{recorded}.pcapng", "--as", "5", "--scenario", f"{rule}.yaml", "--engine", engine, status=None)
            expect(f"{recorded} replayed as {rule}, {engine}", done.returncode, 0 if recorded == rule else 1)


def repetitions_in_rtl(folder):
    repetitions(folder, "rtl")


# --- different --------------------------------------------------------------------------------------------------------
def is_exchange_answer(packet):
    return packet.data[0] == 0x68 and packet.data[4:6] == b"\x02\x05"


def answers(packets):
    return [i for i, packet in enumerate(packets) if is_exchange_answer(packet)]


def planted(folder, plant):
    """The capture at 12 Mbit/s with a change: plant(packets) returns the position of the expected finding."""
    head, packets = pcapng.read(record(folder))
    at = plant(packets)
    pcapng.write(folder / "planted.pcapng", head, packets)
    return at, packets


def first(folder, *options):
    result, text = replayed(folder, "planted.pcapng", *options, status=1)
    expect("says so", text.endswith("\nDIFFERENT\n"), True)
    return result["first_difference"], result, text


def changed_byte(folder):
    """A byte of an answer: which one, and its meaning. The model gets the recorded inputs, so the scenario's user CPU must have others."""
    head, packets = pcapng.read(record(folder, behaviour='constant, constant: "11 22 33 44"', diagnosis=""))
    result, _ = replayed(folder, "run.pcapng", "--scenario", "run.yaml")
    expect("unchanged", (result["equal"], result["compared"] > 30), (True, True))
    at = answers(packets)[30]
    packets[at].change(9, 0x73)
    pcapng.write(folder / "planted.pcapng", head, packets)
    found, result, text = first(folder, "--scenario", "run.yaml")
    expect("where", (found["telegram"], found["at_ns"]), (at, packets[at - 1].ns))
    expect("what", found["why"], "byte 9: recorded 73 (input 2), model 33 (input 2)")
    expect("how often", (result["verdicts"]["other bytes"], len(result["differences"])), (1, 1))
    expect("in words", f"first difference  at {moment_ms(packets[at - 1].ns)}, telegram {at} of the capture: byte 9" in text, True)
    expect("given, it is none", replayed(folder, "planted.pcapng")[0]["equal"], True)


def recorded_inputs(folder):
    """A user CPU that loops back makes inputs at its own time: with the recorded ones it makes none, and its cycle is its pace."""
    scenario = SLOW_LOOP.format(delay=0)
    (folder / "run.yaml").write_text(scenario, encoding="utf-8")
    sim(folder, "run", "run.yaml", "-q", "--no-progress", "--capture", "run.pcapng")
    for delay in (0, 100, 200):
        (folder / "late.yaml").write_text(SLOW_LOOP.format(delay=delay), encoding="utf-8")
        result, text = replayed(folder, "run.pcapng", "--scenario", "late.yaml", "--inputs", "recorded")
        expect(f"{delay} us later", (result["equal"], result["compared"] > 100), (True, True))
    expect("says whose", "the recorded ones" in text, True)
    result, text = replayed(folder, "run.pcapng", "--scenario", "late.yaml", status=1)
    expect("its own, at another time", (result["equal"], "without the script" in text), (False, True))


def missing_answer(folder):
    """An answer that the recorded slave did not give."""
    def plant(packets):
        at = answers(packets)[30]
        del packets[at]
        return at

    at, packets = planted(folder, plant)
    found, result, _ = first(folder)
    expect("where", (found["telegram"], found["at_ns"]), (at, packets[at - 1].ns))
    expect("what", (found["verdict"], found["why"], found["recorded"]), ("unexpected", "only the model answers", None))
    expect("how often", len(result["differences"]), 1)


def answer_without_syn(folder):
    """A request 20 bit times after the last activity: the recorded slave answered it, the chip ignores it (S3)."""
    def plant(packets):
        at = answers(packets)[30]
        before = packets[at - 2]
        moved = packets[at - 1].ns - (before.ns + round((len(before.data) * 11 + 20) * 1e9 / 12e6))
        for packet in packets[at - 1:at + 1]:
            packet.ns -= moved
        return at

    at, packets = planted(folder, plant)
    found, _, _ = first(folder)
    expect("where", (found["telegram"], found["at_ns"]), (at, packets[at - 1].ns))
    expect("what", (found["verdict"], found["why"], found["model"]), ("missing", "the model does not answer", None))


def shifted_answer(folder):
    """By 3 bit times: within the range of TSDR, found with a tolerance. To 5: before min_TSDR, found without one."""
    def shift(bits):
        def plant(packets):
            at = answers(packets)[30]
            packets[at].ns += round(bits * 1e9 / 12e6)
            return at
        return plant

    at, _ = planted(folder, shift(3))
    result, _ = replayed(folder, "planted.pcapng")
    expect("within", result["equal"], True)
    found, _, _ = first(folder, "--tsdr-tolerance", "1")
    expect("where", found["telegram"], at)
    expect("what", (found["verdict"], found["why"]), ("other TSDR", found["why"]))
    expect("numbers", bool(re.match(r"TSDR: recorded 14\.2\d bit times, model 11\.2\d, expected at most 1 apart", found["why"])), True)
    at, _ = planted(folder, shift(-6))
    found, _, _ = first(folder)
    expect("early: where", found["telegram"], at)
    expect("early: numbers",
           bool(re.match(r"TSDR: recorded 5\.2\d bit times, model 11\.2\d, expected min_TSDR 11 to max_TSDR 800", found["why"])), True)


def unlock(folder):
    """A Set_Prm that unlocks the slave does not change its min_TSDR (S17): it still answers after 11 bit times. One with neither Lock nor Unlock
    does (S28)."""
    def again(packet):
        """The same request as the first of a series, so that it is not a repetition (S26)."""
        request = pcapng.Packet(packet.block()[8:-4])
        request.change(6, 0x6D)
        return request

    def at_end(packets, *telegrams):
        """After the last packet, each 60 bit times after the one before, answers 11.2."""
        now = packets[-1].ns + len(packets[-1].data) * 11e9 / 12e6
        for telegram, pause in telegrams:
            packet = pcapng.Packet(telegram.block()[8:-4])
            packet.ns = round(now + pause * 1e9 / 12e6)
            now = packet.ns + len(packet.data) * 11e9 / 12e6
            packets.append(packet)

    def first_to(packets, sap):
        return next(i for i, packet in enumerate(packets) if packet.data[4:6] == b"\x85\x82" and packet.data[7] == sap)

    for lock, verdicts in ((0x40, []), (0x00, ["other TSDR"])):
        head, packets = pcapng.read(record(folder))
        del packets[answers(packets)[-1] + 1:]
        prm, diag = first_to(packets, 61), first_to(packets, 60)
        request = again(packets[prm])
        request.change(9, lock)
        request.change(9 + 3, 100)
        # Unlocked it shows the diagnosis from before the start; with another min_TSDR only it continues to exchange.
        asked, answer = packets[diag:diag + 2] if lock else packets[-2:]
        at_end(packets, (request, 60), (packets[prm + 1], 11.2 if lock else 100.2), (again(asked), 60), (answer, 11.2))
        pcapng.write(folder / "planted.pcapng", head, packets)
        result, _ = replayed(folder, "planted.pcapng", status=None)
        expect(f"Set_Prm with {lock:02X}", [each["verdict"] for each in result["differences"]], verdicts)


def other_ident(folder):
    """A diagnosis with another ident number than the one that the slave was parameterised with."""
    def plant(packets):
        at = next(i for i, packet in enumerate(packets) if packet.data[0] == 0x68 and packet.data[4:6] == b"\x82\x85")
        packets[at].change(9 + 5, 0x35)
        return at

    at, packets = planted(folder, plant)
    found, _, _ = first(folder)
    expect("where", (found["telegram"], found["at_ns"]), (at, packets[at - 1].ns))
    expect("what", found["why"], "byte 14: recorded 35 (Ident_Number low: 0x35), model 34 (Ident_Number low: 0x34)")


# --- what is not compared ---------------------------------------------------------------------------------------------
def in_the_middle(folder):
    """A capture that begins in data exchange: the lead-in brings the model into one. Without it, it is compared from the slave's next
    start on, and where there is none, not at all."""
    head, packets = pcapng.read(record(folder))
    middle = packets[answers(packets)[5] - 1:]
    pcapng.write(folder / "middle.pcapng", head, middle)
    result, text = replayed(folder, "middle.pcapng")
    expect("with the lead-in: equal", (result["equal"], result["parameterised_by_lead_in"]), (True, True))
    expect("with the lead-in: all of it", result["verdicts"]["equal"] >= len(answers(middle)) - 1, True)
    expect("with the lead-in: said", "with a Set_Prm and Chk_Cfg of its own" in text, True)
    at = answers(middle)[20]
    silent = middle[:at] + middle[at + 1:]
    pcapng.write(folder / "planted.pcapng", head, silent)
    expect("with the lead-in: a difference is found", first(folder)[0]["telegram"], at)
    alone = sim(folder, "replay", "middle.pcapng", "--as", "5", "--no-lead-in", status=2)
    expect("nothing to compare", alone.stderr,
           "middle.pcapng: station 5 is in data exchange where it begins, and no Set_Prm and Chk_Cfg follow, so that nothing can be "
           "compared without the lead-in, expected a capture with them\n")
    later = max(packet.ns for packet in middle) + 60_000_000  # time to find the rate, 12M
    again = [pcapng.Packet(packet.block()[8:-4]) for packet in packets]
    for packet in again:
        packet.ns += later - packets[0].ns
    pcapng.write(folder / "both.pcapng", head, middle + again)
    result, _ = replayed(folder, "both.pcapng", "--no-lead-in")
    before = len(answers(middle))
    expect("the first part is not", result["verdicts"]["before the slave is parameterised"] >= before, True)
    expect("the second is", (result["equal"], result["compared"] > 30), (True, True))


def old_faults(folder):
    """Fault bits from before the capture do not count until the Set_Prm or Chk_Cfg that sets them, and are reported."""
    def is_diagnosis(packet):
        return len(packet.data) > 9 and packet.data[7:9] == bytes([62, 60]) and packet.data[5] & 0x7F == 5

    def service(packet):
        return packet.data[7] if len(packet.data) > 9 and packet.data[5] & 0x7F == 2 else None

    head, packets = pcapng.read(record(folder))
    prm = next(i for i, packet in enumerate(packets) if service(packet) == 61)
    cfg = next(i for i, packet in enumerate(packets) if service(packet) == 62)
    for bit, sets in ((0x40, prm), (0x10, prm), (0x04, cfg)):
        early = [pcapng.Packet(packet.block()[8:-4]) for packet in packets]
        changed = [packet for packet in early[:sets] if is_diagnosis(packet)]
        for packet in changed:
            packet.change(9, packet.data[9] | bit)
        pcapng.write(folder / "early.pcapng", head, early)
        result, text = replayed(folder, "early.pcapng")
        expect(f"{bit:02X} before", (len(changed) > 0, result["equal"], result["verdicts"]["faults from before the capture"] > 0),
               (True, True, True))
        expect(f"{bit:02X} before: said", "faults from before the capture" in text, True)
        late = next(i for i, packet in enumerate(packets) if i > cfg and is_diagnosis(packet))
        packets[late].change(9, packets[late].data[9] | bit)
        pcapng.write(folder / "late.pcapng", head, packets)
        result, _ = replayed(folder, "late.pcapng", status=1)
        expect(f"{bit:02X} after", (result["equal"], result["differences"][0]["telegram"]), (False, late))
        packets[late].change(9, packets[late].data[9] & ~bit)


def without_lead_in(folder):
    """The model then searches the rate in the capture: what it misses is counted, and nothing is called a difference."""
    capture = record(folder, "500k")
    result, text = replayed(folder, capture, "--no-lead-in", status=3)
    expect("it searches from 12M down, 50 ms each, and the capture lasts 60", result["verdicts"]["before the model has the baud rate"] > 30, True)
    expect("that is no difference", (result["differences"], result["compared"]), ([], 0))
    expect("it is said", (result["lead_in_ns"] < 700_000, text.endswith("\nNOTHING JUDGED: nothing could be compared\n")), (True, True))
    expect("with it, there is none", replayed(folder, capture)[0]["verdicts"]["before the model has the baud rate"], 0)


def window(folder):
    """Only differences in the window count."""
    def plant(packets):
        at = answers(packets)[30]
        del packets[at]
        return at

    at, packets = planted(folder, plant)
    us = packets[at - 1].ns / 1000
    replayed(folder, "planted.pcapng", "--to", f"{us - 1:.0f}us", status=0)
    replayed(folder, "planted.pcapng", "--from", f"{us + 50:.0f}us", status=0)
    replayed(folder, "planted.pcapng", "--from", f"{us - 50:.0f}us", "--to", f"{us + 50:.0f}us", status=1)
    nothing, text = replayed(folder, "planted.pcapng", "--from", "3000s", status=3)
    expect("nothing is not equal", (nothing["compared"], text.endswith("\nNOTHING JUDGED: nothing could be compared\n")), (0, True))


def outputs(folder):
    """Table, log, wave with its save files, capture and result of a replay; the table has a row for each request, and the verdicts add up."""
    capture = record(folder)
    result, _ = replayed(folder, capture, "--table", "replay.tsv", "--log", "replay.log", "--wave", "replay.fst", "--wave-save", "--result", "result.json",
                         "--capture", "replay.pcapng")
    rows = list(csv.DictReader((folder / "replay.tsv").open(encoding="utf-8"), delimiter="\t"))
    expect("rows", len(rows), sum(result["verdicts"].values()))
    expect("equal rows", sum(row["verdict"] == "equal" for row in rows), result["verdicts"]["equal"])
    expect("both answers", all(row["recorded"] == row["model"] for row in rows if row["verdict"] == "equal"), True)
    # A capture of the replay's line, replayed: additionally the lead-in, which requires no answer.
    is_equal(folder, "again", "replay.pcapng")
    expect("written", sorted(path.name for path in folder.glob("re*")),
           ["replay.fst", "replay.gtkw", "replay.json", "replay.log", "replay.pcapng", "replay.sucl", "replay.tsv", "result.json"])
    clash = sim(folder, "replay", capture, "--as", "5", "--json", "run.pcapng", status=2)
    expect("an output is no input", clash.stderr,
           "dsdpv1-sim replay: --json would replace the capture, run.pcapng, expected a separate file\n")


CASES = {case.__name__: case for case in (every_rate, shipped_scenarios, coarse_times, logs, reference_rtl, repetitions, repetitions_in_rtl, changed_byte, recorded_inputs,
                                          missing_answer, answer_without_syn, shifted_answer, unlock, other_ident, in_the_middle, old_faults, without_lead_in, window, outputs)}

with tempfile.TemporaryDirectory(prefix="dsdpv1_replay_") as folder_name:
    CASES[sys.argv[2]](pathlib.Path(folder_name))
print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
