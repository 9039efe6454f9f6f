"""What faults do to the outputs of dsdpv1-sim: each fault is done to each output, and docs/robustness.md has the table.

    outputs.py DSDPV1_SIM           does all and compares the table with the page
    outputs.py DSDPV1_SIM --write   ... and writes it
"""
import difflib
import os
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import tty
from concurrent.futures import ThreadPoolExecutor

from page import read_table, replace_table
from place import DEADLINE, ENDLESS, HERE, OTHER, OUTPUTS, SCENARIO, Failure, Output, Place, check, wait_for
from whole import read, same

ROOT = os.path.dirname(os.path.dirname(HERE))
PAGE = os.path.join(ROOT, "docs", "robustness.md")
TABLE = "outputs"


# --- faults: each does something to the place's output and returns what is left, the exit code, the line -------------------

def full_at_start(place):
    return place.do(faults="fsize=0")


def full_in_the_middle(place):
    place.make()
    return place.do(faults="fsize=%d" % (len(place.output.reference) // 2))


def full_at_the_last_byte(place):
    return place.do(faults="fsize=%d" % (len(place.output.reference) - 1))


def full_device(place):
    os.symlink("/dev/full", place.file())
    return place.do()


def folder_not_writable(place):
    os.mkdir(place.file("folder"), 0o555)
    row = place.do(os.path.join("folder", place.output.file), faults="user")
    check(not os.listdir(place.file("folder")), "something was written")
    return row


def file_not_writable(place):
    place.make()
    os.chmod(place.file(), 0o444)
    return place.do(faults="user")


def is_a_folder(place):
    os.mkdir(place.file())
    return place.do()


def running(place, number):
    process = place.start(place.output.command(more=ENDLESS))
    first = process.stderr.read(1)  # of the progress bar
    process.send_signal(number)
    return place.end(process, first)


def interrupted(place):
    return running(place, signal.SIGINT)


def terminated(place):
    return running(place, signal.SIGTERM)


def hung_up(place):
    return running(place, signal.SIGHUP)


def kill(place):
    """When there is something to be read; of FST, more than its head."""
    process = place.start(place.output.command(more=ENDLESS))
    process.stderr.read(1)
    place.part(something=place.output.name != "result")
    process.kill()
    return place.end(process, b"\r\x1b[K")


def killed(place):
    row = kill(place)
    return [row[0], row[1], ""]


def killed_and_recovered(place):
    kill(place)
    part = place.part()
    done = subprocess.run([place.program, "recover", part], cwd=place.path, capture_output=True, check=False, timeout=DEADLINE)
    line = place.line(done.stdout + done.stderr)
    place.inputs |= {part, part + ".hier"}
    check(os.path.getsize(place.file()) > 1000, "the recovered wave is small")
    return [place.left(early=True), str(done.returncode), line]


def starting(place, number):
    """The start is held at a FIFO that nobody reads: the file that is opened after the output's. Of the trace, which is the last, the one
    before it, and the result is there already."""
    hold = ["--wave", "hold.vcd", "--result", "held.json"] if place.output.name == "trace" else ["--trace", "hold.vcd"]
    os.mkfifo(place.file("hold.vcd"))
    process = place.start(place.output.command(more=ENDLESS + hold))
    part = place.part()
    if place.output.name == "wave .fst":
        wait_for(lambda: os.path.exists(place.file(part + ".hier")), "FST's second file")
    process.send_signal(number)
    process.wait(DEADLINE)
    place.inputs.add("hold.vcd")
    if part.startswith("held") and number == signal.SIGKILL:
        place.inputs.add(part)
    return place.end(process)


def interrupted_at_start(place):
    return starting(place, signal.SIGINT)


def terminated_at_start(place):
    return starting(place, signal.SIGTERM)


def killed_at_start(place):
    return starting(place, signal.SIGKILL)


def two_at_once(place):
    """Both are running before the first of them ends."""
    processes = [place.start(place.output.command(more=ENDLESS)) for _ in range(2)]
    for process in processes:
        process.stderr.read(1)
    place.part()
    processes[0].send_signal(signal.SIGINT)
    first = place.end(processes[0], b"\r")
    check(first[0].startswith("FILE complete, FILE.PID.part"), "after the first there is " + first[0])
    processes[1].send_signal(signal.SIGINT)
    second = place.end(processes[1], b"\r")
    check(first[1:] == second[1:], "the two differ: %s, %s" % (first, second))
    return second


def own_scenario(place):
    os.rename(place.file("s.yaml"), place.file())
    words = [word if word != "s.yaml" else place.output.file for word in place.output.command()]
    place.inputs.add(place.output.file)
    row = place.end(place.start(words))
    check(read(place.file()) == SCENARIO.encode(), "the scenario was replaced")
    return row


def own_gsd(place):
    os.symlink("device.gsd", place.file())
    return place.do()


def own_part(place):
    os.link(place.file("killed.fst.1.part"), place.file())
    place.inputs.add(place.output.file)
    return place.do()


def twice(place):
    return place.do(more=[OTHER[place.output.words[-1]], "./" + place.output.file])


def standard_outputs_file(place):
    place.inputs.add(place.output.file)
    with open(place.file(), "wb") as file:
        row = place.end(place.start(place.output.command(), stdout=file))
        check(os.stat(file.fileno()).st_nlink == 1 and os.path.getsize(place.file()) == 0, "it was replaced or written to")
    return row


def device(place):
    """A terminal, by its name."""
    master, slave = os.openpty()
    tty.setraw(slave)
    got = []
    os.symlink(os.ttyname(slave), place.file())  # a wave's name must have the ending of its format
    process = place.start(place.output.command())
    reader = threading.Thread(target=drain, args=(master, got))
    reader.start()
    row = place.end(process)
    os.close(slave)
    reader.join(DEADLINE)
    os.close(master)
    check(row[1] != "0" or same(b"".join(got), place.output.reference), "the terminal got something else")
    return row


def drain(descriptor, got):
    try:
        while data := os.read(descriptor, 65536):
            got.append(data)
    except OSError:  # the other side is closed
        pass


def null_twice(place):
    option = OTHER[place.output.words[-1]]
    for name in (place.output.file, "other"):
        os.symlink("/dev/null", place.file(name))
    place.inputs.add("other")
    return place.do(more=[option, "other"])


def join_reader(place, reader):
    """It still waits for a writer when the program has refused to be one."""
    while reader.is_alive():
        try:
            os.close(os.open(place.file(), os.O_WRONLY | os.O_NONBLOCK))
        except OSError:  # it is not in its open, not yet or no more
            pass
        reader.join(0.01)


def fifo(place):
    os.mkfifo(place.file())
    got = []
    reader = threading.Thread(target=lambda: got.append(read(place.file())), daemon=True)
    reader.start()
    row = place.do()
    join_reader(place, reader)
    check(row[1] != "0" or same(got[0], place.output.reference), "the FIFO's reader got something else")
    return row


def fifo_reader_gone(place):
    """In the middle of a run that would take hours."""
    os.mkfifo(place.file())
    process = place.start(place.output.command(more=ENDLESS))
    reader = threading.Thread(target=lambda: open(place.file(), "rb", buffering=0).close(), daemon=True)  # pylint: disable=R1732
    reader.start()
    row = place.end(process)
    join_reader(place, reader)
    return row


def full_pipe_and_interrupted(place):
    """Another output waits for its reader when the signal comes: it goes on afterwards, and no output is spoilt."""
    os.mkfifo(place.file("pipe"))
    process = place.start(place.output.command(more=ENDLESS + ["--log" if place.output.name == "trace" else "--trace", "pipe"]))
    with open(place.file("pipe"), "rb", buffering=0) as pipe:
        writer = os.open(place.file("pipe"), os.O_WRONLY | os.O_NONBLOCK)
        wait_for(lambda: not select.select([], [writer], [], 0)[1], "a pipe that takes no more")
        os.close(writer)
        process.send_signal(signal.SIGINT)
        while pipe.read(1 << 16):
            pass
    place.inputs.add("pipe")
    return place.end(process)


def link(place):
    os.mkdir(place.file("far"))
    place.make("far/there")
    os.symlink("far/there", place.file())
    row = place.do()
    check(same(read(place.file("far/there")), place.output.reference), "the link's target is not the output")
    return ["the link's target complete, " + row[0].split(", ")[0], *row[1:]]


def dangling_link(place):
    os.symlink("there", place.file())
    row = place.do()
    place.inputs.add("there")
    return [row[0].replace("there", "the link's target"), *row[1:]]


def long_name(place, length):
    ending = os.path.splitext(place.output.file)[1]
    return place.do("n" * (length - len(ending)) + ending)


def name_249(place):
    return long_name(place, 249)


def name_255(place):
    return long_name(place, 255)


def name_256(place):
    return long_name(place, 256)


# --- standard output ------------------------------------------------------------------------------------------------------

def stdout_full(place):
    with open("/dev/full", "wb") as full:
        return place.end(place.start(place.output.command(), stdout=full))


def stdout_full_in_the_middle(place):
    """The limit is far beyond the run's files; what is said begins a few bytes before it."""
    limit = 100_000_000
    with tempfile.TemporaryFile() as file:
        file.seek(limit - 100)
        return place.end(place.start(place.output.command(), "fsize=%d" % limit, stdout=file))


def stdout_closed(place):
    return place.end(place.start(place.output.command(), "closed"))


def stdout_reader_gone(place):
    reader, writer = os.pipe()
    os.close(reader)
    row = place.end(place.start(place.output.command(), stdout=writer))
    os.close(writer)
    return row


# --- all of them ----------------------------------------------------------------------------------------------------------

ALL = {output.name for output in OUTPUTS}
RUNS = {output.name for output in OUTPUTS if output.of_run}
SAID = {"run", "schema", "reasons", "gsd", "decode"}
SPEAKERS = [Output("run", "o.log", ["run", "s.yaml", "--log"])] + [Output(words[0], "", words) for words in (
    ["schema"], ["reasons"], ["gsd", "device.gsd"], ["decode", "whole.log"])]
FAULTS = [
    ("disk full from the start", full_at_start, ALL),
    ("disk full in the middle, a file is there already", full_in_the_middle, ALL),
    ("disk full at the last byte", full_at_the_last_byte, ALL - {"result"}),  # its length varies
    ("link to a full device", full_device, ALL),
    ("folder not writable", folder_not_writable, ALL),
    ("file is there, not writable", file_not_writable, ALL),
    ("is a folder", is_a_folder, ALL),
    ("SIGINT while running", interrupted, RUNS),
    ("SIGTERM while running", terminated, RUNS),
    ("SIGHUP while running", hung_up, RUNS),
    ("SIGKILL while running", killed, RUNS),
    ("... and then `recover FILE.PID.part`", killed_and_recovered, {"wave .fst", "wave .vcd"}),
    ("SIGINT during start-up", interrupted_at_start, RUNS),
    ("SIGTERM during start-up", terminated_at_start, RUNS),
    ("SIGKILL during start-up", killed_at_start, RUNS),
    ("two runs at once, both interrupted", two_at_once, RUNS),
    ("is the run's scenario", own_scenario, RUNS),
    ("links to the scenario's GSD", own_gsd, RUNS),
    ("is what is recovered", own_part, {"recover"}),
    ("is another output of the run, too", twice, RUNS),
    ("is the file that standard output goes to", standard_outputs_file, ALL),
    ("links to a terminal", device, ALL),
    ("links to /dev/null, another output too", null_twice, RUNS),
    ("is a FIFO", fifo, ALL),
    ("is a FIFO whose reader goes away while running", fifo_reader_gone, RUNS - {"wave .fst", "result"}),
    ("SIGINT while another output is a FIFO whose reader does not read", full_pipe_and_interrupted, RUNS),
    ("links to a file in another folder", link, ALL),
    ("links to a file that is not there yet", dangling_link, ALL),
    ("name of 249 characters", name_249, ALL),
    ("name of 255 characters", name_255, ALL),
    ("name of 256 characters", name_256, ALL),
    ("standard output full from the start", stdout_full, SAID),
    ("standard output full in the middle", stdout_full_in_the_middle, SAID),
    ("standard output closed", stdout_closed, SAID),
    ("reader of standard output gone (`\\| head -1`)", stdout_reader_gone, SAID),
]


def prepare(program, folder):
    """The inputs of all, and what each output is without a fault."""
    with open(os.path.join(folder, "s.yaml"), "w", encoding="UTF-8") as file:
        file.write(SCENARIO)
    shutil.copy(os.path.join(ROOT, "scenarios", "dsdpv1.gsd"), os.path.join(folder, "device.gsd"))
    subprocess.run([program, "run", "s.yaml", "--quiet", "--log", "whole.log", "--log-whole"], cwd=folder, check=True)
    place = Place(program, OUTPUTS[0], folder)
    try:
        kill(place)
        part = place.part()
        for ending in ("", ".hier"):
            shutil.copy(place.file(part + ending), os.path.join(folder, "killed.fst.1.part" + ending))
    finally:
        place.close()
    for output in OUTPUTS + SPEAKERS[:1]:
        subprocess.run([program, *output.command()], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        output.reference = read(os.path.join(folder, output.file))
        os.remove(os.path.join(folder, output.file))


def one(program, folder, fault, function, output):
    place = Place(program, output, folder)
    try:
        return function(place)
    except Exception as error:
        raise Failure("%s, %s: %s" % (fault, output.name, error)) from error
    finally:
        place.close()


def rows(program, folder):
    """Of each fault, the outputs to which the same happens stand in one row."""
    with ThreadPoolExecutor(4) as pool:
        jobs = [(fault, output.name, pool.submit(one, program, folder, fault, function, output))
                for fault, function, names in FAULTS for output in (SPEAKERS if names is SAID else OUTPUTS) if output.name in names]
    failures = [str(job.exception()) for _, _, job in jobs if job.exception()]
    check(not failures, "\n".join(failures))
    outcomes = {}
    for fault, name, job in jobs:
        outcomes.setdefault((fault, *job.result()), []).append(name)
    return outcomes


def table(outcomes):
    lines = ["| fault | output | left on disk | exit code | the line |", "|---|---|---|---|---|"]
    faults = [key[0] for key in outcomes]
    for (fault, left, status, line), names in outcomes.items():
        who = "all" if faults.count(fault) == 1 and len(names) > 4 else ", ".join(names)
        lines.append("| %s | %s | %s | %s | %s |" % (fault, who, left, status, "`%s`" % line if line else ""))
    return "\n".join(lines)


def main(program, *options):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_faults_") as folder:
        prepare(program, folder)
        text = table(rows(program, folder))
    if "--write" in options:
        return replace_table(PAGE, TABLE, text)
    there = read_table(PAGE, TABLE)
    if there != text:
        sys.stdout.writelines(line + "\n" for line in difflib.unified_diff(there.splitlines(), text.splitlines(), "docs/robustness.md", "done", lineterm=""))
        sys.exit("docs/robustness.md is stale: tests/faults/outputs.py DSDPV1_SIM --write, and read the difference")
    return None


if __name__ == "__main__":
    try:
        main(os.path.abspath(sys.argv[1]), *sys.argv[2:])
    except Failure as failure:
        sys.exit(str(failure))
