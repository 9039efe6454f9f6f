#!/usr/bin/env python3
"""Chips of several kinds on one line (scenarios/mixed_chips.yaml) with the commands that run a scenario otherwise.

    mixed_test.py DSDPV1_SIM
"""
import csv
import json
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[4]
ADDRESSES = (3, 5, 7)
PATIENCE_S = 120
FAILURES = []


def expect(what, seen, wanted, said=""):
    if seen != wanted:
        FAILURES.append(f"{what}: {seen} instead of {wanted}\n{said}")


class Program:
    """The scenario without its disturbances, in a separate folder."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        text = (ROOT / "scenarios/mixed_chips.yaml").read_text(encoding="utf-8")
        text = text[:text.index("script:")].replace("gsd: dsdpv1.gsd", f"gsd: {ROOT}/scenarios/dsdpv1.gsd").replace("end: 60ms", "end: 40ms")
        (folder / "x.yaml").write_text(text + "expect:\n  - {slave: valve, dp_state: data_exch}\n", encoding="utf-8")

    def __call__(self, *words):
        done = subprocess.run([self.program, *map(str, words)], cwd=self.folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{words}: exit code {done.returncode}\n{done.stdout[-1500:]}{done.stderr}")
        return done.stdout

    def read(self, name):
        return (self.folder / name).read_text(encoding="utf-8")


def saved(sim):
    """A run that continues from the middle has the log and the result of the whole one."""
    sim("run", "x.yaml", "-q", "--log", "whole.log", "--result", "whole.json", "--capture", "whole.pcapng", "--save-at", "25ms", "kept.run")
    sim("run", "--restore", "kept.run", "-q", "--log", "rest.log", "--result", "rest.json")
    rest = sim.read("rest.log").splitlines()[-200:]
    expect("lines of the log after a restore", (len(rest), rest), (200, sim.read("whole.log").splitlines()[-200:]))
    slaves = [json.loads(sim.read(name))["slaves"] for name in ("whole.json", "rest.json")]
    expect("slaves after a restore", slaves[1], slaves[0])
    expect("data exchange", [each["dp_state"] for each in slaves[0]], ["DATA_EXCH"] * 3)


def replayed(sim):
    """A chip's answers are those of the capture, by the model of its kind. A user CPU that loops back over SPI is in another phase here."""
    for address in (3, 7):
        said = sim("replay", "whole.pcapng", "--as", address, "--scenario", "x.yaml", "--no-progress")
        expect(f"replay as {address}", said.rstrip().rpartition("\n")[2].startswith("EQUAL"), True, said[-800:])


def swept(sim):
    """A parameter of one slave reaches that alone."""
    sim("sweep", "x.yaml", "--param", "slaves.valve.user_cpu.cycle=100us,300us", "--out", "sweep", "--no-progress", "-q", "--jobs", "1")
    quick, slow = csv.DictReader(sim.read("sweep/results.csv").splitlines())
    expect("margins of the DSDPV1-RSU", quick["TIMING_SCK_LOW_margin_ns"], slow["TIMING_SCK_LOW_margin_ns"])
    margins = [float(each["LIVE_OUTPUTS_margin_ns"]) for each in (quick, slow)]
    expect("margin of the APC3 with the quick user is greater", margins[0] > margins[1], True, str(margins))


def status_of(connection, address):
    """The FDL status, asked again until the chip has found the rate."""
    request = bytes([0x10, address, 2, 0x49, (address + 2 + 0x49) & 0xFF, 0x16])
    answer = bytes([0x10, 2, address, 0, 2 + address, 0x16])
    end, heard = time.monotonic() + PATIENCE_S, b""
    while answer not in heard and time.monotonic() < end:
        connection.sendall(request)
        time.sleep(0.02)
        try:
            heard += connection.recv(4096)
        except TimeoutError:
            pass
    return answer in heard


def served(sim):
    """Each kind answers a real master."""
    serve = subprocess.Popen([sim.program, "serve", "x.yaml", "--tcp", "0", "-q"], cwd=sim.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        port = int(re.search(r"127\.0\.0\.1:(\d+)", serve.stdout.readline()).group(1))
        with socket.create_connection(("127.0.0.1", port), timeout=1) as connection:
            connection.settimeout(0.02)
            expect("answers", [status_of(connection, address) for address in ADDRESSES], [True] * 3)
    finally:
        serve.kill()
        serve.communicate()


def main():
    with tempfile.TemporaryDirectory() as folder:
        sim = Program(sys.argv[1], pathlib.Path(folder))
        for part in (saved, replayed, swept, served):
            part(sim)
    print("\n".join(FAILURES))
    return 1 if FAILURES else 0


if __name__ == "__main__":
    sys.exit(main())
