"""Clang's ThreadSanitizer for everything with threads: lockstep campaigns, whose cases run in parallel in model and RTL, and the C API, where
each chip may have its own thread.

`serve`, `sweep` and `regress` have none: they wait for descriptors and start processes.
"""
import os
import pathlib
import re
import subprocess
import tempfile

BUILD = pathlib.Path(__file__).resolve().parents[2] / "build" / "threads"
SIM = BUILD / "apps" / "dsdpv1-sim"
CASES = (
    ("C API, two chips in two threads", (BUILD / "tests" / "capi" / "capi_test", "--gtest_filter=CapiChip.ChipsInTwoThreadsDoWhatEachDoesAlone")),
    ("random lockstep in three threads", (SIM, "rtl-random", "--cycles", "300000", "--jobs", "3", "--seed", "1")),
    ("random lockstep by SPI in three threads", (SIM, "rtl-random", "--chip", "dsdpv1_rsu", "--mode", "spi", "--cycles", "100000", "--jobs", "3")),
)


def check(tell):
    """Each case: `tell(name, reports, words, seconds)`."""
    for name, words in CASES:
        with tempfile.TemporaryDirectory(prefix="dsdpv1_threads_") as folder:
            result = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False,
                                    env={**os.environ, "TSAN_OPTIONS": "exitcode=66 history_size=4"})
        reports = re.findall(r"^WARNING: ThreadSanitizer: (.*)$", result.stderr, re.M)
        right = result.returncode in (0, 66)
        said = "; ".join(reports[:3]) or ("" if right else f"exit {result.returncode}: {result.stderr.strip()[-300:]}")
        tell(name, len(reports) if right else None, said, 0)
