#!/usr/bin/env python3
"""A chip made with the kit, the example own_slave, with every command: each row of ROWS does what its cell of docs/own_slave.md says.

    combinations_test.py OWN_SLAVE [NUMBER...]   all rows, or these; compares the page's table, too
    combinations_test.py --table                 prints the table of docs/own_slave.md
"""
import json
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from combinations import ROOT, Table, main  # pylint: disable=wrong-import-position

SCENARIO = (ROOT / "examples/own_slave/own_slave.yaml").read_text(encoding="utf-8")


def engines(cell):
    """Without waves telegrams go as whole runs: the log is the same."""
    cell.engines_agree()
    for engine in ("skip", "step"):
        cell.passes("run", "x.yaml", "-q", "--engine", engine, "--log", f"{engine}.short")
        cell.expect("by runs", cell.read(f"{engine}.short"), cell.read("skip.log"))
    wave = cell.read("skip.vcd").decode()
    for pin in ("RESET", "PBRXD", "PBTXD", "PBRTS", "CS", "RD", "WR", "A", "INT"):
        cell.expect(pin, f" {pin} " in wave, True)


def outputs(cell):
    names = {"--log": "x.jsonl", "--result": "x.json", "--report": "x.html", "--junit": "x.xml", "--capture": "x.pcapng", "--wave": "x.fst"}
    cell.passes("run", "x.yaml", "-q", *(word for pair in names.items() for word in pair))
    cell.expect("files", [name for name in names.values() if not (cell.folder / name).is_file()], [])
    slave = json.loads(cell.read("x.json"))["slaves"][0]
    cell.expect("result", (slave["name"], slave["dp_state"]), ("mine", "DATA_EXCH"))
    cell.expect("event", b'"STARTED"' in cell.read("x.jsonl"), True)


def reasons(cell):
    cell.expect("advice", "Write 0 to 125." in cell.passes("reasons", "start_address"), True)
    cell.expect("in its words", "own_slave: Use the GSD file of this device, or initialise with the ident number of the GSD file (registers 2 and 3)."
                in cell.passes("reasons", "prm_ident"), True)
    cell.write("x.yaml", SCENARIO.replace("address: 5", "address: 126"))
    done = cell.call("run", "x.yaml", "--log", "x.log")
    cell.expect("exit code", done.returncode, 1)
    cell.expect("in the log", "refusal   START_ADDRESS: start refused: address 126 is above 125" in cell.read("x.log").decode(), True)
    cell.expect("in the verdict", ("mine        START_ADDRESS " in done.stdout, "own_slave reasons REASON says what to do" in done.stdout), (True, True), done.stdout)


def saved(cell):
    cell.continues("5ms")
    cell.passes("run", "x.yaml", "-q", "--wave", "x.vcd", "--rewind-on", "STARTED", "10us")


def replay(cell):
    """The capture has the inputs: without it the user CPU's own, at another time."""
    cell.passes("run", "x.yaml", "-q", "--capture", "x.pcapng")
    for words in (("--chip", "own_slave"), ("--scenario", "x.yaml", "--inputs", "recorded"), ("--chip", "own_slave", "--engine", "step")):
        text = cell.replays_equal(5, *words, "--json", "x.json")
        cell.expect("no diagnoses", "the recorded ones; the program of this chip hands over no diagnoses" in text, True, text)
        cell.expect(words, json.loads(cell.read("x.json"))["compared"] > 220, True)
    cell.is_refused("--chip is own_slav (did you mean own_slave?)", "replay", "x.pcapng", "--as", "5", "--chip", "own_slav")


def campaigns(cell):
    text = cell.passes("sweep", "x.yaml", "--param", "user_cpu.cycle=100us,300us,2ms", "--no-progress", "--out", "points")
    cell.expect("points", [word for word in ("100us", "300us", "2ms") if word not in text], [], text)
    cell.expect("regress", "passed\tx.yaml" in cell.passes("regress", "x.yaml", "--no-progress", "--engine", "skip"), True)


def serve(cell):
    """No host comes: the slave waits for parameters."""
    cell.write("x.yaml", SCENARIO[:SCENARIO.index("masters:")] + SCENARIO[SCENARIO.index("slaves:\n  - name: mine"):SCENARIO.index("script:")])
    done = cell.call("serve", "x.yaml", "--tcp", "0", "--for", "50ms")
    cell.expect("serve", ("serving " in done.stdout + done.stderr, done.returncode in (0, 3)), (True, True), done.stdout + done.stderr)


def alone(cell):
    """A user's program has no shipped scenarios."""
    cell.program = shutil.copy(cell.program, cell.folder / "own_slave")
    cell.is_refused("gone.yaml: no such file", "run", "gone.yaml")
    cell.is_refused("own_slave run: there is no scenario gone, expected a path\n", "run", "gone")
    cell.is_refused("power_on_12m.yaml: no such file, demo needs the scenarios shipped", "demo")


def names(cell):
    """Messages name the program that was called."""
    alone(cell)
    cell.is_refused("own_slave: unknown command rnu (did you mean run?)", "rnu")
    cell.is_refused('kind is "own_slav" (did you mean own_slave?)', "run", "x.yaml", "--set", "chip.kind=own_slav")
    for words in (("--help",), ("run", "--help"), ("--version",), ("completion", "bash"), ("manual",)):
        text = cell.passes(*words)
        cell.expect(words, ("dsdpv1-sim" in text, "own_slave" in text), (False, True))
    text = cell.passes("manual")
    cell.expect("manual", (r"dsdpv1\-sim" in text, "own_slave \\- " in text, "\n\\fBown_slave\\fR " in text), (False, True, True), text[:500])
    cell.write("y.yaml", SCENARIO.replace("event: STARTED", "event: START"))
    cell.is_refused("expected the codes of own_slave reasons", "run", "y.yaml")
    cell.expect("schema", '"own_slave"' in cell.passes("schema"), True)


def other_chips(cell):
    """Chips of several kinds on one line; each slave names its own, the first built-in kind is the default."""
    more = "  - {name: other, address: 6, chip: {kind: dsdpv1}, init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: \"31\"}}\n"
    text = SCENARIO.replace("script:", more + "script:").replace("outputs: 01 02 03 04}\n", "outputs: 01 02 03 04}\n      - {slave: other, outputs: 05 06}\n", 1)
    cell.write("x.yaml", text + "  - {slave: other, dp_state: data_exch, outputs: 05 06, by: 11ms}\n")
    cell.passes("run", "x.yaml", "-q")


def pauses(cell):
    script = "script: [{at: 9ms, do: pause_user, slave: mine, for: 1ms}, {at: 10100us, do: reinitialise, slave: mine}]\nexpect: [{slave: mine, event: STARTED, count: 2, by: 11ms}]\n"
    cell.write("x.yaml", SCENARIO[:SCENARIO.index("script:")] + script + "allow: [{event: BUS_UNANSWERED}]\n")
    done = cell.call("run", "x.yaml", "--log", "x.log")
    cell.expect("pauses", "1 of 1 met" in done.stdout, True, done.stdout + done.stderr)


def not_served(cell):
    for action in ("set_diagnosis, type: external, bytes: 01 02", "wrong_length", "answer_acyclic, answering: never", "verdict, of: prm"):
        cell.write("y.yaml", SCENARIO[:SCENARIO.index("script:")] + f"script: [{{at: 1ms, slave: mine, do: {action}}}]\n")
        cell.is_refused("the program of own_slave does not serve it", "run", "y.yaml")
    for key in ("judge_prm=refuse", "judge_in_handler=false", "overwrite_inputs=false"):
        cell.is_refused("the program of own_slave does not serve it", "run", "x.yaml", "--set", f"user_cpu.{key}")
    cell.is_refused("always exchanges", "run", "x.yaml", "--set", "user_cpu.behaviour=idle")


def tlm(cell):
    cell.is_refused("a user CPU moves their pins, expected --view pins", "run", "x.yaml", "--view", "tlm")


def rtl(cell):
    for words in (("run", "x.yaml", "--engine", "rtl"), ("run", "x.yaml", "--engine", "lockstep"), ("cosim", "x.yaml", "--rtl", ".", "--top", "x")):
        cell.is_refused("RTL is for chips of the kinds dsdpv1", *words)
    for words in (("rtl-random",), ("rtl-faults",), ("accept", "--native")):
        cell.is_refused("--chip is own_slave, expected dsdpv1", *words, "--chip", "own_slave")


def board(cell):
    cell.is_refused("--gdb needs a slave whose user_cpu has kind: arm", "run", "x.yaml", "--gdb", "0")
    cell.is_refused("unknown key elf", "run", "x.yaml", "--set", "user_cpu.elf=x.elf")


ROWS = [  # what, how, the function
    ("`run --engine skip`, `step`", "yes: equal pins, log and wave", engines),
    ("`--wave`, `--log`, `--trace`, `--capture`, `--result`, `--report`, `--junit`", "yes", outputs),
    ("`reasons`, advice in log and report", "its rows, and the slave's in its words", reasons),
    ("`--save-at`, `--restore`, `--rewind-on`", "yes, of a run; a chip alone (`PinDevice::save`) with `UserPort::stored`", saved),
    ("`replay`", "`--chip NAME`, or `--scenario`", replay),
    ("`sweep`, `regress`", "yes", campaigns),
    ("`serve`", "yes", serve),
    ("the program's name", "in all messages, `--help`, `manual`, `completion`", names),
    ("other chips on the line", "`chip` at the slave", other_chips),
    ("`set_inputs`, `pause_user`, `reinitialise`, `reset_chip`; `set_diagnosis` with `Parts::diagnosis`, `dpv1` and `answer_acyclic` with `Parts::acyclic`", "yes", pauses),
    ("`judge_*`, `overwrite_inputs`, `behaviour: idle`, `verdict`, `wrong_length`; `answer_acyclic` without that part", "refused", not_served),
    ("`--view tlm`", "refused: the program moves pins", tlm),
    ("`--engine rtl`, `lockstep`, `cosim`, `rtl-random`, `rtl-faults`, `accept`", "refused: no RTL, no random users", rtl),
    ("ARM board, `--gdb`", "refused", board),
]


if __name__ == "__main__":
    sys.exit(main(Table(ROOT / "docs/own_slave.md", "with a chip of the kit", ROWS, {"": SCENARIO})))
