#!/usr/bin/env python3
"""Measures the time and memory that compare needs for large files.

    speed.py SIM [MEGABYTES]    measures, by default 1000 MB as VCD compared with a copy of itself
    speed.py SIM --check        fails if 60 MB need more memory than 6 MB

The row compare of ./run bench --instructions judges its speed.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
MOST_MEGABYTES = 10  # that ten times the length may need in addition


def measure(sim, megabytes):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_speed_") as name:
        wave = pathlib.Path(name, "large.vcd")
        subprocess.run([sys.executable, "-B", HERE / "large_vcd.py", wave, str(megabytes)], check=True)
        begin = time.monotonic()
        process = subprocess.Popen([sim, "compare", wave, wave, "--quiet"])
        _, status, used = os.wait4(process.pid, 0)
        wall = time.monotonic() - begin
        if status:
            sys.exit(f"compare ended with {os.waitstatus_to_exitcode(status)}")
        memory = used.ru_maxrss / 1024
        print(f"{megabytes} MB against {megabytes} MB: {wall:.1f} s, {used.ru_utime + used.ru_stime:.1f} s of processor time, {memory:.0f} MB of memory")
        return memory


def main():
    sim, words = sys.argv[1], sys.argv[2:]
    if words == ["--check"]:
        sys.exit(0 if measure(sim, 60) < measure(sim, 6) + MOST_MEGABYTES else 1)
    measure(sim, int(words[0]) if words else 1000)


main()
