"""The table of the commands that work with a kind of chip: its rows are in a page, each with a function that tries it with every command of the row.

A script has ROWS of (what, how, function) and calls main(Table(...)):
    SCRIPT PROGRAM [NUMBER...]   all rows, or these; compares the page's table, too
    SCRIPT --table               prints the table
"""
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
FAILURES = []


class Cell:
    """A program in its own folder with the scenario x.yaml. `kind` tells kinds apart that share the rows."""

    def __init__(self, program, folder, scenario, kind=""):
        self.program, self.folder, self.kind, self.scenario = program, folder, kind, scenario
        self.write("x.yaml", scenario)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def read(self, name):
        return (self.folder / name).read_bytes()

    def call(self, *words):
        return subprocess.run([self.program, *map(str, words)], cwd=self.folder, capture_output=True, text=True, check=False)

    def passes(self, *words):
        """Returns its output."""
        done = self.call(*words)
        self.expect(words, done.returncode, 0, done.stdout[-1000:] + done.stderr)
        return done.stdout

    def is_refused(self, text, *words):
        """In one line, with exit code 2."""
        done = self.call(*words)
        self.expect(words, (done.returncode, done.stderr.count("\n"), text in done.stderr), (2, 1, True), done.stdout[-500:] + done.stderr)

    def expect(self, what, seen, wanted, said=""):
        if seen != wanted:
            FAILURES.append(f"{self.kind} {what}: {seen} instead of {wanted}\n{said}".lstrip())

    # --- rows of several tables
    def engines_agree(self, *options):
        """Logs, traces and waves of skip and step."""
        for engine in ("skip", "step"):
            self.passes("run", "x.yaml", "-q", *options, "--engine", engine, "--wave", f"{engine}.vcd", "--log", f"{engine}.log", "--trace", f"{engine}.trace")
        for name in ("vcd", "log", "trace"):
            self.expect(f"{name} of step", self.read(f"step.{name}") == self.read(f"skip.{name}"), True)

    def continues(self, at, *options):
        """A run that is saved and continued has the log of the whole one."""
        self.passes("run", "x.yaml", "-q", *options, "--log", "whole.log", "--save-at", at, "half.run")
        self.passes("run", "--restore", "half.run", "-q", "--log", "rest.log")
        rest = self.read("rest.log").splitlines()[-20:]
        self.expect("the rest", self.read("whole.log").splitlines()[-20:], rest)

    def replays_equal(self, address, *options):
        """Returns its output; the capture is x.pcapng."""
        text = self.passes("replay", "x.pcapng", "--as", address, "--no-progress", *options)
        self.expect(options, text.endswith("\nEQUAL\n"), True, text)
        return text


Table = collections.namedtuple("Table", "page head rows scenarios")  # `scenarios`: of each kind, by its name


def text_of(table):
    return "".join([f"| {table.head} | works |\n|---|---|\n", *(f"| {what} | {how} |\n" for what, how, _ in table.rows)])


def check_page(table):
    found = re.search(r"<!-- combinations -->\n(.*?)<!-- /combinations -->", table.page.read_text(encoding="utf-8"), re.S)
    if not found or found.group(1) != text_of(table):
        FAILURES.append(f"{table.page}: its table is not that of --table")


def main(table):
    if sys.argv[1] == "--table":
        print(text_of(table), end="")
        return 0
    check_page(table)
    for what, _, carry_out in [table.rows[int(number)] for number in sys.argv[2:]] or table.rows:
        before = len(FAILURES)
        for kind, scenario in table.scenarios.items():
            with tempfile.TemporaryDirectory() as folder:
                carry_out(Cell(str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(folder), scenario, kind))
        print(what if len(FAILURES) == before else f"{what}: WRONG", flush=True)
    print("\n".join(FAILURES))
    return 1 if FAILURES else 0
