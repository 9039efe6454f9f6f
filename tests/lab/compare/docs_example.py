#!/usr/bin/env python3
"""The examples in docs/compare.md match the output of dsdpv1-sim.

    docs_example.py SIM            fails if they differ
    docs_example.py SIM --write    writes them
"""
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs"))
from shown import ROOT, check

SCENARIO = """
name: Up to the first parameters
baud: 12M
end: 1700us
slaves:
  - name: demo
    address: 5
    gsd: %s/scenarios/dsdpv1.gsd
    modules: ["8 bytes in, 8 bytes out"]
    init: {prm_mode: 2, cfg_mode: 2}
    user_cpu: {behaviour: loop_back, cycle: 40us, judge_delay: 5us}
    release_reset: 20us
masters:
  - {name: plc, address: 2, start: 500us, bus: {min_slave_interval: 0}, slaves: [{slave: demo}]}
"""
CYCLE = 20833  # ps


def late_interrupt(vcd):
    """The wave with a defect: INTR0 falls a cycle late."""
    code = re.search(r"\$var wire 1 (\S+) INTR0 ", vcd).group(1)
    head, falls, rest = vcd.rpartition(f"\n0{code}\n")
    at = int(head.rpartition("\n#")[2].split()[0])
    following = re.search(r"^#(\d+)\n", rest, re.M)
    while int(following.group(1)) < at + CYCLE:
        following = re.compile(r"^#(\d+)\n", re.M).search(rest, following.end())
    begin = rest[:following.start()]
    same = following.group() if int(following.group(1)) == at + CYCLE else f"#{at + CYCLE}\n"
    return f"{head}\n{begin}{same}{falls[1:]}{rest[following.start():].removeprefix(same)}"


def prepare(sim, folder):
    (folder / "short.yaml").write_text(SCENARIO % ROOT, encoding="utf-8")
    for wave in ("model.fst", "model.vcd"):
        subprocess.run([sim, "run", "short.yaml", "--quiet", "--wave", wave], cwd=folder, check=True)
    (folder / "tonight.vcd").write_text(late_interrupt((folder / "model.vcd").read_text(encoding="utf-8")), encoding="utf-8")


check("docs/compare.md", "compare", prepare, ["compare"])
