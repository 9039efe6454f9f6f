"""Runs a daemon and collects its orphaned processes. Slurm considers a process running until its exit code is collected, which the
first process of a container may not do.

    reaper.py COMMAND...
"""
import ctypes
import os
import signal
import subprocess
import sys

PR_SET_CHILD_SUBREAPER = 36


def main(words):
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    daemon = subprocess.Popen(words)
    signal.signal(signal.SIGTERM, lambda *_: os.kill(daemon.pid, signal.SIGTERM))
    while os.wait()[0] != daemon.pid:
        pass


if __name__ == "__main__":
    main(sys.argv[1:])
