#!/usr/bin/env python3
"""The example in docs/calibrate.md matches the output of dsdpv1-sim for a capture made as described there.

    docs_example.py SIM            fails if it differs
    docs_example.py SIM --write    writes it
"""
import pathlib
import subprocess
import sys

import analyser

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs"))
from shown import ROOT, check

SCENARIO = """
name: A board whose chip is not quite the model's
baud: 12M
end: 20ms
chip: {rts_lead: 6, access_interval: 50}
slaves:
  - name: board
    address: 5
    gsd: %s/scenarios/dsdpv1.gsd
    modules: ["8 bytes in, 8 bytes out"]
    user_cpu: {behaviour: loop_back, cycle: 57us}
    release_reset: 20us
masters:
  - {name: plc, address: 2, start: 500us, bus: {min_slave_interval: 0}, slaves: [{slave: board}]}
"""
CHANNELS = ["PBRXD", "PBTXD", "PBRTS", "L_REQ", "L_STA", "R_REQ", "R_STA", "INTR0"]


def prepare(sim, folder):
    """Eight channels at 24 MS/s; an answer comes 300 ns late, and the analyser's crystal is slow by 60 ppm."""
    (folder / "board.yaml").write_text(SCENARIO % ROOT, encoding="utf-8")
    subprocess.run([sim, "run", "board.yaml", "-q", "--wave", "board.vcd"], cwd=folder, check=True)
    pins, end = analyser.read_wave(folder / "board.vcd", "board")
    pins = analyser.only(pins, CHANNELS)
    begin = next(at for at in pins["PBRTS"][1] if at > 9_000_000_000 and analyser.level_at(pins["PBRTS"], at))
    finish = next(at for at in pins["PBRTS"][1] if at > begin)
    for pin in ("PBTXD", "PBRTS", "PBRXD"):
        first, edges = pins[pin]
        pins[pin] = first, [at + 300_000 if begin <= at <= finish else at for at in edges]
    sampled, count = analyser.sample(pins, end, 24e6, ppm=-60, jitter_ns=2)
    analyser.write_sigrok(folder / "board.sr", sampled, count, 24e6)


check("docs/calibrate.md", "calibrate", prepare, ["calibrate"])
