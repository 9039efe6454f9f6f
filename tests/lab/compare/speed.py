#!/usr/bin/env python3
"""How long compare takes for large files, and how much memory.

    speed.py SIM [MEGABYTES]    measures, by default 1000 MB as VCD against a copy of itself
    speed.py SIM --check        60 MB; fails when 1000 MB would take more than a minute of processor time, or with 200 MB of memory

Processor time, not that of the wall: other work on the machine does not count.
"""
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
MOST_SECONDS, MOST_MEGABYTES = 60, 200


def measure(sim, megabytes):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_speed_") as name:
        wave = pathlib.Path(name, "large.vcd")
        subprocess.run([sys.executable, "-B", HERE / "large_vcd.py", wave, str(megabytes)], check=True)
        before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        subprocess.run([sim, "compare", wave, wave, "--quiet"], check=True)
        after, wall = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic() - begin
        processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return wave.stat().st_size / 1e6, wall, processor, after.ru_maxrss / 1024


def main():
    check = sys.argv[2:] == ["--check"]
    megabytes = 60 if check else int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    size, wall, processor, memory = measure(sys.argv[1], megabytes)
    print(f"{size:.0f} MB against {size:.0f} MB: {wall:.1f} s, {processor:.1f} s of processor time, {memory:.0f} MB of memory")
    print(f"1000 MB: {processor * 1000 / size:.1f} s of processor time")
    sys.exit(1 if check and (processor * 1000 / size > MOST_SECONDS or memory > MOST_MEGABYTES) else 0)


main()
