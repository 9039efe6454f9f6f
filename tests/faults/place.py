"""A folder where one fault is done to one output of dsdpv1-sim, and what is found there afterwards."""
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
DEADLINE = 60
SCENARIO = """name: short
baud: 12M
end: 1ms
slaves:
  - {name: demo, address: 5, gsd: device.gsd, modules: ["2 bytes in, 2 bytes out"]}
masters:
  - {name: plc, address: 2, slaves: [{slave: demo, outputs: "01 02"}]}
"""
FST_HEAD, FST_UNFINISHED = 330, 0xFF  # length of the first block, tag of one that is not finished
ENDLESS = ["--set", "end=3000s", "--progress"]


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


class Output:
    """One output: its name in the table, its file, and the command that writes it."""

    def __init__(self, name, file, words):
        self.name, self.file, self.words, self.reference = name, file, words, b""

    @property
    def of_run(self):
        return self.words[0] == "run"

    def command(self, path=None, more=()):
        return [word for word in [*self.words, path or self.file, *more] if word]


def of_run(name, file, option):
    return Output(name, file, ["run", "s.yaml", "--quiet", option])


OUTPUTS = [of_run("wave .fst", "o.fst", "--wave"), of_run("wave .vcd", "o.vcd", "--wave"), of_run("log", "o.log", "--log"),
           of_run("log .jsonl", "o.jsonl", "--log"), of_run("result", "o.json", "--result"),
           of_run("trace", "o.txt", "--trace"), Output("schema", "o.schema", ["schema", "--output"]),
           Output("reasons", "o.md", ["reasons", "--markdown", "--output"]),
           Output("recover", "o.fst", ["recover", "killed.fst.1.part", "--output"])]
# What a run takes an output for that another one needs too.
OTHER = {"--wave": "--log", "--log": "--result", "--result": "--trace", "--trace": "--log"}


class Place:
    """A folder with the inputs, where one fault is done to one output."""

    def __init__(self, program, output, kept):
        self.program, self.output = program, output
        self.path = tempfile.mkdtemp(prefix="dsdpv1_faults_")
        for name in os.listdir(kept):
            shutil.copy(os.path.join(kept, name), self.path)
        self.inputs = set(os.listdir(self.path))

    def file(self, name=None):
        return os.path.join(self.path, name or self.output.file)

    def make(self, name=None, content=BEFORE):
        with open(self.file(name), "wb") as file:
            file.write(content)

    def start(self, words, faults="", stdout=subprocess.DEVNULL):
        launcher = [sys.executable, "-S", os.path.join(HERE, "launch.py"), faults] if faults else []
        return subprocess.Popen([*launcher, self.program, *words], cwd=self.path, stdout=stdout, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)

    def do(self, path=None, faults="", more=()):
        return self.end(self.start(self.output.command(path, more), faults))

    def end(self, process, already=b""):
        _, errors = process.communicate(timeout=DEADLINE)
        return self.row(process.returncode, already + errors)

    def row(self, status, errors):
        status = signal.Signals(-status).name if status < 0 else str(status)
        return [self.left(early=status == "130"), status, self.line(errors)]

    def line(self, errors):
        text = re.sub(r"\r[^\x1b]*\x1b\[K", "", errors.decode())
        check(text.count("\n") <= 1, "more than one line: " + text)
        text = text.strip().replace(self.path + "/", "")
        text = re.sub(r"until [1-9]\d*\.\d{3} ns", "until TIME", text)
        return self.neutral(text)

    def neutral(self, text):
        """Without what differs from output to output."""
        text = re.sub(r"n{100,}(\.\w+)?", "NAME", text)
        text = text.replace(self.output.file or "/", "FILE").replace("./FILE", "FILE")
        text = re.sub(r"--(wave|log|result|trace|output)\b", "OPTION", text)
        text = re.sub(r"dsdpv1-sim \w+:", "dsdpv1-sim COMMAND:", text)
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
            if self.output.file == "o.fst" and not has_changes(content):
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

    def part(self, something=False):
        """The temporary file; `something`: once there is something to be read in it, of FST a block of changes."""
        def there():
            return [name for name in os.listdir(self.path) if name.endswith(".part") and name not in self.inputs
                    and (not something or has_changes(read(self.file(name))))]
        wait_for(there, "the temporary file")
        return there()[0]

    def close(self):
        subprocess.run(["chmod", "-R", "u+w", self.path], check=False)
        shutil.rmtree(self.path)
