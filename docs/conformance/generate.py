#!/usr/bin/env python3
"""Writes docs/conformance.md, docs/test_plan.md and the table of clauses in docs/architecture.md from the YAML files of this folder, and checks these.

    generate.py                             write them; exit 1 and a line per fault when the data are not true or not complete
    generate.py --check                     write nothing; exit 1 also when one of them is stale
    generate.py --released              as --check, and exit 1 when a test that they name is newer than the recorded run
    generate.py --report PAGE --run TESTS   write the conformance page with the results of a run, TESTS being ctest's JUnit report; exit 1
                                            when a test of a clause failed or was not run
    generate.py --record --run TESTS        take these results into last_run.txt, then write them

Beside TESTS stands tests.commit, the commit that was tested; ./run test writes both.
--root FOLDER: another project than the one this file is in. Bad data: one line, exit 2.

Examples:
    docs/conformance/generate.py --check
    docs/conformance/generate.py --report build/conformance.md --run build/default/tests.xml
    docs/conformance/generate.py --record --run build/default/tests.xml
"""
import argparse
import datetime
import pathlib
import sys

import check
import data as source
from known_tests import KnownTests
import pages
import results


def texts(root, data):
    run = results.read_record(root / results.RECORD)
    known = KnownTests(root)
    return {"docs/conformance.md": pages.conformance(root, known, data, run), "docs/test_plan.md": pages.test_plan(known, data),
            "docs/architecture.md": pages.architecture(root, data)}


def write(root, data):
    for name, text in texts(root, data).items():
        (root / name).write_text(text, encoding="utf-8")


def stale(root, data):
    for name, text in texts(root, data).items():
        path = root / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            yield f"{name}:1: stale; ./run generate writes it again"


def unrecorded(root, data):
    newer = results.read_record(root / results.RECORD).newer(data.test_names)
    if newer:
        yield (f"{results.RECORD}:1: {len(newer)} of the {len(data.test_names)} tests that rulings and clauses name are newer than this run, as {newer[0]}; "
               "./run test, then ./run conformance --record")


def run_of(report, data):
    commit = report.with_suffix(".commit")
    for path in (report, commit):
        if not path.exists():
            raise source.BadData(f"{path}:1: there is no such file; ./run test makes it")
    date = datetime.datetime.fromtimestamp(report.stat().st_mtime, datetime.timezone.utc).date().isoformat()
    return results.run_of(report, data.test_names, commit.read_text(encoding="utf-8").strip(), date)


def judge(run):
    unknown = [name for name, result in sorted(run.results.items()) if result.total == 0]
    if unknown:
        more = f" and {len(unknown) - 5} more" if len(unknown) > 5 else ""
        yield f"conformance: named by rulings and clauses, but not run: {', '.join(unknown[:5])}{more}"
    for case in sorted({case for result in run.results.values() for case in result.failed}):
        yield f"conformance: {case} failed"


def report(root, data, page, run):
    page.write_text(pages.conformance(root, KnownTests(root), data, run), encoding="utf-8")
    clauses = [clause for document in data.documents for clause in document.clauses]
    number, _, reasoned, neither, good, bad, absent = pages.counts(clauses, run)
    print(f"conformance: {number} clauses: {good} passed, {bad} failed, {absent} not run, {reasoned} cannot have a test, {neither} have none: {page}")
    return list(judge(run))


def main():
    here = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=here)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--check", action="store_true")
    what.add_argument("--released", action="store_true")
    what.add_argument("--report", type=pathlib.Path, metavar="PAGE")
    what.add_argument("--record", action="store_true")
    parser.add_argument("--run", type=pathlib.Path, metavar="TESTS")
    arguments = parser.parse_args()
    if bool(arguments.run) != bool(arguments.report or arguments.record):
        parser.error("--run goes with --report and --record, and these need it")
    root = arguments.root
    try:
        data = source.load(root)
        faults = list(check.check(root, data))
        if arguments.check or arguments.released:
            faults += stale(root, data)
            if arguments.released:
                faults += unrecorded(root, data)
        elif arguments.report:
            faults += report(root, data, arguments.report, run_of(arguments.run, data))
        else:
            if arguments.record:
                results.write_record(root / results.RECORD, run_of(arguments.run, data))
            write(root, data)
    except source.BadData as bad:
        print(bad, file=sys.stderr)
        return 2
    if faults or not arguments.report:
        print("\n".join(faults) or "conformance: right")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
