"""Runs of dsdpv1-sim and their outputs, for the tests of this folder."""
import json
import pathlib
import subprocess

PROJECT = pathlib.Path(__file__).resolve().parents[2]
TICKS_PER_NS = 12


def call(program, *arguments, folder=PROJECT, limit=None):
    """The finished run; `limit`: maximum size of a file in bytes."""
    shell = [] if limit is None else ["bash", "-c", f'ulimit -f {limit // 1024}; exec "$@"', "bash"]
    return subprocess.run([*shell, program, "run", *map(str, arguments), "--no-progress", "--quiet"], cwd=folder, capture_output=True, text=True, check=False)


def time_of(tick):
    """In the notation of a command line."""
    return f"{tick / TICKS_PER_NS:.4f}ns"


def tick_of(line):
    """The time of a line of a log."""
    return round(float(line.split(maxsplit=1)[0]) * TICKS_PER_NS)


def log_from(path, tick):
    return [line for line in path.read_text(encoding="utf-8").splitlines() if tick_of(line) >= tick]


def result(path):
    """The values without those of the wall clock."""
    values = json.loads(path.read_text(encoding="utf-8"))
    for key in ("wall_s", "real_time_factor"):
        values.pop(key)
    return values


def report(failures):
    for failure in failures:
        print(failure)
    return 1 if failures else 0
