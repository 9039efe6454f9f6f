"""The effect of faults on the outputs of dsdpv1-sim: each fault is applied to each output, and docs/robustness.md has the table.

    outputs.py DSDPV1_SIM           does all and compares the table with the page
    outputs.py DSDPV1_SIM --write   ... and writes it
"""
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import files
import signals
import streams
from commands import OF_CAPTURES, OF_RTL, OUTPUTS, SAVES, SCENARIO, SPEAKERS, make_captures, make_case
from page import compare, replace_table
from place import HERE, Failure, Place, check
from whole import read

ROOT = os.path.dirname(os.path.dirname(HERE))
PAGE = os.path.join(ROOT, "docs", "robustness.md")
TABLE = "outputs"

ALL = OUTPUTS + OF_CAPTURES + OF_RTL
SIMULATING = [output for output in ALL if output.simulates]
RUNNING = [output for output in ALL if output.endless]
QUICK = [output for output in ALL if output.kind != "stimulus"]  # which takes a second of random cases
VARYING = ("result", "tsv", "report")  # in length


def of_kinds(outputs, *kinds):
    return [output for output in outputs if output.kind in kinds]


FAULTS = [
    ("disk full from the start", files.full_at_start, ALL),
    ("disk full in the middle, a file is there already", files.full_in_the_middle, ALL),
    ("disk full at the last byte", files.full_at_the_last_byte, [output for output in QUICK if output.kind not in VARYING]),
    ("link to a full device", files.full_device, QUICK + SAVES),
    ("folder not writable", files.folder_not_writable, QUICK),
    ("file is there, not writable", files.file_not_writable, ALL + SAVES),
    ("is a folder", files.is_a_folder, ALL + SAVES),
    ("SIGINT while running", signals.interrupted, RUNNING),
    ("SIGTERM while running", signals.terminated, RUNNING),
    ("SIGHUP while running", signals.hung_up, RUNNING),
    ("SIGKILL while running", signals.kill, RUNNING),
    ("... and then `recover FILE.PID.part`", signals.killed_and_recovered, of_kinds(SIMULATING, "wave .fst", "wave .vcd")),
    ("SIGINT during start-up", signals.interrupted_at_start, SIMULATING),
    ("SIGTERM during start-up", signals.terminated_at_start, SIMULATING),
    ("SIGKILL during start-up", signals.killed_at_start, SIMULATING),
    ("two at once, both interrupted", signals.two_at_once, RUNNING),
    ("is the scenario", files.own_scenario, SIMULATING),
    ("is a link to another input of the command", files.other_input, [output for output in ALL + SAVES if output.other_input]),
    ("is another output of the command, too", files.twice, [output for output in ALL if output.other]),
    ("is the file that standard output goes to", streams.standard_outputs_file, QUICK + SAVES),
    ("links to a terminal", streams.device, QUICK),
    ("links to /dev/null, another output too", streams.null_twice, SIMULATING),
    ("is a FIFO", streams.fifo, ALL),
    ("is a FIFO whose reader goes away while running", streams.fifo_reader_gone,
     of_kinds(SIMULATING, "wave .vcd", "log", "log .jsonl", "trace", "capture")),
    ("SIGINT while another output is a FIFO whose reader does not read", streams.full_pipe_and_interrupted, SIMULATING),
    ("links to a file in another folder", files.link, QUICK + SAVES),
    ("links to a file that is not there yet", files.dangling_link, QUICK + SAVES),
    ("name of 249 characters", files.name_249, QUICK),
    ("name of 255 characters", files.name_255, QUICK),
    ("name of 256 characters", files.name_256, QUICK),
    ("standard output full from the start", streams.stdout_full, SPEAKERS),
    ("standard output full in the middle", streams.stdout_full_in_the_middle, SPEAKERS),
    ("standard output closed", streams.stdout_closed, SPEAKERS),
    ("reader of standard output gone (`\\| head -1`)", streams.stdout_reader_gone, SPEAKERS),
]


def prepare(program, folder):
    """The inputs of all, and each output without a fault."""
    with open(os.path.join(folder, "s.yaml"), "w", encoding="UTF-8") as file:
        file.write(SCENARIO)
    shutil.copy(os.path.join(ROOT, "scenarios", "dsdpv1.gsd"), os.path.join(folder, "device.gsd"))
    os.symlink("/dev/null", os.path.join(folder, "nowhere.vcd"))
    subprocess.run([program, "run", "s.yaml", "--quiet", "--log", "whole.log", "--log-whole"], cwd=folder, check=True)
    make_captures(program, folder)
    make_case(program, folder)
    place = Place(program, OUTPUTS[0], folder)
    try:
        signals.kill(place)
        part = place.part()
        for ending in ("", ".hier"):
            shutil.copy(place.file(part + ending), os.path.join(folder, "killed.fst.1.part" + ending))
    finally:
        place.close()
    for output in [*ALL, *SAVES, SPEAKERS[0]]:
        done = subprocess.run([program, *output.command()], cwd=folder, capture_output=True, check=False)
        check(done.returncode == output.usual, "%s: exit %d, %s" % (output.name, done.returncode, done.stderr.decode()))
        output.reference = read(os.path.join(folder, output.file))
        for name in (output.file, *output.besides):
            os.remove(os.path.join(folder, name))


def one(program, folder, fault, function, output):
    place = Place(program, output, folder)
    try:
        return function(place)
    except Exception as error:
        raise Failure("%s, %s: %s" % (fault, output.name, error)) from error
    finally:
        place.close()


def rows(program, folder):
    """For each fault, outputs with the same result share a row."""
    with ThreadPoolExecutor(4) as pool:
        jobs = [(fault, output, pool.submit(one, program, folder, fault, function, output))
                for fault, function, outputs in FAULTS for output in outputs]
    failures = [str(job.exception()) for _, _, job in jobs if job.exception()]
    check(not failures, "\n".join(failures))
    outcomes = {}
    for fault, output, job in jobs:
        outcomes.setdefault((fault, *job.result()), []).append(output)
    return outcomes


def who(outputs):
    """A command alone means all of its outputs."""
    for every, words in ((ALL, "all"), (ALL + SAVES, "all"), (QUICK, "all but rtl-random (stimulus)"), (QUICK + SAVES, "all but rtl-random (stimulus)")):
        if outputs == every:
            return words
    texts = []
    for command in dict.fromkeys(output.words[0] for output in outputs):
        kinds = [output.kind for output in outputs if output.words[0] == command]
        every = [output.kind for output in ALL if output.words[0] == command]  # the save files are listed separately
        texts.append(command if kinds == every or not kinds[0] else "%s (%s)" % (command, ", ".join(kinds)))
    return ", ".join(texts)


def table(outcomes):
    lines = ["| fault | output | left on disk | exit code | the line |", "|---|---|---|---|---|"]
    for (fault, left, status, line), outputs in outcomes.items():
        lines.append("| %s | %s | %s | %s | %s |" % (fault, who(outputs), left, status, "`%s`" % line if line else ""))
    return "\n".join(lines)


def main(program, *options):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_faults_") as folder:
        prepare(program, folder)
        text = table(rows(program, folder))
    if "--write" in options:
        return replace_table(PAGE, TABLE, text)
    return compare(PAGE, TABLE, text, "tests/faults/outputs.py DSDPV1_SIM --write")


if __name__ == "__main__":
    try:
        main(os.path.abspath(sys.argv[1]), *sys.argv[2:])
    except Failure as failure:
        sys.exit(str(failure))
