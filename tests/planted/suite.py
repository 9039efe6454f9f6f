"""The tests that search for a fault, in order: the shortest and most successful first. All are tests of the ordinary suite."""
import dataclasses
import json
import subprocess

SIM = "apps/dsdpv1-sim"
NOT_RUN = {"long", "nightly"}


@dataclasses.dataclass(frozen=True)
class Stage:
    program: str
    calls_sim: bool = False
    names: str = ""        # part of the names; else all


SCENARIOS = Stage("app_scenarios_test", calls_sim=True, names="All/Scenarios.")
SYSTEMC = ("time", "views", "bus", "tlm", "run", "ahead", "clock", "host_pins", "character", "binding", "rsu_tlm", "rsu_pins", "quantum", "decoupled",
           "byte_ports", "segment", "serial_platform", "bench", "host_bridge")
STAGES = {
    "systemc": (*(Stage(f"systemc_{name}_test") for name in SYSTEMC), SCENARIOS),
    "driver": (Stage("driver_spc3_model_test"), Stage("driver_test"), Stage("user_cpu_test"), SCENARIOS),
    "board": (Stage("arm_test"), Stage("app_arm_board_test", calls_sim=True), SCENARIOS),
    "checks": (Stage("xgate_checks_test"), Stage("spc3_checks_test"), Stage("checks_test"), Stage("user_cpu_test"), SCENARIOS),
}
SECONDS = 600  # per stage: the time limit of its tests


def read(build):
    """The cases of each test program that the suite runs, without the long ones."""
    listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True, check=True).stdout
    cases = {}
    for test in json.loads(listed)["tests"]:
        command = test.get("command", [])
        name = next((word.split("=", 1)[1] for word in command if word.startswith("--gtest_filter=")), None)
        labels = next((entry["value"] for entry in test["properties"] if entry["name"] == "LABELS"), [])
        if name and not NOT_RUN & set(labels):
            cases.setdefault(command[0].rsplit("/", 1)[-1], []).append(name)
    return cases


def names_of(cases, stage):
    return [name for name in cases.get(stage.program, []) if name.startswith(stage.names)]
