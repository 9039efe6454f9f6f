"""Runs the built programs and extracts their numbers."""
import json
import os
import pathlib
import resource
import shutil
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "default"
SIM = BUILD / "apps" / "dsdpv1-sim"
FOLDER = BUILD / "tests" / "bench"
FIRMWARE = BUILD / "examples" / "firmware"
QUIET = {**os.environ, "SYSTEMC_DISABLE_COPYRIGHT_MESSAGE": "1"}


class Failed(Exception):
    """A row cannot be measured; the text is one line."""


def first_line(*texts):
    lines = [line.strip() for text in texts for line in text.splitlines() if line.strip()]
    return lines[0] if lines else ""


def call(command, cwd=None, **environment):
    """Standard output of a program that has succeeded."""
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, cwd=cwd, env={**QUIET, **environment})
    except OSError as error:
        raise Failed(f"{pathlib.Path(command[0]).name} cannot be run: {error.strerror}") from error
    if done.returncode != 0:
        raise Failed(first_line(done.stderr, done.stdout).replace(f"{ROOT}/", "") or f"{pathlib.Path(command[0]).name} ended with {done.returncode}")
    return done.stdout


def cpu_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def number_in(printed, program, name):
    for line in printed.splitlines():
        row, tab, value = line.partition("\t")
        if tab and row == name:
            return float(value)
    raise Failed(f"{program} has printed no value for {name}")


def row_of(program, name, *words):
    """The number that one of the programs of this folder prints for a row, called with the row's name or with `words`."""
    return number_in(call([FOLDER / program, *(words or (name,))]), program, name)


def row_of_python(program, name, *words):
    """... that one of the Python programs beside this file prints, which use the module dsdpv1 with the build's library."""
    folders = os.pathsep.join(map(str, (BUILD / "bindings" / "python", ROOT / "bindings" / "cocotb")))
    printed = call([ROOT / ".venv" / "bin" / "python", "-B", ROOT / "tests" / "bench" / program, *words], PYTHONPATH=folders,
                   DSDPV1_LIBRARY=str(BUILD / "capi" / "libdsdpv1.so"))
    return number_in(printed, program, name)


EXCHANGES = 2000


def pin_changes(*command, **environment):
    """Millions of pin changes per second of CPU time in a simulation of binding_speed.sv, without its start."""
    spent = []
    for exchanges in (0, EXCHANGES):
        before = cpu_of_children()
        changes = number_in(call([*command, f"+exchanges={exchanges}"], **environment), "binding_speed", "changes")
        spent.append(cpu_of_children() - before)
    return changes / (spent[1] - spent[0]) / 1e6


def replayed_pin_changes(folder, *command):
    """The same with recorded answers of the model."""
    answers, between = str(folder / "answers"), {"LD_PRELOAD": str(FOLDER / "libbench_dpi_answers.so")}
    call([*command, f"+exchanges={EXCHANGES}"], **between, DSDPV1_RECORD=answers)
    return pin_changes(*command, **between, DSDPV1_REPLAY=answers)


def samples(folder, command, keys):
    """The output of perf for a run: lines with a share and `keys`."""
    if shutil.which("perf") is None:
        raise Failed("perf is not installed")
    data = folder / "perf.data"
    call(["perf", "record", "-q", "-F", "2000", "-o", data, *command], cwd=folder)
    return call(["perf", "report", "-i", data, "--stdio", "--no-children", "-s", keys])


def run_command(scenario, *options):
    """A quiet run of dsdpv1-sim; `scenario` is one of scenarios/ or of scenarios.py."""
    shipped, file = ROOT / "scenarios" / f"{scenario}.yaml", f"{scenario}.yaml"  # in its own folder, so that an error names no path of this machine
    return [SIM, "run", shipped if shipped.exists() else file, "--quiet", "--no-progress", *options]


def calibration():
    """The machine's time in milliseconds for fixed work."""
    return row_of("bench_core", "calibration")


class Round:
    """One round of measurements: each run is made once for all rows, so that both sides of a ratio follow each other."""

    def __init__(self, folder, clock="wall"):
        self.folder = folder
        self.clock = clock
        self.done = {}

    def once(self, key, measure):
        if key not in self.done:
            try:
                self.done[key] = measure()
            except Failed as failure:
                self.done[key] = failure
        if isinstance(self.done[key], Failed):
            raise self.done[key]
        return self.done[key]

    def program(self, program, name):
        return self.once((program, name), lambda: row_of(program, name))

    def pin_changes(self, *command):
        return self.once(command, lambda: pin_changes(*command))

    def replayed_pin_changes(self, *command):
        return self.once(("replayed", *command), lambda: replayed_pin_changes(self.folder, *command))

    def simulate(self, scenario, *options):
        """Simulated and consumed seconds of a run of dsdpv1-sim."""
        return self.once((scenario, options), lambda: self._simulate(scenario, options))

    def _simulate(self, scenario, options):
        before = cpu_of_children()
        call(run_command(scenario, "--result", "result.json", *options), cwd=self.folder)
        taken = cpu_of_children() - before
        result = json.loads((self.folder / "result.json").read_text(encoding="utf-8"))
        return {"simulated_s": result["simulated_ns"] / 1e9, "taken_s": taken if self.clock == "cpu" else result["wall_s"]}

    def start(self):
        """Milliseconds from the call of the program to its end."""
        begin = time.perf_counter()
        call([SIM, "--version"])
        return (time.perf_counter() - begin) * 1000
