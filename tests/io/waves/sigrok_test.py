#!/usr/bin/env python3
"""A wave as it is, decoded by sigrok-cli at all ten rates: its bytes are those of the log.

usage: sigrok_test.py DSDPV1_SIM"""
import json
import pathlib
import subprocess
import sys
import tempfile

SLAVE = {"name": "demo", "address": 5, "init": {"ident": 0x0CC9, "max_inputs": 8, "max_outputs": 8, "max_prm": 10, "max_cfg": 1, "cfg": [0x37]}}
MASTER = {"name": "plc", "address": 2, "slaves": [{"slave": "demo"}]}
# Rate, its bit/s for sigrok, and the time until some telegrams have been sent.
RATES = (("12M", 12_000_000, "3ms"), ("6M", 6_000_000, "4ms"), ("3M", 3_000_000, "5ms"), ("1.5M", 1_500_000, "8ms"), ("500k", 500_000, "20ms"),
         ("187.5k", 187_500, "30ms"), ("93.75k", 93_750, "60ms"), ("45.45k", 45_455, "180ms"), ("19.2k", 19_200, "120ms"), ("9.6k", 9_600, "180ms"))
PICOSECONDS = 10**12
SAMPLES_A_BIT = 64


def run(program, rate, end, folder):
    """The wave and the bytes of all telegrams that had ended."""
    wave, log, scenario = folder / "w.vcd", folder / "l.jsonl", folder / "s.yaml"
    scenario.write_text(json.dumps({"name": "One slave", "baud": rate, "end": end, "slaves": [SLAVE], "masters": [MASTER], "expect": "none"}), encoding="utf-8")
    done = subprocess.run([program, "run", scenario, "--quiet", "--no-progress", "--wave", wave, "--wave-wires", "--log", log, "--log-whole"], check=False)
    assert done.returncode in (0, 3), done.returncode  # some are over before there is data exchange
    lines = [json.loads(line) for line in log.read_text(encoding="utf-8").splitlines()]
    return wave, [byte for line in lines if line["kind"] == "telegram" for byte in line["bytes"].split()]


def decoded(wave, bits):
    """The bytes that sigrok reads from the line, and its warnings."""
    command = ["sigrok-cli", "-i", wave, "-I", f"vcd:downsample={PICOSECONDS // (bits * SAMPLES_A_BIT)}", "-P",
               f"uart:rx=line:baudrate={bits}:parity=even:format=hex", "-A", "uart"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    words = [line.split(": ", 1)[1] for line in done.stdout.splitlines()]
    wrong = [word for word in words if "error" in word.lower()]
    return [word for word in words if len(word) == 2 and all(c in "0123456789ABCDEF" for c in word)], wrong + done.stderr.splitlines()


def main(program):
    failures = []
    for rate, bits, end in RATES:
        with tempfile.TemporaryDirectory() as name:
            wave, expected = run(program, rate, end, pathlib.Path(name))
            found, wrong = decoded(wave, bits)
        # A telegram that the end of the run cuts is on the line, but not in the log.
        if len(expected) < 20 or found[:len(expected)] != expected or len(found) > len(expected) + 260 or wrong:
            failures.append(f"{rate}: log {expected[:40]} ({len(expected)}), sigrok {found[:40]} ({len(found)}) {wrong[:3]}")
        print(f"{rate}: {len(expected)} bytes")
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
