#!/usr/bin/env python3
"""What docs/replay.md shows is what dsdpv1-sim prints.

    docs_example.py SIM            fails when it is something else
    docs_example.py SIM --write    writes it
"""
import pathlib
import re
import subprocess
import sys
import tempfile

import pcapng

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/replay.md"
SHOWN = re.compile(r"(<!-- replay: ([^\n]*) -->\n```\n)(.*?)(```)", re.S)


def prepare(sim, folder):
    subprocess.run([sim, "run", ROOT / "scenarios/diagnosis.yaml", "--quiet", "--no-progress", "--capture", "plant.pcapng"], cwd=folder, check=True)
    head, packets = pcapng.read(folder / "plant.pcapng")
    answers = [i for i, packet in enumerate(packets) if packet.data[0] == 0x68 and packet.data[4:6] == b"\x02\x05"]
    del packets[answers[40]]
    pcapng.write(folder / "silent.pcapng", head, packets)


def main():
    sim, write = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:] == ["--write"]
    with tempfile.TemporaryDirectory(prefix="dsdpv1_replay_page_") as name:
        folder = pathlib.Path(name)
        prepare(sim, folder)

        def real(shown):
            done = subprocess.run([sim, *shown.group(2).split()], cwd=folder, capture_output=True, text=True, check=False)
            return shown.group(1) + done.stdout + done.stderr + shown.group(4)

        page = PAGE.read_text(encoding="utf-8")
        right = SHOWN.sub(real, page)
    if write:
        PAGE.write_text(right, encoding="utf-8")
    elif right != page:
        sys.exit(f"docs/replay.md shows something else than\n{right}")


main()
