"""Planted defects of the reference RTL: the scoreboard of cocotb names the cycle, the pin and the levels that `dsdpv1-sim run --engine lockstep` does.

    faults_test.py SIM FOLDER SIMULATOR SCENARIO FAULT,FAULT... END_US
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DIFFERENCE = re.compile(r"first difference +cycle (\d+) \(([\d.]+) us\)\s+pin (\w+): model (\w+), (?:RTL|DUT) (\w+)")


def output(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def expected_of(sim, folder, scenario, fault):
    """The difference that lockstep finds."""
    _, text = output(sim, "run", scenario, "--engine", "lockstep", "--fault", fault, "--no-progress", "--difference", folder / f"difference_{fault}.vcd")
    expected = DIFFERENCE.search(text)
    assert expected, text
    return expected


def main(sim, folder, simulator, name, faults, end):  # pylint: disable=too-many-arguments,too-many-positional-arguments
    folder.mkdir(parents=True, exist_ok=True)
    scenario = ROOT / "scenarios" / f"{name}.yaml"
    play = (sys.executable, "-B", ROOT / "examples" / "cocotb" / "run.py", "--simulator", simulator, "--build", folder / simulator, "--scenario", scenario, "--end",
            end, "--test", "the_pins_of_a_scenario_are_replayed")
    for fault in faults.split(","):
        expected = expected_of(sim, folder, scenario, fault)
        code, text = output(*play, "--fault", fault)
        found = DIFFERENCE.search(text)
        assert code == 1 and found, text
        assert found.groups() == expected.groups(), f"{found.group(0)}\nlockstep: {expected.group(0)}"
        print(f"{simulator}, fault {fault}:", " ".join(found.group(0).split()))
    code, text = output(*play)
    assert code == 0, text


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]), *sys.argv[3:])
