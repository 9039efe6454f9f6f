"""A folder in which one fault is applied to one output of dsdpv1-sim, and its contents afterwards."""
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from whole import BEFORE, ended_early, read, readable, same

HERE = os.path.dirname(os.path.abspath(__file__))
DEADLINE = 300  # seconds for one wait; far more than a busy machine needs
FST_HEAD, FST_UNFINISHED = 330, 0xFF  # length of the first block, tag of one that is not finished


class Failure(Exception):
    pass


def check(condition, what):
    if not condition:
        raise Failure(what)


def wait_for(condition, what):
    end = time.monotonic() + DEADLINE
    while not condition():
        check(time.monotonic() < end, "waited in vain for " + what)
        time.sleep(0.005)  # polls; nothing depends on how long


def has_changes(content):
    return len(content) > 2000 and (content[0] != 0 or content[FST_HEAD] != FST_UNFINISHED)


class Place:
    """A folder with the inputs of `kept`, in which one fault is applied to one output."""

    def __init__(self, program, output, kept):
        self.program, self.output = program, output
        self.path = tempfile.mkdtemp(prefix="dsdpv1_faults_")
        shutil.copytree(kept, self.path, symlinks=True, dirs_exist_ok=True)
        self.inputs = {*os.listdir(self.path), *output.besides}
        self.started = []
        self.heard = {}  # output of processes while they were awaited

    def file(self, name=None):
        return os.path.join(self.path, name or self.output.file)

    def make(self, name=None, content=BEFORE):
        with open(self.file(name), "wb") as file:
            file.write(content)

    def start(self, words, faults="", stdout=subprocess.DEVNULL):
        launcher = [sys.executable, "-S", os.path.join(HERE, "launch.py"), faults] if faults else []
        self.started.append(subprocess.Popen([*launcher, self.program, *words], cwd=self.path, stdout=stdout, stderr=subprocess.PIPE,
                                             stdin=subprocess.DEVNULL))
        return self.started[-1]

    def start_endless(self):
        """The output's command without an end, when it runs."""
        process = self.start(self.output.command(endless=True), stdout=subprocess.PIPE)
        self.heard[process.pid] = self.output.wait_until_it_runs(process, self)
        return process

    def do(self, path=None, faults="", more=()):
        return self.end(self.start(self.output.command(path, more), faults))

    def end(self, process, early=False, said=True):
        """`early`: it was interrupted. `said`: its last line matters."""
        _, errors = process.communicate(timeout=DEADLINE)
        errors = self.heard.get(process.pid, b"") + errors
        return [self.left(early), self.status(process.returncode), self.line(errors) if said else ""]

    def status(self, code):
        if code < 0:
            return signal.Signals(-code).name
        return "usual" if code == self.output.usual else str(code)

    def line(self, errors):
        text = re.sub(r"\r[^\x1b]*\x1b\[K", "", errors.decode())
        text = re.sub(r"serve: (the log grows as .*|this computer is too slow.*)\n", "", text)
        check(text.count("\n") <= 1, "more than one line: " + text)
        text = text.strip().replace(self.path + "/", "")
        text = re.sub(r"until [1-9]\d*\.\d{3} ns", "until TIME", text)
        return self.neutral(text)

    def neutral(self, text):
        """Without the parts that differ between outputs."""
        text = re.sub(r"n{100,}(\.\w+)?", "NAME", text)
        text = text.replace(self.output.file or "/", "FILE").replace("./FILE", "FILE")
        text = re.sub(r"--(wave|log|result|trace|output|difference|stimulus|tsv|replay|list|capture|report|chip|json|table|junit)\b", "OPTION", text)
        text = re.sub(r"dsdpv1-sim [\w-]+:", "dsdpv1-sim COMMAND:", text)
        return re.sub(r"\.\d+(-\d+)?\.part", ".PID.part", text)

    def left(self, early=False):
        found = sorted(set(os.listdir(self.path)) - self.inputs)
        return ", ".join("%s%s" % (self.neutral(name), self.state(name, early)) for name in found) or "nothing"

    def state(self, name, early):
        path = self.file(name)
        if os.path.islink(path) or not os.path.isfile(path):
            return " as before"
        content = read(path)
        if name.endswith(".hier"):
            return ""
        if name.endswith(".part"):
            if self.output.file.endswith(".fst") and self.output.simulates and not has_changes(content):
                return " (no changes yet)"
            if not content:
                return " (empty)"
            check(readable(path, content), name + " is not readable")
            return " (readable)"
        if content == BEFORE:
            return " as before"
        whole = ended_early(self.program, path, content) if early else same(content, self.output.reference)
        check(whole, "%s is neither complete nor as before" % name)
        return " complete"

    def part(self, something=False, of=""):
        """The temporary file of the process with this number; `something`: once it has readable content, for FST a block of changes."""
        def there():
            return [name for name in os.listdir(self.path) if name.endswith("%s.part" % of) and name not in self.inputs
                    and (not something or has_changes(read(self.file(name))))]
        wait_for(there, "the temporary file")
        return there()[0]

    def close(self):
        """Also after a check that failed in between."""
        for process in self.started:
            process.kill()
            process.wait()
        subprocess.run(["chmod", "-R", "u+w", self.path], check=False)
        shutil.rmtree(self.path)
