#!/usr/bin/env python3
"""Output on a terminal: tables that fit it, verdicts in colour if it supports colours; a pipe gets everything whole and plain.

    terminal_test.py SIM
"""
import fcntl
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import termios

SCENARIO = """name: short
baud: 12M
end: 2500us
slaves:
  - {name: demo, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: "31"}}
masters:
  - {name: plc, address: 2, slaves: [{slave: demo, outputs: "01 02"}]}
expect:
  - {slave: demo, dp_state: data_exch}
"""
COLOUR = re.compile(r"\x1b\[[0-9;]*m")
MOST_LINES = 24
GREEN, RED = "\x1b[1;32m", "\x1b[1;31m"


def environment(**more):
    bare = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "TERM", "COLUMNS")}
    return {**bare, "TERM": "xterm", **more}


def on_terminal(folder, command, columns, **more):
    """The program's output on a terminal of this width."""
    terminal, program = os.openpty()
    fcntl.ioctl(program, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    with subprocess.Popen(command, cwd=folder, stdout=program, stderr=subprocess.DEVNULL, env=environment(**more)) as running:
        os.close(program)
        text = b""
        while chunk := read(terminal):
            text += chunk
        running.wait(timeout=240)
    os.close(terminal)
    return text.decode().replace("\r\n", "\n")


def read(terminal):
    try:
        return os.read(terminal, 1 << 16)
    except OSError:  # Linux reports this when the other end is closed
        return b""


def through_pipe(folder, command, **more):
    return subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=environment(**more),
                          check=False, timeout=240).stdout


def words(text):
    """Without colours, layout, the run's time, and how often a table's head stands there."""
    return sorted(set(re.sub(r"in\s+[\d.]+ s: [\d.]+\s+times\s+\w+", "", COLOUR.sub("", text)).replace("-", " ").split()))


def widest(text):
    return max((COLOUR.sub("", line) for line in text.splitlines()), key=len)


def faults_of_widths(folder, run):
    whole = through_pipe(folder, run)
    if len(widest(whole)) < 110:
        yield "the table is too narrow for this test"
    for columns in (72, 100, 200):
        text = on_terminal(folder, run, columns)
        longest = widest(text)
        if len(longest) > columns:
            yield f"{columns} columns: a line has {len(longest)}: {longest}"
        if words(text) != words(whole):
            yield f"{columns} columns: the table has other words than through a pipe"
    if on_terminal(folder, run, 0).count("\n") != whole.count("\n"):
        yield "a terminal that does not say how wide it is has another table than a pipe"


def faults_of_length(folder, sim):
    """Of the run that a newcomer sees first."""
    lines = on_terminal(folder, [sim, "demo"], 80).splitlines()
    if not any("PASSED" in line for line in lines) or len(lines) > MOST_LINES:
        yield "the demo has %d lines at 80 columns, expected up to %d:\n%s" % (len(lines), MOST_LINES, "\n".join(lines))


def faults_of_colours(folder, run):
    passed = GREEN + "PASSED"
    failing = [*run, "--set", "end=100us"]
    failed, not_met = RED + "FAILED", RED + "  NOT MET  "
    for what, text, wanted in [
        ("a terminal", on_terminal(folder, run, 200), [passed]),
        ("a failed run", on_terminal(folder, failing, 200), [failed, not_met]),
        ("NO_COLOR", on_terminal(folder, run, 200, NO_COLOR="1"), []),
        ("an empty NO_COLOR", on_terminal(folder, run, 200, NO_COLOR=""), [passed]),
        ("a dumb terminal", on_terminal(folder, run, 200, TERM="dumb"), []),
        ("--color never", on_terminal(folder, [*run, "--color", "never"], 200), []),
        ("--color before the command", on_terminal(folder, [run[0], "--color", "never", *run[1:]], 200), []),
        ("--color always with NO_COLOR", on_terminal(folder, [*run, "--color", "always"], 200, NO_COLOR="1"), [passed]),
        ("a pipe", through_pipe(folder, run), []),
        ("--color always through a pipe", through_pipe(folder, [*run, "--color", "always"]), [passed]),
    ]:
        missing = [word for word in wanted if word not in text]
        if missing or (not wanted and "\x1b" in text):
            yield f"{what}: {'without ' + repr(missing) if missing else 'with colours'}: {text[-300:]!r}"


def faults_of_others(folder, sim, run):
    """Only the program may use colours."""
    (folder / "named.yaml").write_text(SCENARIO.replace("short", '"\\e[31mred"'), encoding="utf-8")
    text = on_terminal(folder, [sim, "run", "named.yaml"], 200)
    if "\\x1B[31mred" not in text or "\x1b[31m" in text:
        yield f"a name has brought its colour: {text[:300]!r}"
    refused = subprocess.run([*run, "--color", "blue"], cwd=folder, capture_output=True, text=True, check=False)
    if refused.returncode != 2 or refused.stderr.strip() != "dsdpv1-sim --color is blue, expected auto, always, never":
        yield f"--color blue: {refused.returncode} {refused.stderr}"


def faults_of_regress(folder, sim):
    command = [sim, "regress", "short.yaml", "--out", "regression", "--keep", "none"]
    table, piped = on_terminal(folder, command, 60), through_pipe(folder, command)
    if not piped.startswith("verdict\tscenario\t") or "\x1b" in piped:
        yield f"regress through a pipe: {piped!r}"
    if GREEN + "  passed  " not in table or "\t" in table or len(widest(table)) > 60:
        yield f"regress on a terminal: {table!r}"
    if GREEN + "  verdict   passed" not in (blocks := on_terminal(folder, command, 30)):
        yield f"regress on a narrow terminal: {blocks!r}"


def faults_of_help(folder, sim):
    """Each command has a help, in no line wider than the terminal, and is in a group of the program's own."""
    help_text = on_terminal(folder, [sim, "--help"], 80)
    commands = re.findall(r"^  ([a-z][a-z-]*)  ", help_text, re.M)
    if len(commands) < 18 or help_text.find("Run scenarios:") > help_text.find("  run  "):
        yield f"--help: {help_text}"
    for command in [[], *([name] for name in commands), ["traces", "check"]]:
        for columns in (60, 80, 100):
            text = on_terminal(folder, [sim, *command, "--help"], columns)
            if len(longest := widest(text)) > columns:
                yield f"{command} --help at {columns} columns: {longest}"
            if "Usage: dsdpv1-sim" not in text or "Needs:" in text or "TEXT" in text:
                yield f"{command} --help: {text}"
    alone = subprocess.run([sim], capture_output=True, text=True, check=False)
    if alone.returncode != 2 or alone.stdout or alone.stderr != through_pipe(folder, [sim, "--help"]):
        yield f"without a command: {alone}"


def main():
    sim = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "short.yaml").write_text(SCENARIO, encoding="utf-8")
        run = [sim, "run", "short.yaml"]
        found = [*faults_of_widths(folder, run), *faults_of_length(folder, sim), *faults_of_colours(folder, run), *faults_of_others(folder, sim, run),
                 *faults_of_regress(folder, sim), *faults_of_help(folder, sim)]
    print("\n".join(found) if found else "terminal: right")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
