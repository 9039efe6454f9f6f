#!/usr/bin/env python3
"""The serial ports of a DSDPV1-RSU in an unmodified wave, decoded by sigrok-cli: SPI at three clocks, the UART at its eight rates. It finds no
fault, and the bytes match the telegrams in the log.

usage: sigrok_ports_test.py DSDPV1_SIM"""
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile

PICOSECONDS = 10**12
CLOCKS_KHZ = (9000, 4500, 250)
RATES = {"9.6k": 9_600, "19.2k": 19_200, "38.4k": 38_400, "57.6k": 57_600, "115.2k": 115_200, "230.4k": 230_400, "460.8k": 460_800, "1.8432M": 1_843_200}
SAMPLES_A_BIT = 32
# Read, write, and the port's own command; then an error, one for the other card, and an invalid one: all with valid characters.
SPI = ("01 00 14 01", "21 00 20 03 00 55 FF", "41 02 AA 0F", "01 08 14 01", "02 00 14 01", "61 00 14 01")
UART = ("01 00 04 01", "21 00 20 03 00 55 FF", "41 00 01 30 02 01 AA", "01 08 04 01", "02 00 04 01", "61 00 04 01")


def run(program, mode, user, telegrams, end_us, pins, folder):
    """The wave, and the telegrams of the log: whether it is a reply, and its bytes."""
    wave, log, scenario = folder / "w.vcd", folder / "l.jsonl", folder / "s.yaml"
    script = [{"at": "100us", "do": "host_telegram", "slave": "card", "bytes": each} for each in telegrams]
    scenario.write_text(json.dumps({"name": "A serial port", "baud": "12M", "end": f"{end_us:.0f}us", "chip": {"kind": "dsdpv1_rsu", **mode},
                                    "slaves": [{"name": "card", "address": 5, "init": {"ident": 1, "max_inputs": 2, "max_outputs": 2, "cfg": [0x31]},
                                                "user_cpu": {"start_delay": "10s", **user}}],
                                    "script": script, "allow": [{"event": "SPI_NO_CLAIM"}]}), encoding="utf-8")
    signals = [word for pin in pins for word in ("--wave-signals", f"card.{pin}")]
    done = subprocess.run([program, "run", scenario, "--quiet", "--no-progress", "--wave", wave, "--wave-wires", *signals, "--log", log, "--checks", "off"],
                          check=False)
    assert done.returncode == 3, done.returncode  # disturbed telegrams are intended, and the bus is empty
    lines = [json.loads(line) for line in log.read_text(encoding="utf-8").splitlines()]
    return wave, [(line["text"].startswith(("reply", "error", "refused")), line["bytes"].split()) for line in lines if line["kind"] == "host"]


def decoded(wave, ps_a_sample, decoder, rows):
    """The content of these rows in sigrok, and its warnings."""
    command = ["sigrok-cli", "-i", wave, "-I", f"vcd:downsample={ps_a_sample}", "-P", decoder, "-A", decoder.split(":")[0]]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    lines = [line.split(": ", 1)[1] for line in done.stdout.splitlines()]
    wrong = [line for line in lines if "error" in line.lower() or "warning" in line.lower() or "!" in line] + done.stderr.splitlines()
    found = []
    for row in rows:
        command[-1] = f"{decoder.split(':')[0]}={row}"
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        found.append([line.split(": ", 1)[1].split() for line in done.stdout.splitlines()])
    return found, wrong


def spi_faults(program, khz):
    with tempfile.TemporaryDirectory() as name:
        bits = 8 * sum(len(each.split()) + 12 for each in SPI)
        wave, telegrams = run(program, {"mode": "spi"}, {"spi": {"clock": khz}}, SPI, 150 + 1000 * bits / khz, ("XSS", "SCK", "MOSI", "MISO"),
                              pathlib.Path(name))
        (frames, answers), wrong = decoded(wave, PICOSECONDS // (khz * 1000 * SAMPLES_A_BIT), "spi:clk=SCK:mosi=MOSI:miso=MISO:cs=XSS",
                                           ("mosi-transfer", "miso-transfer"))
    requests = [data for is_reply, data in telegrams if not is_reply]
    if len(requests) != len(SPI) or [frame[:len(data)] for frame, data in zip(frames, requests)] != requests or len(frames) != len(SPI):
        yield f"requests {requests}, MOSI {frames}"
    replies = iter([data for is_reply, data in telegrams if is_reply])
    for number, (answer, request) in enumerate(zip(answers, requests)):
        # The last two are not for this card: MISO stays FF. Around a reply it is FF as well.
        data = next(replies) if number < len(SPI) - 2 else []
        expected = ["FF"] * len(request) + data
        if answer != expected + ["FF"] * (len(answer) - len(expected)):
            yield f"reply {data}, MISO {answer} of {request}"
    yield from wrong


def uart_faults(program, rate):
    with tempfile.TemporaryDirectory() as name:
        characters = sum(len(each.split()) + 2 + 16 for each in UART)
        wave, telegrams = run(program, {"mode": "uart", "uart_rate": rate}, {}, UART, 150 + 11e6 * characters / RATES[rate], ("RXD", "TXD"),
                              pathlib.Path(name))
        rows, wrong = decoded(wave, PICOSECONDS // (RATES[rate] * SAMPLES_A_BIT), f"uart:rx=RXD:tx=TXD:baudrate={RATES[rate]}:parity=even:format=hex",
                              ("rx-data", "tx-data"))
    for what, row in zip((False, True), rows):
        logged = [byte for is_reply, data in telegrams if is_reply == what for byte in data]
        if len(logged) < 20 or [byte for shown in row for byte in shown] != logged:
            yield f"{'replies' if what else 'requests'} {logged}, sigrok {row}"
    yield from wrong


def main(program):
    ports = [(f"SPI at {khz} kHz", spi_faults, khz) for khz in CLOCKS_KHZ] + [(f"UART at {rate}Bd", uart_faults, rate) for rate in RATES]
    with concurrent.futures.ThreadPoolExecutor() as pool:
        faults = list(pool.map(lambda port: list(port[1](program, port[2])), ports))
    for (name, _, _), found in zip(ports, faults):
        print(f"{name}: {'as in the log' if not found else found[:3]}")
    return 1 if any(faults) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
