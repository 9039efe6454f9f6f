#!/usr/bin/env python3
"""The word and the number of a run are the same at every entrance (docs/verdicts.md): each cell of ENTRANCES x SITUATIONS.

    combinations_test.py DSDPV1_SIM [rtl]     needs DSDPV1_LIBRARY for the C API and Python; rtl: with cosim and lockstep
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import dsdpv1

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIM, WITH_RTL = sys.argv[1], "rtl" in sys.argv[2:]
SLAVE = """name: x
baud: 12M
end: 8ms
slaves:
  - {name: io, address: 5, init: {ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: "31", prm_mode: 2}}
"""
MASTER = 'masters:\n  - {name: plc, address: 2, slaves: [{slave: io, outputs: "01 02"%s}]}\n'
LIMIT = "checks: {%sINTR0_SERVICE: {max: 1ns}}\n"  # no user is that fast: a violation of a check, and of nothing else
GOOD = SLAVE + MASTER % ""
SITUATIONS = {  # scenario, word, number
    "good": (GOOD, "PASSED", 0),
    "violation": (GOOD + LIMIT % "", "FAILED: 2 violations", 1),
    "no data exchange": (SLAVE + MASTER % ", ident: 1", "FAILED: 1 expectation not met", 1),
    "nothing judged": (SLAVE, "NOTHING JUDGED: no data exchange, and nothing was expected", 3),
    "report": (GOOD + LIMIT % "mode: report, ", "PASSED, 2 violations not judged", 0),
    "off": (GOOD + LIMIT % "mode: off, ", "PASSED, checks off", 0),
    "nothing expected": (GOOD + "expect: none\n", "PASSED, data exchange not expected", 0),
}
FAILURES = []


def call(*words, cwd, **more):
    return subprocess.run([str(word) for word in words], cwd=cwd, capture_output=True, text=True, check=False, **more)


def last_line(done):
    return done.stdout.rstrip("\n").rpartition("\n")[2]


def compare(entrance, situation, seen, wanted, said=""):
    if seen != wanted:
        FAILURES.append(f"{entrance}, {situation}: {seen} instead of {wanted}\n{said}")


def by_command(entrance, situation, folder, *words):
    _, word, number = SITUATIONS[situation]
    done = call(*words, "--result", "result.json", cwd=folder)
    compare(entrance, situation, (last_line(done), done.returncode), (word, number), done.stdout[-2000:] + done.stderr)
    result = json.loads((folder / "result.json").read_text())
    compare(entrance + " --result", situation, (result["verdict_text"], result["passed"]), (word, number == 0))


def run(situation, folder):
    by_command("run", situation, folder, SIM, "run", "x.yaml", "--no-progress")


def run_tlm(situation, folder):
    by_command("run --view tlm", situation, folder, SIM, "run", "x.yaml", "--no-progress", "--view", "tlm")


def junit(situation, folder):
    number = SITUATIONS[situation][2]
    done = call(SIM, "run", "x.yaml", "--no-progress", "--junit", "junit.xml", cwd=folder)
    compare("run --junit", situation, done.returncode, number)
    cases = xml.parse(folder / "junit.xml").getroot().findall(".//testcase")
    failed = [case.get("name") for case in cases if case.find("failure") is not None]
    wanted = {"violation": "io: INTR0_SERVICE", "no data exchange": "line 7: io comes to data exchange with plc and stays to the end "
              "(implied; expect: none switches it off)", "nothing judged": "run, engine skip, view pins"}
    compare("run --junit", situation, failed, [wanted[situation]] if situation in wanted else [])


def regress(situation, folder):
    number = SITUATIONS[situation][2]
    done = call(SIM, "regress", "x.yaml", "--no-progress", "--json", "--jobs", "1", cwd=folder)
    word = {0: "passed", 1: "failed", 3: "nothing_judged"}[number]
    compare("regress", situation, (json.loads(done.stdout)["runs"][0]["verdict"], done.returncode), (word, number), done.stderr)


def sweep(situation, folder):
    number = SITUATIONS[situation][2]
    for strict in ([], ["--strict"]):
        done = call(SIM, "sweep", "x.yaml", "--param", "end=8ms", "--out", "sweep", "--no-progress", "--quiet", "--jobs", "1", *strict, cwd=folder)
        holds = (folder / "sweep" / "results.csv").read_text().splitlines()[1].split(",")[2]
        # A sweep asks where the timing holds: there a violation that is only reported is one.
        expected = ("no", 1) if situation == "report" else ("yes" if number == 0 else "no", number)
        compare("sweep" + "".join(strict), situation, (holds, done.returncode), (expected[0], expected[1] if strict else 0), done.stdout + done.stderr)


def serve(situation, folder):
    """With the scenario's own master, and no host."""
    by_command("serve", situation, folder, SIM, "serve", "x.yaml", "--tcp", "0", "--for", "8ms", "--junit", "junit.xml")
    failed = xml.parse(folder / "junit.xml").getroot().findall(".//failure")
    compare("serve --junit", situation, bool(failed), SITUATIONS[situation][2] != 0)


def traces(situation, folder):
    """A run that does not pass has no golden; a comparison with the golden of a passing run finds it, too."""
    number = SITUATIONS[situation][2]
    (folder / "goldens").mkdir()
    done = call(SIM, "traces", "regenerate", "x.yaml", "--folder", "goldens", "--no-progress", cwd=folder)
    compare("traces regenerate", situation, done.returncode, number, done.stdout + done.stderr)
    compare("traces regenerate", situation, (folder / "goldens" / "x.trace.xz").exists(), number == 0)
    if number == 0:
        done = call(SIM, "traces", "check", "x.yaml", "--folder", "goldens", "--no-progress", cwd=folder)
        compare("traces check", situation, done.returncode, 0, done.stdout + done.stderr)


def replay(situation, folder):
    """The recording is the expectation: whether anything is judged depends on the capture."""
    text, _, number = SITUATIONS[situation]
    (folder / "recorded.yaml").write_text(GOOD if situation == "nothing judged" else text)
    call(SIM, "run", "recorded.yaml", "--no-progress", "--capture", "x.pcapng", cwd=folder)
    late = ["--from", "1s"] if situation == "nothing judged" else []
    done = call(SIM, "replay", "x.pcapng", "--as", "5", *late, "--scenario", "x.yaml", "--no-progress", "--result", "result.json", cwd=folder)
    words = {"violation": ("FAILED: equal, but 2 violations", 1), "no data exchange": ("EQUAL", 0), "report": ("EQUAL, 2 violations not judged", 0),
             "off": ("EQUAL, checks off", 0), "nothing expected": ("EQUAL, data exchange not expected", 0), "good": ("EQUAL", 0)}
    if situation == "nothing judged":
        return compare("replay", situation, done.returncode, number, done.stdout[-500:] + done.stderr)
    return compare("replay", situation, (last_line(done), done.returncode), words[situation], done.stdout[-2000:] + done.stderr)


def c_api_and_python(situation, folder):
    """The property of Python is the call of the C API."""
    _, word, number = SITUATIONS[situation]
    result = dsdpv1.run(folder / "x.yaml")
    compare("Python", situation, (result.verdict, result.exit_code, result.passed), (word, number, number == 0))
    if situation == "violation":
        compare("Python", "checks=report", dsdpv1.run(folder / "x.yaml", checks="report").verdict, SITUATIONS["report"][1])


def lockstep(situation, folder):
    by_command("run --engine lockstep", situation, folder, SIM, "run", "x.yaml", "--no-progress", "--engine", "lockstep")


def cosim(situation, folder):
    """The example of docs/cosim.md with its error corrected, built once for all."""
    example = ROOT / "examples" / "own_rtl"
    pins = folder / "pins.yaml"
    pins.write_text((example / "pins.yaml").read_text() + "parameters: {RESET_VALUE: 1, PULSE: 64}\n")
    by_command("cosim", situation, folder, SIM, "cosim", "--rtl", example, "--top", "board_chip", "--pins", pins, "--build", folder.parent / "cosim", "x.yaml")


ENTRANCES = [run, run_tlm, junit, regress, sweep, serve, traces, replay, c_api_and_python]


def options():
    """Opting out on the command line acts as in the scenario; expectations that cannot be judged are refused."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "x.yaml").write_text(SITUATIONS["violation"][0])
        (folder / "event.yaml").write_text(SITUATIONS["violation"][0] + "expect: [{slave: io, event: INTR0_SERVICE}]\n")
        for words in (["run", "x.yaml"], ["serve", "x.yaml", "--tcp", "0", "--for", "8ms"]):
            for mode in ("report", "off"):
                done = call(SIM, *words, "--checks", mode, cwd=folder)
                compare(words[0] + " --checks", mode, (last_line(done), done.returncode), (SITUATIONS[mode][1], 0))
        (folder / "goldens").mkdir()
        (folder / "nothing.yaml").write_text(SITUATIONS["nothing judged"][0])
        done = call(SIM, "traces", "regenerate", "nothing.yaml", "x.yaml", "--folder", "goldens", cwd=folder)
        compare("traces regenerate", "one that fails beside one that judges nothing", done.returncode, 1, done.stdout)
        done = call(SIM, "run", "event.yaml", "--checks", "off", cwd=folder)
        compare("run --checks off", "an expectation on a check", (done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        (folder / "x.yaml").write_text(SITUATIONS["no data exchange"][0])
        done = call(SIM, "run", "x.yaml", "--set", "expect=none", cwd=folder)
        compare("run --set", "expect=none", done.returncode, 3, done.stdout)


def main():
    entrances = ENTRANCES + ([lockstep, cosim] if WITH_RTL else [])
    with tempfile.TemporaryDirectory() as name:
        for entrance in entrances:
            for situation, (text, _, _) in SITUATIONS.items():
                folder = pathlib.Path(name, f"{entrance.__name__} {situation}".replace(" ", "_"))
                folder.mkdir()
                (folder / "x.yaml").write_text(text)
                entrance(situation, folder)
    options()
    print(f"{len(entrances) * len(SITUATIONS)} cells")
    sys.exit("\n".join(FAILURES) or 0)


if __name__ == "__main__":
    os.environ.pop("NO_COLOR", None)
    main()
