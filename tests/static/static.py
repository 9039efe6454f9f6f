#!/usr/bin/env python3
"""Looks at the code and its runs without asking what they compute. ./run static builds what is needed and calls it."""
import argparse
import datetime
import pathlib
import sys

import memory
import misra
import stack
import threads

EXAMPLES = """parts:
  misra     the C driver under the required rules of MISRA C:2012 that cppcheck's addon knows; tests/static/misra_deviations.txt explains what is left
  stack     how deep the C driver's stack is on a Cortex-M3, for each public function and port
  valgrind  memcheck over one run of each kind; some minutes
  tsan      clang's ThreadSanitizer over what has threads; builds the preset threads, which takes long the first time

clang-tidy, with clang's static analyzer among its checks, is ./run lint.

examples:
  ./run static                   # all parts in turn
  ./run static misra stack
  ./run static valgrind --record

The table is tab-separated: part, case, what was found. Exit codes: 0 nothing, 1 something, 2 wrong input.
"""
ROOT = pathlib.Path(__file__).resolve().parents[2]
TRUST = ROOT / "docs" / "trust"
RECORD = TRUST / "static.tsv"
TARGETS = {"misra": (), "stack": (), "valgrind": ("default/dsdpv1-sim", "default/dsdpv1_rtl_libraries", "default/dsdpv1_firmware"),
           "tsan": ("threads/capi_test", "threads/dsdpv1-sim", "threads/dsdpv1_rtl_libraries")}


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"static: {message}\n")


def some_part(text):
    if text not in TARGETS:
        raise argparse.ArgumentTypeError(f"unknown part {text}, expected {', '.join(TARGETS)}")
    return text


def parse(words):
    parser = Parser(prog="./run static", description="Looks at the code and its runs without asking what they compute.", epilog=EXAMPLES,
                    formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    parser.add_argument("part", nargs="*", type=some_part, metavar="PART", help="which, see below; default all in turn")
    parser.add_argument("--record", action="store_true", help="writes the results into docs/trust/, from which docs/trust.md is made")
    parser.add_argument("--compare", action="store_true", help="fails when the depths are not those of docs/trust/stack.tsv")
    parser.add_argument("--targets", action="store_true", help=argparse.SUPPRESS)  # for ./run: what to build
    arguments = parser.parse_args(words)
    arguments.part = arguments.part or list(TARGETS)
    return arguments


class Table:
    """The results, printed as they arrive."""

    def __init__(self):
        self.rows, self.failed = [], False

    def add(self, part, case, figure, words=""):
        self.rows.append([part, case, figure])
        print(f"{part}\t{case}\t{figure}", flush=True)
        if words:
            self.failed = True
            print(f"static: {part}: {case}: {words}", file=sys.stderr)

    def counted(self, part):
        """For parts that count errors: an unfinished run is an error, too."""
        def tell(case, errors, words, seconds):
            self.add(part, case, "not carried out" if errors is None else f"{errors} errors", words or ("" if errors == 0 else "errors"))
        return tell


def misra_part(table, arguments):
    reports, explained, faults = misra.check()
    binding = [report for report in reports if report.rule not in misra.ADVISORY]
    table.add("misra", "required and mandatory rules", f"{len(binding)} places, {len(faults)} not explained", "\n".join(faults))
    table.add("misra", "advisory rules", f"{len(reports) - len(binding)} places, left as they are")
    if arguments.record:
        write("misra.tsv", "rule, file, part of the line, places, why", [[each.rule, each.file, each.part, each.places, each.why] for each in explained])


def stack_part(table, arguments):
    rows = stack.measure()
    for function, *depths, called in rows:
        table.add("stack", function, ", ".join(f"{port} {depth}" for port, depth in zip(stack.PORTS, depths) if depth != "-"))
    if arguments.compare and rows != kept("stack.tsv"):
        table.add("stack", "docs/trust/stack.tsv", "stale", "./run static stack --record writes it")
    if arguments.record:
        write("stack.tsv", "function, bytes by port at " + " / ".join(stack.LEVELS) + f", what it calls of the application; GCC {stack.compiler()}", rows)


def write(name, head, rows):
    text = f"# {datetime.date.today().isoformat()}: {head}\n" + "".join("\t".join(map(str, row)) + "\n" for row in rows)
    (TRUST / name).write_text(text, encoding="utf-8")


def kept(name):
    lines = (TRUST / name).read_text(encoding="utf-8").splitlines()
    return [line.split("\t") for line in lines if not line.startswith("#")]


def record(rows):
    """Replaces older rows of the same parts."""
    parts = {row[0] for row in rows}
    old = RECORD.read_text(encoding="utf-8").splitlines() if RECORD.exists() else ["# date, part, case, what was found"]
    kept = [line for line in old if line.startswith("#") or line.split("\t")[1] not in parts]
    today = datetime.date.today().isoformat()
    new = ["\t".join(map(str, [today, *row])) for row in rows if row[0] != "stack"]  # which has a separate file
    RECORD.write_text("\n".join([kept[0], *sorted(kept[1:] + new, key=lambda line: list(TARGETS).index(line.split("\t")[1]))]) + "\n", encoding="utf-8")


def main(words):
    arguments = parse(words)
    if arguments.targets:
        print(" ".join(target for part in arguments.part for target in TARGETS[part]))
        return 0
    table = Table()
    steps = {"misra": lambda: misra_part(table, arguments), "stack": lambda: stack_part(table, arguments),
             "valgrind": lambda: memory.check(table.counted("valgrind")), "tsan": lambda: threads.check(table.counted("tsan"))}
    print("part\tcase\tfound", flush=True)
    for part in arguments.part:
        steps[part]()
    if arguments.record and not table.failed:
        record(table.rows)
    return 1 if table.failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
