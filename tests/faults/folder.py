"""A place where a sweep gets one fault, and the contents of its folder afterwards."""
import json
import os
import re
import signal
import subprocess

from commands import Output
from place import Place, check, wait_for
from whole import BEFORE, read

FOLDER = "folder.sweep"
RESULTS = ["results.csv", "map.svg"]
POINTS = ["points/00000.json", "points/00001.json"]
ALL = sorted(["sweep.json", *RESULTS, *POINTS])
SCENARIO = """name: small
baud: 12M
end: 600us
slaves:
  - {name: demo, address: 5, gsd: a.gsd, modules: [1 byte in], init: {ident: 1, max_inputs: 1, max_outputs: 1, cfg: "30"}}
expect: [{slave: demo, event: INITIALISED}]
"""
RUN = re.compile(r"00001\.\d+\.run\.(\d+)\.part")
QUICK, LONG = "end=600us,700us", "end=600us,300ms"  # the second point of LONG is long enough to be held, mostly


class Missed(Exception):
    """A run had ended before it could be stopped: everything is repeated."""


class OfSweep(Output):
    usual = None  # no other word for 0

    def __init__(self, parameter, *more):
        super().__init__("", FOLDER, "sweep", "s.yaml", "--jobs", "1", "--param", parameter, *more, "--out")


def statement(content):
    """The content of a point's file, without the run's duration."""
    point = json.loads(content)
    for key in ("wall_s", "real_time_factor"):
        point["result"].pop(key)
    del point["sum"]
    return point


def undisturbed(program, output, path):
    """The files of an undisturbed sweep in a separate folder."""
    words = [word if word != FOLDER else "whole" for word in output.command()]
    done = subprocess.run([program, *words], cwd=path, capture_output=True, check=False)
    check(done.returncode == 0, "a sweep that was let alone: exit %d, %s" % (done.returncode, done.stderr.decode()))
    return {name: read(os.path.join(path, "whole", name)) for name in ALL}


class SweepPlace(Place):
    """`reference`: the files of an undisturbed sweep."""

    def __init__(self, program, output, kept, reference):
        super().__init__(program, output, kept)
        self.reference = reference

    def own(self, name=""):
        return os.path.join(self.file(), name)

    # --- the state before a fault

    def sweep(self):
        row = self.do()
        check(row[:2] == ["all complete", "0"], "without a fault: %s" % row)

    def sweep_but(self, *names):
        """As if these files had not been reached."""
        self.sweep()
        for name in names:
            os.remove(self.own(name))

    def change_sweep(self, output=None):
        """From here on another output, program or content of a file is expected."""
        self.output = output or self.output
        self.reference = undisturbed(self.program, self.output, self.path)
        self.inputs.add("whole")

    def replace(self, name, old, new):
        content = read(self.file(name))
        check(old in content, "%s is not in %s" % (old, name))
        self.make(name, content.replace(old, new, 1))

    # --- while it runs

    def start_and_hold(self):
        """A sweep, and the number of its second point's run, which is stopped."""
        sweep = self.start(self.output.command())
        return sweep, self.hold(sweep)

    def runs(self):
        """Files of the second point; a temporary file has the number of the process that writes it."""
        names = os.listdir(self.own("points")) if os.path.isdir(self.own("points")) else []
        return [int(match[1]) for match in map(RUN.fullmatch, names) if match]

    def hold(self, sweep, other=None):
        """Holds the run of the second point that is not the other."""
        def there():
            return set(self.runs()) - {other}
        wait_for(lambda: there() or sweep.poll() is not None, "the run of the second point")
        for run in there():
            try:
                os.kill(run, signal.SIGSTOP)
            except ProcessLookupError as gone:
                raise Missed from gone
            wait_for(lambda run=run: state_of(run) in "TZ-", "the run to stand still")
            if state_of(run) == "T" and run in self.runs():
                return run
        raise Missed

    # --- and after it

    def status(self, code):
        return signal.Signals(-code).name if code < 0 else str(code)

    def neutral(self, text):
        text = re.sub(r"process id \d+", "process id PID", text.replace(FOLDER, "FOLDER"))
        text = re.sub(r"\.\d+\.run\b", ".PID.run", text)
        return re.sub(r"\.\d+\.part\b", ".PID.part", text)

    def line(self, errors):
        """Before its last line a sweep reports its findings in the folder."""
        lines = errors.decode().splitlines()
        check(len(lines) <= 1 or len(lines) == 2 and lines[0].startswith("sweep: "), "more lines: %s" % lines)
        return "`<br>`".join(self.neutral(line) for line in lines)

    def left(self, early=False):
        others = set(os.listdir(self.path)) - self.inputs - {FOLDER}
        check(not others, "beside the folder there is %s" % others)
        if not os.path.isdir(self.file()):
            return Place.state(self, FOLDER, early).strip() if os.path.lexists(self.file()) else "no folder"
        names = [os.path.relpath(os.path.join(base, name), self.file()) for base, _, files in os.walk(self.file()) for name in files]
        states = {name: self.state_in_folder(name) for name in sorted(names)}
        if list(states) == ALL and not any(states.values()):
            return "all complete"
        return ", ".join(self.neutral(name) + state for name, state in states.items()) or "an empty folder"

    def state_in_folder(self, name):
        content = b"" if os.path.islink(self.own(name)) else read(self.own(name))
        if os.path.islink(self.own(name)) or content == BEFORE:
            return " as before"
        if name in POINTS:
            check(statement(content) == statement(self.reference[name]), name + " is not the point")
        elif name in ALL:
            check(content == self.reference[name], name + " is not that of a sweep that was let alone")
        return " (empty)" if not content else ""

    def again(self):
        """The same command without the fault must give the same as an undisturbed sweep; returns its output."""
        row = self.do()
        check(row[:2] == ["all complete", "0"], "the same command again: %s" % row)
        return row[2]


def state_of(process):
    """T: stopped, Z: ended, -: gone."""
    try:
        return read("/proc/%d/stat" % process).rsplit(b")", 1)[1].split()[0].decode()
    except (FileNotFoundError, ProcessLookupError):
        return "-"


def wait_for_the_end_of(process):
    wait_for(lambda: state_of(process) in "Z-", "the end of a run")


def wait_for_pending(process, number):
    """A stopped process has received a signal."""
    def there():
        fields = dict(line.split(":\t") for line in read("/proc/%d/status" % process).decode().splitlines())
        return (int(fields["SigPnd"], 16) | int(fields["ShdPnd"], 16)) >> (number - 1) & 1
    wait_for(there, "a signal for the run")
