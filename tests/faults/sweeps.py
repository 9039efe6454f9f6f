"""The effect of faults on the folder of dsdpv1-sim sweep: each fault is applied, and docs/robustness.md has the table.

    sweeps.py DSDPV1_SIM           does all and compares the table with the page
    sweeps.py DSDPV1_SIM --write   ... and writes it
"""
import os
import shutil
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from folder import LONG, QUICK, SCENARIO, Missed, OfSweep, SweepPlace, undisturbed
from page import compare, replace_table
from place import HERE, Failure, check
from sweep_faults import FAULTS

ROOT = os.path.dirname(os.path.dirname(HERE))
PAGE = os.path.join(ROOT, "docs", "robustness.md")
TABLE = "sweeps"
ATTEMPTS = 20  # to hold a run in time


def attempt(program, kept, function, parameter, reference):
    place = SweepPlace(program, OfSweep(parameter), kept, reference)
    try:
        fault = function(place)
        row = next(fault)
        check(next(fault, None) is None, "two rows")
        return [*row, place.again()]
    finally:
        place.close()


def one(program, kept, fault, function, parameter, reference):
    for _ in range(ATTEMPTS):
        try:
            return [fault, *attempt(program, kept, function, parameter, reference)]
        except Missed:
            pass
        except Exception as error:
            raise Failure("%s: %s" % (fault, error)) from error
    raise Failure("%s: no run could be held in %d attempts" % (fault, ATTEMPTS))


def rows(program, folder):
    kept = os.path.join(folder, "kept")
    references = {}
    for parameter in (QUICK, LONG):
        references[parameter] = undisturbed(program, OfSweep(parameter), kept)
        shutil.rmtree(os.path.join(kept, "whole"))
    with ThreadPoolExecutor(4) as pool:
        jobs = [pool.submit(one, program, kept, fault, function, parameter, references[parameter])
                for fault, function, parameter in FAULTS]
    failures = [str(job.exception()) for job in jobs if job.exception()]
    check(not failures, "\n".join(failures))
    return [job.result() for job in jobs]


def table(all_rows):
    lines = ["| fault | left in its folder | exit code | the line | the same command again says |", "|---|---|---|---|---|"]
    for fault, left, status, *said in all_rows:
        lines.append("| %s |" % " | ".join([fault, left, status, *("`%s`" % line if line else "" for line in said)]))
    return "\n".join(lines)


def main(program, *options):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_faults_") as folder:
        os.mkdir(os.path.join(folder, "kept"))
        with open(os.path.join(folder, "kept", "s.yaml"), "w", encoding="UTF-8") as file:
            file.write(SCENARIO)
        shutil.copy(os.path.join(ROOT, "scenarios", "dsdpv1.gsd"), os.path.join(folder, "kept", "a.gsd"))
        text = table(rows(program, folder))
    if "--write" in options:
        return replace_table(PAGE, TABLE, text)
    return compare(PAGE, TABLE, text, "tests/faults/sweeps.py DSDPV1_SIM --write")


if __name__ == "__main__":
    try:
        main(os.path.abspath(sys.argv[1]), *sys.argv[2:])
    except Failure as failure:
        sys.exit(str(failure))
