#!/usr/bin/env python3
"""GTKWave, without a screen, opens waves with the save files written by --wave-save: it shows every signal that the file names, in its order, and
all signals of the wave.

    gtkwave_test.py SIM
"""
import pathlib
import re
import subprocess
import sys
import tempfile

SCENARIOS = pathlib.Path(__file__).resolve().parents[3] / "scenarios"
# Traces as they are shown, one a line; then names of all signals of the wave.
ASK = """puts "\\n"
for {set i 0} {$i < [gtkwave::getTotalNumTraces]} {incr i} { puts "SHOWN [gtkwave::getTraceNameFromIndex $i]" }
for {set i 0} {$i < [gtkwave::getNumFacs]} {incr i} { puts "HAS [gtkwave::getFacName $i]" }
exit
"""


def rows(save_file):
    """The lines that are shown: -TITLE, or the path of a signal."""
    return [line for line in save_file.read_text(encoding="utf-8").splitlines() if line[:1] not in "[@*"]


def as_shown(row):
    """In GTKWave's column of names."""
    return row[1:] if row.startswith("-") else row.rpartition(".")[2]


def faults(sim, folder, scenario, ending):
    wave = folder / f"w.{ending}"
    subprocess.run([sim, "run", SCENARIOS / f"{scenario}.yaml", "--quiet", "--wave", wave, "--wave-to", "50us", "--wave-inside", "--wave-clk", "--wave-save"], check=True)
    (folder / "ask.tcl").write_text(ASK, encoding="utf-8")
    save_file = wave.with_suffix(".gtkw")
    said = subprocess.run(["xvfb-run", "-a", "gtkwave", "--script", folder / "ask.tcl", wave, save_file], check=True, text=True,
                          capture_output=True, timeout=240).stdout
    shown, has = re.findall(r"^SHOWN (.*)$", said, re.M), re.findall(r"^HAS (.*)$", said, re.M)
    names = [row for row in rows(save_file) if not row.startswith("-")]
    if shown != [as_shown(row) for row in rows(save_file)]:
        yield f"{scenario}, {ending}: GTKWave shows {shown}, the save file has {rows(save_file)}"
    if sorted(names) != sorted(has) or len(has) < 40:
        yield f"{scenario}, {ending}: the wave has {has}, the save file names {names}"
    surfer = re.findall(r"^variable_add (.*)$", wave.with_suffix(".sucl").read_text(encoding="utf-8"), re.M)
    if surfer != [re.sub(r"\[.*", "", name) for name in names]:
        yield f"{scenario}, {ending}: the command file for Surfer names {surfer}, that for GTKWave {names}"


def main():
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for scenario, ending in (("power_on_12m", "vcd"), ("power_on_12m", "fst"), ("rsu_spi", "fst")):
            found += faults(sys.argv[1], pathlib.Path(folder), scenario, ending)
    print("\n".join(found) or "all signals are shown")
    return 1 if found else 0


sys.exit(main())
