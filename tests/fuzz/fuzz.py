#!/usr/bin/env python3
"""Fuzzes readers of external input with clang's libFuzzer under the sanitizers. ./run fuzz builds the programs and calls it."""
import argparse
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "trust"))
import corpora  # noqa: E402
import records  # noqa: E402
import target_list  # noqa: E402

EXAMPLES = """examples:
  ./run fuzz                              # all targets in turn, 30 s each
  ./run fuzz telegram gsd --seconds 600
  ./run fuzz chip --runs 1000000 --seed 7
  ./run fuzz gsd --reproduce build/fuzz/findings/gsd/crash-1234
  ./run fuzz --minimise                   # tests/fuzz/corpus/ again, from it and from all that was found
  ./run fuzz --list

The table is tab-separated: target, inputs, seconds, inputs a second, what was found. What is new goes into build/fuzz/corpus/TARGET, where the next
run goes on. A finding is a crash, a report of a sanitizer, a leak, a broken promise, more than 10 s for an input, or more memory than 2 GB in all or
256 MB at once; its input is kept in build/fuzz/findings/TARGET. Exit codes: 0 nothing found, 1 a finding, 2 wrong input.
"""
BUILD = ROOT / "build" / "fuzz"
MOST_SECONDS, MOST_RUNS = 7 * 24 * 3600, 10 ** 12
HEAD = ["target", "inputs", "seconds", "inputs/s", "found"]


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"fuzz: {message}\n")


def some_target(text):
    if text not in target_list.NAMES:
        raise argparse.ArgumentTypeError(f"unknown target {text}, expected {', '.join(target_list.NAMES)}")
    return text


def number(most, what):
    def parse(text):
        if not re.fullmatch(r"[0-9]{1,13}", text) or not 1 <= int(text) <= most:
            raise argparse.ArgumentTypeError(f"{text} is no {what}, expected 1 to {most}")
        return int(text)
    return parse


def some_input(text):
    path = pathlib.Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"{text} is no file, expected an input of a target")
    return path.resolve()


def parse(words):
    parser = Parser(prog="./run fuzz", description="Fuzzes readers of files, protocols, the C API and the chip's pins.", epilog=EXAMPLES,
                    formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
    parser.add_argument("target", nargs="*", type=some_target, help="which; default all in turn")
    parser.add_argument("--seconds", type=number(MOST_SECONDS, "number of seconds"), metavar="N", help="of each target; default 30")
    parser.add_argument("--runs", type=number(MOST_RUNS, "number of inputs"), metavar="N", help="inputs of each target in the place of a time")
    parser.add_argument("--seed", type=number(2 ** 32 - 1, "seed"), default=1, metavar="N", help="of the random numbers; default 1")
    parser.add_argument("--json", metavar="FILE", help="also writes the table as JSON")
    parser.add_argument("--reproduce", type=some_input, metavar="FILE", help="one input of one target, with what is said about it")
    parser.add_argument("--minimise", action="store_true", help="writes tests/fuzz/corpus/ again: few small inputs that enter the same code")
    parser.add_argument("--record", action="store_true", help="adds the runs to docs/trust/fuzz.tsv, from which docs/trust.md is made")
    parser.add_argument("--list", action="store_true", help="prints the targets and what they do")
    parser.add_argument("--targets", action="store_true", help=argparse.SUPPRESS)  # for ./run: what to build
    arguments = parser.parse_args(words)
    if arguments.reproduce and len(arguments.target) != 1:
        parser.error("--reproduce needs one target, whose input it is")
    if arguments.seconds and arguments.runs:
        parser.error("--seconds and --runs, expected one of them")
    if not arguments.target:
        arguments.target = list(target_list.NAMES)
    return arguments


# -------------------------------------------------------------------------------------------------------------- fuzzing
def folder(*names):
    path = BUILD.joinpath(*names)
    path.mkdir(parents=True, exist_ok=True)
    return path


def program(name):
    path = BUILD / "tests" / "fuzz" / f"fuzz_{name}"
    if not path.exists():
        sys.exit(f"fuzz: {path.relative_to(ROOT)} is not there, ./run fuzz {name} builds it")
    return path


def call(name, words, asan="", **options):
    """libFuzzer with the limits that define a finding; standard input is empty, because a path may name it."""
    target = target_list.find(name)
    # Freed memory of an input is kept until 16 MB more are freed: with the default of libFuzzer processors and forks are slow.
    environment = {**os.environ, "ASAN_OPTIONS": f"detect_leaks=1:max_allocation_size_mb=4096:quarantine_size_mb=16:malloc_context_size=8:{target.asan}:{asan}",
                   "UBSAN_OPTIONS": "print_stacktrace=1"}
    # Entropic counts rare features of all inputs, for which it takes a third of the time.
    limits = [f"-max_len={target.longest}", "-timeout=10", "-rss_limit_mb=2048", "-malloc_limit_mb=256"]
    words = [program(name), "-entropic=0", "-print_funcs=0", *limits, *target.flags, *words]
    return subprocess.run(words, cwd=BUILD, env=environment, stdin=subprocess.DEVNULL, check=False, **options)


def statistic(log, name):
    found = re.search(rf"^stat::{name}: +([0-9]+)$", log, re.M)
    return int(found.group(1)) if found else 0


def findings(path):
    return {each.name for each in path.iterdir()}


def fuzz(name, arguments):
    """Fuzzes one target; the output of libFuzzer is kept in build/fuzz/NAME.log."""
    found = folder("findings", name)
    before = findings(found)
    log_file = BUILD / f"{name}.log"
    limit = [f"-runs={arguments.runs}"] if arguments.runs else [f"-max_total_time={arguments.seconds or 30}"]
    begin = datetime.datetime.now()
    with log_file.open("w", encoding="utf-8") as log:
        result = call(name, [*limit, f"-seed={arguments.seed}", f"-artifact_prefix={found}/", "-print_final_stats=1",
                             folder("corpus", name), corpora.of(name)], stdout=log, stderr=subprocess.STDOUT)
    text = log_file.read_text(encoding="utf-8", errors="replace")
    new = sorted(findings(found) - before)
    return {"target": name, "inputs": statistic(text, "number_of_executed_units"),
            "seconds": round((datetime.datetime.now() - begin).total_seconds()), "seed": arguments.seed,
            "found": [str((found / each).relative_to(ROOT)) for each in new], "failed": result.returncode != 0, "log": text}


def tell(outcome):
    """A line of the table; for a finding its place, its kind, and how to reproduce it."""
    rate = outcome["inputs"] // max(1, outcome["seconds"])
    found = ", ".join(outcome["found"]) or ("failed" if outcome["failed"] else "nothing")
    print("\t".join(map(str, [outcome["target"], outcome["inputs"], outcome["seconds"], rate, found])), flush=True)
    if not outcome["failed"]:
        return
    said = re.findall(r"^(?:.*(?:ERROR: |runtime error: |broken promise: |  what\(\)).*)$", outcome["log"], re.M)
    for line in (said or outcome["log"].splitlines()[-5:])[:4]:
        print(f"fuzz: {line.strip()}", file=sys.stderr)
    for path in outcome["found"]:
        print(f"fuzz: to see it again: ./run fuzz {outcome['target']} --reproduce {path}", file=sys.stderr)


def record(outcomes):
    for each in outcomes:
        records.add("fuzz.tsv", each["target"], each["seed"], each["inputs"], each["seconds"], len(each["found"]))


def main(words):
    arguments = parse(words)
    if arguments.targets:
        print(" ".join(f"fuzz_{name}" for name in arguments.target))
        return 0
    if arguments.list:
        for each in target_list.TARGETS:
            print(f"{each.name}\t{each.what}")
        return 0
    if arguments.reproduce:
        return 1 if call(arguments.target[0], [arguments.reproduce], asan="symbolize=1").returncode else 0
    if arguments.minimise:
        for name in arguments.target:
            corpora.minimise(name, folder("corpus", name), call)
        return 0
    print("\t".join(HEAD), flush=True)
    outcomes = []
    for name in arguments.target:
        outcomes.append(fuzz(name, arguments))
        tell(outcomes[-1])
    if arguments.record:
        record(outcomes)
    if arguments.json:
        kept = [{key: value for key, value in each.items() if key != "log"} for each in outcomes]
        pathlib.Path(arguments.json).write_text(json.dumps(kept, indent=2) + "\n", encoding="utf-8")
    return 1 if any(each["failed"] for each in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
