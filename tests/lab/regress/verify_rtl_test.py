#!/usr/bin/env python3
"""verify-rtl on the example of RTL, from a copy of the program with few scenarios and stimuli: what it says of failures, what it runs again, and that an
interrupted one comes to the report of one that was not.

    verify_rtl_test.py DSDPV1_SIM FOLDER [KILLS [SEED]]

With KILLS only the interruptions: so many, at random moments; 0: a few at chosen ones. The signals go to the program alone, or to all that it has started.
"""
import difflib
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
FOLDER = pathlib.Path(sys.argv[2]).resolve()
SIM = FOLDER / "prefix/bin/dsdpv1-sim"
DATA = FOLDER / "prefix/share/dsdpv1"
SCENARIOS = ("power_on_12m", "two_slaves", "r")
STIMULI = ("interrupt", "user_blocks")
STIMULUS_FOLDER = "tests/cosim/stimuli/dsdpv1"
GOOD = "parameters: {RESET_VALUE: 1, PULSE: 64}\n"
SHORT = "parameters: {RESET_VALUE: 1, PULSE: 60}\n"
FAILURES = []


def check(right, what, said=""):
    if not right:
        FAILURES.append(f"{what}\n{said}")


def install():
    """As an installed program, whose files may be changed."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    SIM.parent.mkdir(parents=True)
    shutil.copy2(sys.argv[1], SIM)
    for name in ("scenarios", "traces", STIMULUS_FOLDER):
        (DATA / name).mkdir(parents=True)
    for name in SCENARIOS:
        for source in [ROOT / f"scenarios/{name}.yaml", *(ROOT / "traces").glob(f"{name}.*")]:
            shutil.copy2(source, DATA / source.relative_to(ROOT))
    shutil.copy2(ROOT / "scenarios/dsdpv1.gsd", DATA / "scenarios")
    for name in STIMULI:
        shutil.copy2(ROOT / STIMULUS_FOLDER / f"{name}.stimulus", DATA / STIMULUS_FOLDER)
    for name in ("rtl_ref", "registers", "docs"):
        (DATA / name).symlink_to(ROOT / name)
    shutil.copytree(ROOT / "examples/own_rtl", FOLDER / "rtl")


def write_map(*, tolerance, parameters, chip=True):
    text = (FOLDER / "rtl/pins.yaml").read_text(encoding="utf-8")
    for key, wanted in (("tolerance", tolerance), ("chip", chip)):
        if not wanted:
            text = re.sub(rf"^{key}:.*\n", "", text, flags=re.MULTILINE)
    (FOLDER / "pins.yaml").write_text(text + parameters, encoding="utf-8")


def command(*words):
    return [str(SIM), "verify-rtl", "--rtl", "rtl", "--top", "board_chip", "--pins", "pins.yaml", "--no-progress", *map(str, words)]


def verify(*words):
    return subprocess.run(command(*words), cwd=FOLDER, capture_output=True, text=True, check=False)


# --- failures --------------------------------------------------------------------------------------------------------
def every_failure_is_seen_again():
    """INTR0 of the example is a cycle late, which no tolerance excuses now; by each way."""
    write_map(tolerance=False, parameters=SHORT)
    done = verify("two_slaves", DATA / STIMULUS_FOLDER / "interrupt.stimulus", "--cycles", 100_000, "--set", "chip.search_window_ms=1", "--json")
    check(done.returncode == 1, "the fault is found", done.stdout + done.stderr)
    result = json.loads(done.stdout)
    check([run["engine"] for run in result["runs"]] == ["cosim", "golden", "replay", "random"], "runs", done.stdout)
    printed = re.findall(r"^again: (.*)$", done.stderr, re.MULTILINE)
    check(printed == [run["again"] for run in result["runs"]], "the lines are those of the result", done.stderr)
    for run in result["runs"]:
        seen_again(run)
    facts(result)


def seen_again(run):
    name = run["engine"]
    check(run["verdict"] == "failed" and "INTR0" in run["reason"], f"{name} finds it", json.dumps(run, indent=1))
    folder = FOLDER / "rtl-verification" / run["folder"]
    for words, where in ((run["again"], FOLDER), (f"sh {folder / 'again.sh'}", pathlib.Path("/"))):
        again = subprocess.run(words, shell=True, cwd=where, capture_output=True, text=True, check=False)
        check(again.returncode == 1 and run["reason"].split(": ")[0] in again.stdout, f"{name}: {words}", again.stdout + again.stderr)
    check(len(run["output"]) <= 3072, f"{name} keeps as much of the output, whatever the folder of the run was called", run["output"])
    check(".run/" not in run["output"] and ".run/" not in "".join(path.read_text() for path in folder.glob("result.json")),
          f"{name} names a folder that is gone", run["output"])
    if name != "golden":
        actions = (folder / "lockstep.stimulus").read_text().count("\n")
        most = 400 if name == "cosim" else 40  # of a scenario each edge of its user is one
        check(0 < actions < most, f"{name} is shrunk: {actions} actions", run["output"])
        for line in re.findall(r"to be seen again with\n  (.*)\n", run["output"]):  # of random cases it may be before the end that is kept
            again = subprocess.run(line.replace("dsdpv1-sim", str(SIM), 1), shell=True, cwd=FOLDER, capture_output=True, text=True, check=False)
            check(again.returncode == 1, f"{name}: {line}", again.stdout + again.stderr)


def facts(result):
    rtl = result["rtl"]
    check((rtl["chip"], rtl["top"], rtl["pins"], rtl["tolerance"]) == ("dsdpv1", "board_chip", "pins.yaml", {}), "facts of the RTL", str(rtl))
    check(result["versions"]["verilator"].startswith("Verilator ") and result["versions"]["dsdpv1"], "versions", str(result["versions"]))
    case = result["runs"][3]
    check((case["mode"], case["seed"], case["settings"]) == ("parallel", "1", ["chip.search_window_ms=1"]), "facts of a random case", str(case))


# --- what is run -----------------------------------------------------------------------------------------------------
def what_cannot_be_compared_is_listed():
    write_map(tolerance=True, parameters=GOOD, chip=False)
    words = ("--chip", "dsdpv1_r", "--only", "scenarios,goldens,random", "--cycles", 20_000, "--junit", "r.xml")
    done = verify(*words)
    lines = [line.split("\t") for line in done.stdout.splitlines()]
    check(done.returncode == 0 and [line[0] for line in lines[1:]] == ["passed", "not_run", "not_run"], "what is not run comes last",
          done.stdout + done.stderr)
    check(lines[0][10] == "mode" and lines[1][10] == "parallel", "the port of random cases", done.stdout)
    check("chip.search_window_ms is not the default" in lines[2][8] and "has a tolerance" in lines[3][8], "reasons", done.stdout)
    check("1 of 1 runs passed; 2 are not run" in done.stderr, "summary", done.stderr)
    check((FOLDER / "r.xml").read_text().count("<skipped message=") == 2, "JUnit", (FOLDER / "r.xml").read_text())
    check(verify(*words, "--strict").returncode == 3, "--strict")
    done = verify("--chip", "dsdpv1_r", "--only", "scenarios")
    check(done.returncode == 3, "nothing was run", done.stdout + done.stderr)
    done = verify("--chip", "dsdpv1_r", "--only", "scenarios", DATA / "scenarios/r.yaml")
    check(done.returncode == 1 and done.stdout.splitlines()[1].startswith("refused\t"), "named, it is an error", done.stdout + done.stderr)


def again_after_a_change():
    """A result is kept until the RTL, the map, or a file that its run reads is another."""
    write_map(tolerance=False, parameters=GOOD)
    words = ("two_slaves", DATA / STIMULUS_FOLDER / "interrupt.stimulus", "--only", "scenarios,goldens,stimuli", "--out", "changed")
    runs = FOLDER / "changed/runs"

    def run_again():
        before = {path.name: path.stat().st_mtime_ns for path in runs.glob("*.json")} if runs.exists() else {}
        verify(*words)
        return sorted(path.name.split(".")[1] for path in runs.glob("*.json") if path.stat().st_mtime_ns != before.get(path.name))

    check(run_again() == ["cosim", "golden", "replay"], "all at first")
    check(run_again() == [], "nothing has changed")
    for name, concerned in (("traces/two_slaves.json", ["golden"]), ("traces/two_slaves.trace.xz", ["golden"]),
                            ("scenarios/two_slaves.yaml", ["cosim", "golden"]), (f"{STIMULUS_FOLDER}/interrupt.stimulus", ["replay"])):
        path = DATA / name
        path.write_bytes(path.read_bytes() + b"\n")
        check(run_again() == concerned, f"a change of {name}")
        shutil.copy2(ROOT / name, path)
        run_again()


# --- interruptions ---------------------------------------------------------------------------------------------------
CAMPAIGN = ("--cycles", 400_000, "--jobs", 2, "--junit", "rtl.xml", "--out", "night", "--build", "night_build")
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)


def clear():
    for name in ("night", "night_build"):
        shutil.rmtree(FOLDER / name, ignore_errors=True)


def without_times(text):
    """Seconds in table, JUnit and page; the speed of random cases."""
    text = re.sub(r"\t\d+\.\d{3}\t", "\t-\t", text)
    text = re.sub(r'time="[\d.]+"|data-key="[\d.]+">[\d.]+<|[\d.]+ M cycles/s', "-", text)
    return re.sub(r"after [\d.]+ s", "-", text)


def report(done):
    texts = {name: (FOLDER / name).read_text(encoding="utf-8") for name in ("rtl.xml", "night/index.html", "night/regression.json")}
    texts["table"] = done.stdout
    texts["lines"] = "".join(line for line in done.stderr.splitlines(True) if line.startswith(("again: ", "regression: ")) and "already" not in line)
    kept = (FOLDER / "night/runs").rglob("*")
    texts["kept"] = "\n".join(sorted(str(path) for path in kept if path.is_file()))
    return {name: without_times(text) for name, text in texts.items()}


def interrupted(number, to_all, moment):
    """Calls it and kills it at the moment. Returns the finished process when that was faster."""
    out, err = FOLDER / "out.txt", FOLDER / "err.txt"  # no pipes: what it has started may outlive it, and hold them
    with open(out, "wb") as to_out, open(err, "wb") as to_err:
        process = subprocess.Popen(command(*CAMPAIGN), cwd=FOLDER, stdout=to_out, stderr=to_err, start_new_session=True)
    begin = time.monotonic()
    while process.poll() is None and not moment(time.monotonic() - begin):
        time.sleep(0.02)
    if process.poll() is None:
        (os.killpg if to_all else os.kill)(process.pid, number)
    process.wait()
    said = err.read_text(encoding="utf-8")
    print(f"{number.name}{' to all' if to_all else ''} after {time.monotonic() - begin:.1f} s: {process.returncode} {said.splitlines()[-1:]}", flush=True)
    if process.returncode in (130, -signal.SIGKILL):
        return None
    return subprocess.CompletedProcess(process.args, process.returncode, out.read_text(encoding="utf-8"), said)


def while_compiling(seconds):
    return seconds > 0.3 and (FOLDER / "night_build/compiling").exists()


def with_a_result(seconds):
    return seconds > 0.3 and any((FOLDER / "night/runs").glob("*.json"))


def random_kills(many, longest, chance):
    for _ in range(many):
        wait = longest * chance.random() ** 2  # more of them in the build
        yield chance.choice(SIGNALS), chance.random() < 0.5, lambda seconds, wait=wait: seconds > wait


CHOSEN = ((signal.SIGKILL, False, while_compiling), (signal.SIGINT, True, while_compiling), (signal.SIGKILL, True, while_compiling),
          (signal.SIGTERM, False, with_a_result))


def to_the_same_report(kills, chance):
    write_map(tolerance=False, parameters=SHORT)  # so that there are failures to report
    clear()
    begin = time.monotonic()
    whole = verify(*CAMPAIGN)
    longest = time.monotonic() - begin
    wanted = report(whole)
    check(whole.returncode == 1, "the fault is found", whole.stdout + whole.stderr)
    begin = time.monotonic()
    second = verify(*CAMPAIGN)
    print(f"whole: {longest:.1f} s, again without a change: {time.monotonic() - begin:.1f} s", flush=True)
    check(time.monotonic() - begin < 120 and report(second) == wanted, "the second call says the same", second.stdout + second.stderr)
    clear()
    for kill in random_kills(kills, longest, chance) if kills else CHOSEN:
        if done := interrupted(*kill):
            differs(report(done), wanted)
            clear()
    differs(report(verify(*CAMPAIGN)), wanted)


def differs(now, wanted):
    for name, text in wanted.items():
        lines = list(difflib.unified_diff(text.splitlines(), now[name].splitlines(), "whole", "interrupted", lineterm="", n=0))
        if lines:
            FAILURES.append("\n".join([f"after interruptions {name} is another", *lines[:20]]))


def main():
    install()
    if len(sys.argv) > 3:
        seed = int(sys.argv[4]) if len(sys.argv) > 4 else random.randrange(2**32)
        print(f"seed {seed}", flush=True)
        to_the_same_report(int(sys.argv[3]), random.Random(seed))
    else:
        every_failure_is_seen_again()
        what_cannot_be_compared_is_listed()
        again_after_a_change()
    sys.exit("\n".join(FAILURES) or 0)


if __name__ == "__main__":
    main()
