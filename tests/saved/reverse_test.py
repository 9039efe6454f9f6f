#!/usr/bin/env python3
"""gdb runs backwards on the ARM board: reverse-stepi, reverse-continue to the previous breakpoint and watchpoint, to the beginning; later changes
are undone, and a run that went back and forth has the log of one that did not. A session with changes is saved and restored without gdb. Resets and loads
of gdb stand in the same history.

usage: reverse_test.py DSDPV1_SIM --firmware ELF"""
import argparse
import pathlib
import re
import subprocess
import tempfile

import runs

SCENARIO = runs.PROJECT / "scenarios" / "arm_board_12m.yaml"
PATIENCE_S = 300


class Session:
    """A run under gdb with these commands."""

    def __init__(self, program, firmware, folder, run_words, commands):
        run = subprocess.Popen([program, "run", *map(str, run_words), "--gdb", "0", "--no-progress"], cwd=folder, text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
        port = re.search(r"localhost:(\d+)", run.stderr.readline()).group(1)
        words = [word for command in ["set tcp connect-timeout 120", f"target remote localhost:{port}", *commands] for word in ("-ex", command)]
        self.text = subprocess.run(["gdb-multiarch", "-nx", "-batch", *words, firmware], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE_S, check=False).stdout
        self.out, self.err = run.communicate(timeout=PATIENCE_S)
        self.status = run.returncode

    def values(self):
        """Output of `print`, in order."""
        return re.findall(r"^\$\d+ = (?:\(.*\) )?(\S+)", self.text, re.MULTILINE)


def places(program, firmware, folder):
    """Registers and time at places reached forwards, and again backwards."""
    look = ["print/x $pc", "print/x $sp", "print/x $r0", "monitor time"]
    commands = ["break dsdpv1_initialise", "continue", *look, "stepi", *look, "stepi", *look, "reverse-stepi", *look, "reverse-stepi", *look, "stepi", *look, "kill"]
    session = Session(program, firmware, folder, [SCENARIO], commands)
    values, times = session.values(), re.findall(r"simulated time (\S+)", session.text)
    seen = [(*values[3 * i:3 * i + 3], times[i]) for i in range(len(times))]
    if len(seen) != 6 or seen[0] == seen[1] or [seen[i] for i in (1, 0, 1)] != seen[3:]:
        yield f"back is not where it came from: {seen}\n{session.text}\n{session.err}"


def stops(program, firmware, folder):
    """The last of three hits, then the one before it, then the beginning."""
    where = ["monitor time"]
    commands = [*where, "delete", "break dsdpv1_service", "continue", *where, "continue", *where, "continue", *where,
                "reverse-continue", *where, "reverse-continue", *where, "delete", "reverse-continue", *where, "print/x $pc", "kill"]
    session = Session(program, firmware, folder, [SCENARIO], commands)
    times = re.findall(r"simulated time (\S+)", session.text)
    if len(times) != 7 or times[4:6] != [times[2], times[1]] or "No more reverse-execution history" not in session.text or times[6] != times[0]:
        yield f"reverse-continue stops elsewhere: {times}\n{session.text}\n{session.err}"
    if session.status != 130:
        yield f"exit {session.status} after kill"


def watches(program, firmware, folder):
    """Back to the instruction that wrote: it has not been executed yet, and its value is not in memory yet."""
    commands = ["break dsdpv1_service", "continue", "continue", "delete", "watch *(unsigned*)($sp-4)", "continue", "print/x $pc", "monitor time",
                "reverse-continue", "stepi", "monitor time", "kill"]
    session = Session(program, firmware, folder, [SCENARIO], commands)
    times = re.findall(r"simulated time (\S+)", session.text)
    if len(times) != 2 or times[0] != times[1]:
        yield f"the watchpoint is not met where it was: {times}\n{session.text}\n{session.err}"


def undone(program, firmware, folder):
    """A change is undone after its place; back and forth leaves no trace in the log."""
    commands = ["break dsdpv1_initialise", "continue", "print $r4", "stepi", "set var $r4 = 77", "print $r4", "reverse-stepi", "print $r4", "stepi", "print $r4",
                "delete", "detach"]
    session = Session(program, firmware, folder, [SCENARIO, "--log", folder / "back.log"], commands)
    runs.call(program, SCENARIO, "--log", folder / "plain.log")
    values = session.values()
    if len(values) != 4 or values[1] != "77" or values[2] != values[0] or values[3] != values[0]:
        yield f"a change is not undone: {values}\n{session.text}\n{session.err}"
    if session.status != 0 or (folder / "back.log").read_text() != (folder / "plain.log").read_text():
        yield f"the run that went back is another one: exit {session.status}, {session.err}"


def saved(program, firmware, folder):
    """gdb writes the station's address, which changes the run; when restored, the address is written without gdb."""
    commands = ["break dsdpv1_initialise", "continue", "set var config->address = 7", "delete", "detach"]
    words = [SCENARIO, "--log", folder / "whole.log", "--save-at", "4ms", folder / "session.run"]
    session = Session(program, firmware, folder, words, commands)
    if "address 7" not in (folder / "whole.log").read_text(encoding="utf-8"):
        yield f"gdb has not changed the address: {session.text}"
    done = runs.call(program, "--restore", folder / "session.run", "--log", folder / "rest.log", folder=folder)
    if done.returncode != session.status:
        yield f"a saved session is restored with {done.returncode}: {done.stderr}"
        return
    if (folder / "rest.log").read_text(encoding="utf-8").splitlines() != runs.log_from(folder / "whole.log", 4_000_000 * runs.TICKS_PER_NS):
        yield "a saved session goes on otherwise"
    later = Session(program, firmware, folder, ["--restore", folder / "session.run"], ["monitor time", "reverse-stepi", "kill"])
    if not re.search(r"simulated time 0\.00400", later.text) or "No more reverse-execution history" not in later.text:
        yield f"gdb comes to a restored run elsewhere: {later.text}{later.err}"


def resets(program, firmware, folder):
    """The reset handler is met forwards and backwards; before it comes the instruction before the reset."""
    look = ["maintenance flush register-cache", "print/x $pc", "print/x $sp", "monitor time"]
    commands = ["break dsdpv1_initialise", "continue", "stepi", *look, "stepi", "set var $pc = &dsdpv1_initialise", "monitor reset halt", *look, "stepi", *look, "reverse-stepi", *look,
                "reverse-stepi", *look, "kill"]
    session = Session(program, firmware, folder, [SCENARIO], commands)
    values, times = session.values(), re.findall(r"simulated time (\S+)", session.text)
    seen = [(*values[2 * i:2 * i + 2], times[i]) for i in range(len(times))]
    handler = re.search(r"reset_handler", session.text)
    if len(seen) != 5 or seen[3] != seen[1] or seen[4] != seen[0] or seen[1][0] == seen[0][0] or not handler:
        yield f"back over a reset: {seen}\n{session.text}\n{session.err}"


def saved_reset(program, firmware, folder):
    """A reset by gdb, and a change at the reset handler, are repeated without gdb."""
    commands = ["break dsdpv1_initialise", "continue", "monitor reset halt", "maintenance flush register-cache", "delete", "set var $r9 = 7", "detach"]
    words = [SCENARIO, "--log", folder / "reset.log", "--save-at", "4ms", folder / "reset.run"]
    session = Session(program, firmware, folder, words, commands)
    done = runs.call(program, "--restore", folder / "reset.run", "--log", folder / "rest.log", folder=folder)
    log = (folder / "reset.log").read_text(encoding="utf-8")
    if log.count("start-up finished") < 2 or done.returncode != session.status:
        yield f"a saved reset is restored with {done.returncode}, not {session.status}: {done.stderr}{session.text}"
    elif (folder / "rest.log").read_text(encoding="utf-8").splitlines() != runs.log_from(folder / "reset.log", 4_000_000 * runs.TICKS_PER_NS):
        yield "a saved reset goes on otherwise"


def loads(program, firmware, folder):
    """The program of the run is taken, and changes nothing."""
    session = Session(program, firmware, folder, [SCENARIO, "--set", f"user_cpu.elf={firmware}", "--log", folder / "loaded.log"], ["load", "detach"])
    runs.call(program, SCENARIO, "--set", f"user_cpu.elf={firmware}", "--log", folder / "plain.log")
    if "Transfer rate" not in session.text or (folder / "loaded.log").read_text() != (folder / "plain.log").read_text():
        yield f"load has changed the run: {session.text}{session.err}"


def loads_again(program, firmware, folder):
    """A program that is built again during the session: the run begins again with it, gdb can go back in it, and it is what is saved."""
    mine, other = folder / "my.elf", pathlib.Path(firmware).with_name("device_O0.elf")
    mine.write_bytes(pathlib.Path(firmware).read_bytes())
    commands = ["break dsdpv1_initialise", "continue", "set var config->address = 7", f"shell cp {other} {mine}", f"file {mine}", "load", "monitor time", "continue",
                "print config->address", "monitor time", "stepi", "reverse-stepi", "monitor time", "delete", "detach"]
    session = Session(program, mine, folder, [SCENARIO, "--set", f"user_cpu.elf={mine}", "--log", folder / "again.log", "--save-at", "4ms", folder / "again.run"], commands)
    runs.call(program, SCENARIO, "--set", f"user_cpu.elf={other}", "--log", folder / "other.log")
    times = re.findall(r"simulated time (\S+)", session.text)
    if "load: another program, the run begins again" not in session.err or len(times) != 3 or float(times[0]) > 25e-6 or times[1] != times[2]:
        yield f"a new program is not loaded: {times} {session.text}{session.err}"
    elif session.values() != ["5"] or (folder / "again.log").read_text() != (folder / "other.log").read_text():
        yield f"the run has not begun again: {session.values()} {session.text}{session.err}"
    done = runs.call(program, "--restore", folder / "again.run", "--log", folder / "rest.log", folder=folder)
    if done.returncode != session.status or (folder / "rest.log").read_text().splitlines() != runs.log_from(folder / "other.log", 4_000_000 * runs.TICKS_PER_NS):
        yield f"the new program is not saved: {done.returncode}, {done.stderr}"


def refuses(program, firmware, folder):
    """A program that is not in the file of the run; a changed file when the run cannot begin again with it."""
    other, mine, kept = pathlib.Path(firmware).with_name("device_O0.elf"), folder / "mine.elf", folder / "kept.run"
    mine.write_bytes(pathlib.Path(firmware).read_bytes())
    run = [SCENARIO, "--set", f"user_cpu.elf={mine}"]
    runs.call(program, *run, "--save-at", "4ms", kept)
    for words, elf in ((run, firmware), (["--restore", kept], other), ([*run, "--view", "tlm"], other)):
        mine.write_bytes(pathlib.Path(firmware).read_bytes())
        session = Session(program, firmware, folder, words, [f"shell cp {elf} {mine}", f"load {other}", "detach"])
        if "Error finishing flash operation" not in session.text or "load: gdb loads another program than that of the run" not in session.err or session.status not in (0, 1):
            yield f"{words}: another program is not refused: {session.status} {session.text}{session.err}"


TWO = """name: Two boards
baud: 12M
end: 6ms
slaves:
  - {name: one, address: 5, gsd: GSD, modules: ["8 bytes in, 8 bytes out"], init: {prm_mode: 2, cfg_mode: 2}, user_cpu: {kind: arm, elf: ELF}}
  - {name: two, address: 6, gsd: GSD, modules: ["8 bytes in, 8 bytes out"], init: {prm_mode: 2, cfg_mode: 2}, user_cpu: {kind: arm, elf: ELF}}
masters:
  - {name: plc, address: 2, start: 500us, slaves: [{slave: one}, {slave: two}]}
expect:
  - {slave: one, event: INITIALISED, count: 2}
  - {slave: two, event: INITIALISED, count: 1, count_at_most: 1}
"""


def two(program, firmware, folder):
    """The first board is reset and loaded, and goes back; the second is as it was."""
    scenario = folder / "two.yaml"
    scenario.write_text(TWO.replace("GSD", str(runs.PROJECT / "scenarios/dsdpv1.gsd")).replace("ELF", str(firmware)), encoding="utf-8")
    commands = ["load", "break judge_cfg", "continue", "monitor reset halt", "maintenance flush register-cache", "stepi", "reverse-stepi", "load", "delete", "detach"]
    session = Session(program, firmware, folder, [scenario], commands)
    if session.status != 0 or session.text.count("Transfer rate") != 2:
        yield f"two boards: {session.status} {session.text}{session.out}{session.err}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--firmware", required=True)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        return runs.report([failure for case in (places, stops, watches, undone, saved, resets, saved_reset, loads, loads_again, refuses, two)
                            for failure in case(arguments.program, arguments.firmware, pathlib.Path(folder))])


if __name__ == "__main__":
    raise SystemExit(main())
