"""Faults of sweeps. Each yields the remaining files, the exit code, the line, and removes the fault afterwards."""
import os
import shutil
import signal

import streams
from folder import ALL, FOLDER, LONG, POINTS, QUICK, RESULTS, OfSweep, wait_for_pending, wait_for_the_end_of
from place import DEADLINE, check
from whole import read


def same_rows(rows):
    check(all(row == rows[0] for row in rows), "the kinds differ: %s" % rows)
    return rows[0]


# --- disk, permissions, names ---------------------------------------------------------------------------------------------

def full_at_start(place):
    yield place.do(faults="fsize=0")


def full_at_the_first_point(place):
    """The result of the run, which is indented, does not fit; the same in the point's file, without spaces, would."""
    yield place.do(faults="fsize=%d" % (len(place.reference[POINTS[0]]) + 100))


def full_at_the_second_point(place):
    place.sweep_but(POINTS[1], *RESULTS)
    yield place.do(faults="fsize=4096")


def full_at_the_results(place):
    place.sweep_but(*RESULTS)
    yield place.do(faults="fsize=%d" % (len(place.reference["results.csv"]) - 1))


def full_device(place):
    place.sweep_but(*RESULTS)
    os.symlink("/dev/full", place.own("map.svg"))
    yield place.do()
    os.remove(place.own("map.svg"))


def no_descriptor(place):
    yield place.do(faults="nofile=5")


def cannot_be_made(place):
    os.chmod(place.path, 0o555)
    yield place.do(faults="user")
    os.chmod(place.path, 0o755)


def not_writable(place):
    os.mkdir(place.file(), 0o555)
    yield place.do(faults="user")
    os.chmod(place.file(), 0o755)


def points_not_writable(place):
    place.sweep_but(POINTS[1], *RESULTS)
    os.chmod(place.own("points"), 0o555)
    yield place.do(faults="user")
    os.chmod(place.own("points"), 0o755)


def results_not_writable(place):
    place.sweep_but(*RESULTS)
    place.make(os.path.join(FOLDER, "results.csv"))
    os.chmod(place.own("results.csv"), 0o444)
    yield place.do(faults="user")
    os.chmod(place.own("results.csv"), 0o644)


def is_a_file(place):
    place.make()
    yield place.do()
    os.remove(place.file())


def holds_something_else(place):
    """Results without a sweep's description count as something else."""
    rows = []
    for name in ("thesis.txt", "results.csv"):
        os.mkdir(place.file())
        place.make(os.path.join(FOLDER, name))
        row = place.do()
        rows.append([row[0].replace(name, "the other file"), *row[1:]])
        shutil.rmtree(place.file())
    yield same_rows(rows)


# --- signals --------------------------------------------------------------------------------------------------------------

def running(place, number):
    """The run is stopped until the sweep has told it to end."""
    sweep, run = place.start_and_hold()
    sweep.send_signal(number)
    wait_for_pending(run, signal.SIGTERM)
    os.kill(run, signal.SIGCONT)
    yield place.end(sweep)


def interrupted(place):
    yield from running(place, signal.SIGINT)


def terminated(place):
    yield from running(place, signal.SIGTERM)


def hung_up(place):
    yield from running(place, signal.SIGHUP)


def killed(place):
    """Its run ends with it, and neither has time to remove anything."""
    sweep, run = place.start_and_hold()
    sweep.kill()
    wait_for_the_end_of(run)
    yield place.end(sweep)


def run_killed(place):
    sweep, run = place.start_and_hold()
    os.kill(run, signal.SIGKILL)
    yield place.end(sweep)


def run_killed_twice(place):
    sweep, run = place.start_and_hold()
    os.kill(run, signal.SIGKILL)
    os.kill(place.hold(sweep, run), signal.SIGKILL)
    yield place.end(sweep)


# --- two at once ----------------------------------------------------------------------------------------------------------

def second_one(place):
    """The first one continues undisturbed."""
    sweep, run = place.start_and_hold()
    second = place.start(place.output.command())
    _, errors = second.communicate(timeout=DEADLINE)
    check("process id %d " % sweep.pid in errors.decode(), "it names another: " + errors.decode())
    os.kill(run, signal.SIGCONT)
    first = place.end(sweep)
    check(first[1:] == ["0", ""], "the first: %s" % first)
    yield [first[0], place.status(second.returncode), place.line(errors)]


def both_at_start(place):
    """Which one is first is random, as is whether it ends before the other begins."""
    both = [place.start(place.output.command()) for _ in range(2)]
    for process in both:
        process.wait(DEADLINE)
    rows = sorted((place.end(process) for process in both), key=lambda row: row[1])
    check(all(row[0] == "all complete" for row in rows) and rows[0][1] == "0", "none has the result: %s" % rows)
    check(rows[1][1] == "0" or rows[1][2].endswith("is using it, expected one sweep at a time"), "the other: %s" % rows[1])
    yield ["all complete", "0; the other 2 as in the row above, or 0 if it came after the first", ""]


# --- wrong kept files -----------------------------------------------------------------------------------------------------

def points_damaged(place):
    """Cut off, empty, another point's, of another sweep, of another form."""
    place.sweep()
    first, second = [read(place.own(name)) for name in POINTS]
    other = place.file("other")
    place.inputs.add("other")
    words = [word if word != FOLDER else "other" for word in place.output.command(more=["--checks", "report"])]
    place.end(place.start(words))
    bad = [second[:len(second) // 2], b"", first, read(os.path.join(other, POINTS[1])), second.replace(b'"exit":0', b'"exit":1'), b"{}\n"]
    rows = []
    for content in bad:
        check(content != second, "a point that is not damaged")
        place.make(os.path.join(FOLDER, POINTS[1]), content)
        rows.append(place.do())
    yield same_rows(rows)


def description_damaged(place):
    place.sweep()
    rows = []
    for content in (place.reference["sweep.json"][:30], b""):
        place.make(os.path.join(FOLDER, "sweep.json"), content)
        rows.append(place.do())
    yield same_rows(rows)


# --- another sweep than before --------------------------------------------------------------------------------------------

def scenario_changed(place):
    place.sweep()
    place.replace("s.yaml", b"INITIALISED", b"BUS_TELEGRAM_ERROR")
    place.change_sweep()
    yield place.do()


def gsd_changed(place):
    place.sweep()
    place.make("a.gsd", read(place.file("a.gsd")) + b"; more\n")
    place.change_sweep()
    yield place.do()


def program_changed(place):
    place.sweep()
    shutil.copy(place.program, place.file("sim"))
    with open(place.file("sim"), "ab") as file:
        file.write(b"\n")
    place.program = place.file("sim")
    place.inputs.add("sim")
    place.change_sweep()
    yield place.do()


def parameters_changed(place):
    place.sweep()
    place.change_sweep(OfSweep("end=600us,800us"))
    yield place.do()


def settings_changed(place):
    place.sweep()
    place.change_sweep(OfSweep(QUICK, "--set", "slaves.0.address=6"))
    yield place.do()


def changed_while_running(place, number):
    sweep, run = place.start_and_hold()
    place.make("a.gsd", read(place.file("a.gsd")) + b"; more\n")
    os.kill(run, number)
    yield place.end(sweep)
    place.change_sweep()


def gsd_changed_while_running(place):
    yield from changed_while_running(place, signal.SIGCONT)


def gsd_changed_and_run_killed(place):
    yield from changed_while_running(place, signal.SIGKILL)


def written_while_running(place, times):
    content = read(place.file("a.gsd"))
    sweep, run = place.start_and_hold()
    for left in range(times - 1, -1, -1):
        place.make("a.gsd", content)
        os.kill(run, signal.SIGCONT)
        run = place.hold(sweep, run) if left else None
    yield place.end(sweep)


def written_once(place):
    yield from written_while_running(place, 1)


def written_twice(place):
    yield from written_while_running(place, 2)


# --- wrong input files ----------------------------------------------------------------------------------------------------

def refused(place, put, source, name, words):
    """Puts the source into the place of a file in the folder, where it must stay as it is."""
    content = read(place.file(source))
    before = read(place.own(name)) if name in ALL else None
    if before is not None:
        os.remove(place.own(name))
    put(place.file(source), place.own(name))
    process = place.start(words)
    _, errors = process.communicate(timeout=DEADLINE)
    check(read(place.own(name)) == content == read(place.file(source)), name + " was replaced")
    os.remove(place.own(name))
    if before is not None:
        place.make(os.path.join(FOLDER, name), before)
    return [place.left(), place.status(process.returncode), place.line(errors).replace(name, "FILE")]


def own_scenario(place):
    """In place of each file that the sweep writes, or removes when it starts again."""
    place.sweep()
    rows = []
    for name in (*RESULTS, "map_2.svg", POINTS[0], "points/s.yaml"):
        words = [os.path.join(FOLDER, name) if word == "s.yaml" else word for word in place.output.command()]
        rows.append(refused(place, shutil.copy, "s.yaml", name, words))
    yield same_rows(rows)


def linked_gsd(place):
    """By a symbolic and by a hard link; also in a sweep that would start again."""
    place.sweep()
    yield same_rows([refused(place, link, "a.gsd", name, place.output.command(more=more))
                     for name in (*RESULTS, POINTS[0]) for link in (os.symlink, os.link) for more in ([], ["--param", "gsd=a.gsd"])])


def fifo(place):
    os.rename(place.file("s.yaml"), place.file("kept.yaml"))
    os.mkfifo(place.file("s.yaml"))
    place.inputs.add("kept.yaml")
    yield place.do()
    os.rename(place.file("kept.yaml"), place.file("s.yaml"))


# --- standard output ------------------------------------------------------------------------------------------------------

def stdout_full(place):
    yield streams.stdout_full(place)


def stdout_closed(place):
    yield streams.stdout_closed(place)


def stdout_reader_gone(place):
    yield streams.stdout_reader_gone(place)


FAULTS = [
    ("disk full from the start", full_at_start, QUICK),
    ("disk full at the first point", full_at_the_first_point, QUICK),
    ("disk full at the second point", full_at_the_second_point, QUICK),
    ("disk full at `results.csv`", full_at_the_results, QUICK),
    ("`map.svg` links to a full device", full_device, QUICK),
    ("no file descriptor left for a run", no_descriptor, QUICK),
    ("folder cannot be made", cannot_be_made, QUICK),
    ("folder not writable", not_writable, QUICK),
    ("`points` not writable", points_not_writable, QUICK),
    ("`results.csv` is there, not writable", results_not_writable, QUICK),
    ("is a file", is_a_file, QUICK),
    ("holds a file that no sweep has written", holds_something_else, QUICK),
    ("SIGINT while the second point runs", interrupted, LONG),
    ("SIGTERM while the second point runs", terminated, LONG),
    ("SIGHUP while the second point runs", hung_up, LONG),
    ("SIGKILL while the second point runs", killed, LONG),
    ("a run gets SIGKILL", run_killed, LONG),
    ("a run gets SIGKILL, and the next try, too", run_killed_twice, LONG),
    ("a second sweep while one runs (the row is about the second)", second_one, LONG),
    ("two begin at once", both_at_start, QUICK),
    ("a point's file is cut off, empty, another point's, of another sweep, changed", points_damaged, QUICK),
    ("`sweep.json` is cut off or empty", description_damaged, QUICK),
    ("the scenario is another one than in the folder", scenario_changed, QUICK),
    ("a GSD file is another one", gsd_changed, QUICK),
    ("the program is another one", program_changed, QUICK),
    ("the parameters are other ones", parameters_changed, QUICK),
    ("the settings are other ones", settings_changed, QUICK),
    ("a GSD file changes while the second point runs", gsd_changed_while_running, LONG),
    ("... and the run gets SIGKILL", gsd_changed_and_run_killed, LONG),
    ("a GSD file is written with the same content while the second point runs", written_once, LONG),
    ("... and once more during the next try", written_twice, LONG),
    ("the scenario is a file in the folder that is written or removed", own_scenario, QUICK),
    ("a file in the folder is a link to the GSD file", linked_gsd, QUICK),
    ("the scenario is a FIFO", fifo, QUICK),
    ("standard output full", stdout_full, QUICK),
    ("standard output closed", stdout_closed, QUICK),
    ("reader of standard output gone", stdout_reader_gone, QUICK),
]
