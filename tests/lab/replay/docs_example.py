#!/usr/bin/env python3
"""The examples in docs/replay.md match the output of dsdpv1-sim.

    docs_example.py SIM            fails if they differ
    docs_example.py SIM --write    writes them
"""
import pathlib
import subprocess
import sys

import pcapng

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs"))
from shown import ROOT, check


def prepare(sim, folder):
    subprocess.run([sim, "run", ROOT / "scenarios/diagnosis.yaml", "--quiet", "--no-progress", "--capture", "plant.pcapng"], cwd=folder, check=True)
    head, packets = pcapng.read(folder / "plant.pcapng")
    answers = [i for i, packet in enumerate(packets) if packet.data[0] == 0x68 and packet.data[4:6] == b"\x02\x05"]
    del packets[answers[40]]
    pcapng.write(folder / "silent.pcapng", head, packets)


check("docs/replay.md", "replay", prepare)
