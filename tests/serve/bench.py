"""Shared by the pyprofibus tests: `dsdpv1-sim serve` and the master as processes, and their output as data."""
import contextlib
import json
import os
import re
import selectors
import signal
import subprocess
import sys
import time
import traceback

import lateness

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
GSD = os.path.join(ROOT, "scenarios", "dsdpv1.gsd")
BITS_PER_SECOND = {"19.2k": 19200, "45.45k": 45450, "187.5k": 187500, "500k": 500000, "1.5M": 1500000}
DEADLINE = 300  # seconds for one wait; far more than a busy machine needs
LATE_MS = 25    # half of pyprofibus's shortest time limit that matters: 50 ms for an answer
ATTEMPTS = 5
PAUSE_S = 5   # before the second attempt, twice as long before the third, ...: a machine is busy for a while
LATE_S = []   # delays of hosts that were due to talk


class Failure(Exception):
    """A failed check."""


def check(holds, text):
    if not holds:
        raise Failure(text)


def talks(since, within_s):
    """A host that had to talk within `within_s` of `since` does so now. Returns the time; a late host means that the machine is to blame
    (`was_late`)."""
    now = time.monotonic()
    if now - since > within_s:
        LATE_S.append(now - since)
    return now


def was_late():
    """True if a host was late since the last call."""
    late = bool(LATE_S)
    LATE_S.clear()
    return late


def exit_code(case, was_busy, pause_s=PAUSE_S):
    """Decorates a case that is repeated while `was_busy()` blames the machine, ATTEMPTS times in total."""
    for attempt in range(1, ATTEMPTS + 1):
        try:
            case()
            return 0
        except Exception:  # any failure: on a busy machine also a missing result
            print("attempt %d:" % attempt)
            traceback.print_exc(file=sys.stdout)
        if not was_busy():
            return 1
        if attempt < ATTEMPTS:
            time.sleep(pause_s * attempt)
    return 1


class Lines:
    """The lines of a pipe; never waits longer than requested."""

    def __init__(self, pipe):
        self.pipe = pipe
        self.rest = b""
        os.set_blocking(pipe.fileno(), False)
        self.selector = selectors.DefaultSelector()
        self.selector.register(pipe, selectors.EVENT_READ)

    def next(self, deadline):
        """The next line; None at the end. Fails at the deadline (of time.monotonic)."""
        while b"\n" not in self.rest:
            left = deadline - time.monotonic()
            check(left > 0, "no line came in time")
            if not self.selector.select(left):
                continue
            data = self.pipe.read(65536)
            if not data:
                return None
            self.rest += data
        line, self.rest = self.rest.split(b"\n", 1)
        return line.decode("utf-8", "replace")


class Serve:
    """A running `dsdpv1-sim serve`; `end` ends it as Ctrl-C does. Without a log for runs of hours, whose log would fill the disk."""

    def __init__(self, program, folder, scenario, *options, port=("--pty", "dp"), log=True):
        self.folder = folder
        with open(os.path.join(folder, "scenario.yaml"), "w", encoding="UTF-8") as file:
            file.write(scenario)
        self.errors = open(os.path.join(folder, "serve.err"), "w+", encoding="UTF-8")
        self.process = subprocess.Popen(
            [program, "serve", "scenario.yaml", *port, *(("--log", "serve.log") if log else ()), "--result", "serve.json", *options],
            cwd=folder, stdout=subprocess.PIPE, stderr=self.errors)
        self.lines = Lines(self.process.stdout)
        try:
            self.ready = self.lines.next(time.monotonic() + DEADLINE)
            check(self.ready is not None, "serve did not start: " + self.said())
        except BaseException:  # an interrupt, too: otherwise serve would continue
            self.kill()
            raise
        self.port = os.path.join(folder, "dp")
        self.log = self.result = None

    def said(self):
        return os.pread(self.errors.fileno(), 1 << 20, 0).decode()  # leaves serve's write position unchanged

    def growing_log(self):
        """The path of the log while it is being written."""
        return os.path.join(self.folder, re.search(r"the log grows as (\S+)", self.said()).group(1))

    def wait_for_log(self, pattern):
        """Waits until a line of the log that is being written matches."""
        deadline = time.monotonic() + DEADLINE
        path = self.growing_log()
        while time.monotonic() < deadline:
            with open(path, encoding="UTF-8") as file:
                if re.search(pattern, file.read()):
                    return
            time.sleep(0.05)  # polls; the interval does not matter
        raise Failure("the log never said " + pattern)

    def end(self, read_log=True):
        """A log of minutes has millions of lines: a test that measures how long the end takes must not read it."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        output, _ = self.process.communicate(timeout=DEADLINE)
        self.summary = (output or b"").decode()
        self.status = self.process.returncode
        check(not os.path.lexists(self.port), "the link is still there")
        with open(os.path.join(self.folder, "serve.json"), encoding="UTF-8") as file:
            self.result = json.load(file)
        if not read_log:
            return self
        with open(os.path.join(self.folder, "serve.log"), encoding="UTF-8") as file:
            self.log = [LogLine(line) for line in file]
        return self

    def late_ms(self):
        """Lag of simulated time behind real time; infinite when time was given up."""
        if "too slow" in self.said():
            return float("inf")
        return self.result["pacing"]["error_max_us"] / 1000 if self.result else 0

    def settle(self):
        """Ends serve also after a failed check: serve prints its lag at the end."""
        if self.result is None:
            with contextlib.suppress(Failure, OSError, ValueError, subprocess.TimeoutExpired):
                self.end(read_log=False)
        self.kill()

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


class LogLine:
    """'  123.000 ns  echo   info   PRM_OK: text' as fields; info, refusal and violation lines have their code as a separate field."""

    def __init__(self, text):
        fields = text.split(None, 4)
        self.ns = float(fields[0])
        self.station, self.kind = fields[2], fields[3]
        self.text = fields[4].rstrip("\n") if len(fields) > 4 else ""
        self.code = self.text.split(":")[0] if self.kind in ("info", "refusal", "violation") else ""


class Master:
    """pyprofibus in its own process."""

    def __init__(self, python, folder, plan):
        self.late = os.path.join(folder, "late_ms")
        plan = dict(plan, folder=folder, gsd=GSD, late=self.late)
        path = os.path.join(folder, "plan.json")
        with open(path, "w", encoding="UTF-8") as file:
            json.dump(plan, file)
        self.process = subprocess.Popen([python, os.path.join(HERE, "master.py"), path], stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT)
        self.lines = Lines(self.process.stdout)
        self.words = []      # pyprofibus's own output
        self.exchanges = []  # events of exchanges
        self.did = []        # actions, with the place in the list of exchanges where they happened

    def run_until(self, holds):
        """Reads events until `holds()`; True, or False if the master ended before."""
        deadline = time.monotonic() + DEADLINE
        while not holds():
            line = self.lines.next(deadline)
            if line is None:
                return False
            if not line.startswith("{"):
                self.words.append(line)
                continue
            event = json.loads(line)
            if "slave" in event:
                self.exchanges.append(event)
            elif "did" in event:
                self.did.append((len(self.exchanges), event))
            elif "error" in event:
                self.words.append("error: " + event["error"])
            elif "done" in event:
                return True
        return True

    def finish(self):
        """Waits until all cycles of the plan are done."""
        self.run_until(lambda: False)
        status = self.process.wait(timeout=DEADLINE)
        check(status == 0, "the master ended with %d:\n%s" % (status, "\n".join(self.words[-20:])))

    def late_ms(self):
        return lateness.greatest_ms(self.late)

    def of(self, slave):
        return [event for event in self.exchanges if event["slave"] == slave]

    def said(self, text):
        return any(text in line for line in self.words)

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
