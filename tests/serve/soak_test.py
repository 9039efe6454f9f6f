#!/usr/bin/env python3
"""A soak that is interrupted ends its `serve` and is recorded as interrupted.

    soak_test.py DSDPV1_SIM CASE      CASE: one of the functions below
"""
import os
import signal
import subprocess
import sys
import tempfile
import time

from bench import DEADLINE, HERE, Lines, check

SOAK = "import pathlib, sys, soak; soak.records.HERE = pathlib.Path(sys.argv.pop(1)); sys.exit(soak.main())"


def state_and_parent(pid):
    """None if there is no such process."""
    try:
        with open("/proc/%d/stat" % pid, encoding="ascii") as file:
            state, parent = file.read().rpartition(")")[2].split()[:2]
    except OSError:
        return None
    return state, int(parent)


def children_of(parent):
    seen = {int(name): state_and_parent(int(name)) for name in os.listdir("/proc") if name.isdigit()}
    return [pid for pid, found in seen.items() if found is not None and found[1] == parent]


def is_there(pid):
    """A zombie does not count."""
    found = state_and_parent(pid)
    return found is not None and found[0] != "Z"


def interrupted_by(program, number):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_soak_") as folder:
        soak = subprocess.Popen([sys.executable, "-c", SOAK, folder, os.path.abspath(program), "--record"], cwd=HERE, stdout=subprocess.PIPE)
        serves = []
        try:
            lines = Lines(soak.stdout)
            lines.next(time.monotonic() + DEADLINE)  # the first sample: the soak would run for hours
            serves = children_of(soak.pid)
            check(len(serves) == 1, "it has %d processes" % len(serves))
            soak.send_signal(number)
            soak.wait(DEADLINE)
        finally:
            soak.kill()
            left = [pid for pid in serves if is_there(pid)]
            for pid in left:
                os.kill(pid, signal.SIGKILL)
        check(soak.returncode == 130, "it ended with %d" % soak.returncode)
        check(not left, "serve was still there")
        with open(os.path.join(folder, "soak.tsv"), encoding="utf-8") as file:
            check(file.read().endswith("\tinterrupted\n"), "it is not recorded as interrupted")


def sigint_ends_serve():
    interrupted_by(sys.argv[1], signal.SIGINT)


def sigterm_ends_serve():
    interrupted_by(sys.argv[1], signal.SIGTERM)


if __name__ == "__main__":
    {"sigint_ends_serve": sigint_ends_serve, "sigterm_ends_serve": sigterm_ends_serve}[sys.argv[2]]()
