#!/usr/bin/env python3
"""The speed table: selects rows, measures them in rounds, judges and prints them. ./run bench builds the programs and calls it."""
import argparse
import itertools
import json
import math
import os
import pathlib
import re
import sys
import tempfile
import time

import hot_spots
import instructions
import page
import parts
import programs
import rows
import scenarios
import table

EXAMPLES = """examples:
  ./run bench
  ./run bench --only core_16,demo --rounds 9
  ./run bench --json out/bench.json
  ./run bench --clock cpu           # others work on this machine
  ./run bench --wait 60             # or wait until they do not
  ./run bench --instructions        # what no other work on the machine changes: host instructions, against the last record
  ./run bench --list
  ./run bench --document            # writes docs/performance.md

The table is tab-separated: row, value, goal, met or not, min..max; with --instructions row, instructions, of what, recorded, change. Exit codes: 0
every measured row meets its goal, or takes at most 5 % more instructions than recorded; 1 one does not or cannot be measured; 2 wrong input.
"""
PAGE = programs.ROOT / "docs" / "performance.md"
MOST_ROUNDS, MOST_MINUTES = 1000, 10_000
FIRST_LOOKS = 100


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"bench: {message}\n")


def chosen_rows(text, known):
    """The rows named by `text`, or all without it; unknown names are an error."""
    if text is None:
        return list(known)
    names, allowed = [name for name in text.split(",") if name], [row.name for row in known]
    unknown = [name for name in names if name not in allowed]
    if unknown or not names:
        raise ValueError(f"argument --only: unknown row {unknown[0] if unknown else '(none)'}, expected {', '.join(allowed)}")
    return [row for row in known if row.name in names]


def some_rounds(text):
    if not re.fullmatch(r"[0-9]{1,9}", text) or not 1 <= int(text) <= MOST_ROUNDS:
        raise argparse.ArgumentTypeError(f"{text} is no number of rounds, expected 1 to {MOST_ROUNDS}")
    return int(text)


def some_minutes(text):
    if not re.fullmatch(r"[0-9]{1,9}", text) or int(text) > MOST_MINUTES:
        raise argparse.ArgumentTypeError(f"{text} is no number of minutes, expected 0 to {MOST_MINUTES}")
    return int(text)


def some_file(text):
    path = pathlib.Path(text)
    if path.exists() and not path.is_file():
        raise argparse.ArgumentTypeError(f"{text} is no file that can be replaced")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise argparse.ArgumentTypeError(f"{text} cannot be written: its folder is not there or not writable")
    return path


def parse(words):
    parser = Parser(prog="./run bench", description="Measures how fast the project is, and judges it by its goals.", epilog=EXAMPLES,
                    formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    parser.add_argument("--json", type=some_file, metavar="FILE", help="also writes the table, with every round's values, as JSON")
    parser.add_argument("--only", metavar="ROW[,ROW]", help="measures these rows only")
    parser.add_argument("--rounds", type=some_rounds, default=5, metavar="N", help="rounds whose median is taken; default 5")
    parser.add_argument("--wait", type=some_minutes, default=0, metavar="MINUTES",
                        help="measures a row again when others used the processor before or after it, as long as these minutes are not over; all runs on "
                        "one processor then, or the next when that is busy; default 0")
    parser.add_argument("--clock", choices=("wall", "cpu"), default="wall",
                        help="which time of dsdpv1-sim counts: wall (default), or CPU time where others use the machine; start is always wall")
    parser.add_argument("--instructions", action="store_true", help="counts host instructions instead, by valgrind: the same on a busy machine")
    parser.add_argument("--record", action="store_true", help="with --instructions: keeps the counts, which later ones are held against")
    parser.add_argument("--list", action="store_true", help="prints the rows, their goals and what they do")
    parser.add_argument("--document", action="store_true", help="also writes docs/performance.md; all rows are measured")
    parser.add_argument("--targets", action="store_true", help=argparse.SUPPRESS)  # for ./run: what to build
    arguments = parser.parse_args(words)
    if arguments.document and (arguments.only or arguments.rounds < 5):
        parser.error("--document needs all rows and at least 5 rounds, so --only and fewer --rounds are not allowed with it")
    if arguments.record and not arguments.instructions:
        parser.error("--record needs --instructions")
    try:
        arguments.rows = chosen_rows(arguments.only, instructions.ROWS if arguments.instructions else rows.ROWS)
    except ValueError as wrong:
        parser.error(str(wrong))
    return arguments


# ------------------------------------------------------------------------------------------------------------ measuring
class Progress:
    """On a terminal one line that is overwritten, else a line per round."""

    def __init__(self, rounds):
        self.rounds = rounds
        self.terminal = sys.stderr.isatty()

    def row(self, turn, name):
        if self.terminal:
            print(f"\rbench: round {turn} of {self.rounds}, {name:20}", end="", file=sys.stderr, flush=True)

    def round(self, turn):
        if not self.terminal:
            print(f"bench: round {turn} of {self.rounds}", file=sys.stderr, flush=True)

    def end(self):
        if self.terminal:
            print(f"\r{'':60}\r", end="", file=sys.stderr, flush=True)


class Machine:
    """Measures how busy the machine is: the calibration's times before, between and after the rows, for the values that count. With time to wait
    everything runs on one processor, the one that is calibrated; if that is busy, on the next one."""

    def __init__(self, minutes):
        self._times, self.refused = [], 0
        self._least = math.inf
        self._until = time.monotonic() + 60 * minutes
        self._processors = itertools.cycle(sorted(os.sched_getaffinity(0)))
        self._look()
        for _ in range(FIRST_LOOKS if minutes else 0):  # the time on a quiet machine is known only after one was seen
            self._look_at_next()

    def _look_at_next(self):
        os.sched_setaffinity(0, {next(self._processors)})
        self._look()

    def _look(self):
        self._last = programs.calibration()
        self._least = min(self._least, self._last)

    def _is_to_wait(self, taken):
        return taken > self._least * (1 + table.QUIET) and time.monotonic() < self._until

    def wait(self):
        """Waits until it is quiet, as long as there is time."""
        while self._is_to_wait(self._last):
            self._look_at_next()

    def was_quiet(self):
        """Whether the machine was quiet before and after the measurements since wait(); also true without time to repeat them."""
        before = self._last
        self._look()
        if self._is_to_wait(max(before, self._last)):
            self.refused += 1
            return False
        self._times += [before, self._last]
        return True

    @property
    def times(self):
        """Where no value counts, that of the last look."""
        return self._times or [self._last]


def measure_row(outcome, turn, machine):
    """A row that has failed once is not tried again."""
    counts = False
    while not counts and not outcome.error:
        machine.wait()
        done = dict(turn.done)
        try:
            value = outcome.row.measure(turn)
        except programs.Failed as failure:
            outcome.error = str(failure)
            return
        counts = machine.was_quiet()
        if counts:
            outcome.values.append(value)
        else:
            turn.done = done


def measure(chosen, rounds, clock, folder, minutes):
    """Outcomes, and the load of the machine."""
    outcomes, progress, machine = [table.Outcome(row, []) for row in chosen], Progress(rounds), Machine(minutes)
    for number in range(1, rounds + 1):
        progress.round(number)
        turn = programs.Round(folder, clock)
        for outcome in outcomes:
            progress.row(number, outcome.row.name)
            measure_row(outcome, turn, machine)
    progress.end()
    return outcomes, machine


# -------------------------------------------------------------------------------------------------------------- results
def machine():
    """In general terms."""
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        text = ""
    model = re.search(r"^model name\s*:\s*(.+)$", text, re.M)
    return {"cpu": model.group(1).strip() if model else "an unknown processor", "cores": os.cpu_count() or 1}


def write_whole(path, text):
    """Writes it completely or not at all."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def describe_rows(arguments):
    for row in arguments.rows:
        print(f"{row.name}\t{row.unit if arguments.instructions else table.goal(row)}\t{row.what}")


def targets_of(arguments):
    if arguments.instructions:
        return instructions.TARGETS
    return rows.targets_of(arguments.rows) + (["bench_profile"] if arguments.document else [])


def run(arguments):
    with tempfile.TemporaryDirectory(prefix="bench-") as name:
        folder = pathlib.Path(name)
        scenarios.write_all(folder)
        outcomes, state = measure(arguments.rows, arguments.rounds, arguments.clock, folder, arguments.wait)
        print("\n".join([*table.lines(outcomes), "", table.calibration_line(state)]), flush=True)
        if arguments.document:
            write_whole(PAGE, page.performance_page(outcomes, state, arguments.rounds, arguments.clock, machine(),
                                                    hot_spots.profile(folder), parts.profiles(folder)))
    if arguments.json:
        write_whole(arguments.json, json.dumps(table.report(outcomes, state, arguments.rounds, arguments.clock, machine()), indent=2) + "\n")
    return 0 if all(outcome.met for outcome in outcomes) else 1


def main(words):
    arguments = parse(words)
    if arguments.targets:
        print("\n".join(targets_of(arguments)))
        return 0
    if arguments.list:
        describe_rows(arguments)
        return 0
    if arguments.instructions:
        return instructions.run(arguments.rows, arguments.record)
    try:
        return run(arguments)
    except programs.Failed as failure:  # of the calibration
        print(f"bench: {failure}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"bench: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
