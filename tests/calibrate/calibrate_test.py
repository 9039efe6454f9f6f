#!/usr/bin/env python3
"""Captures of a chip with other parameters, as an analyser takes them, and what calibrate makes of them.

    calibrate_test.py SIM CASE [ENGINE]     ENGINE: rtl where it is built, else skip
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import analyser

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIM = pathlib.Path(sys.argv[1]).resolve()
ENGINE = sys.argv[3] if len(sys.argv) > 3 else "skip"
MS = 1_000_000_000  # ps
CYCLE = 125_000 / 6  # ps

FAST = {"rts_lead": 7, "rts_trail": 2, "intr_low": 81, "intr_gap": 230, "access_interval": 61, "ready_cycles": 5000}
SLOW = {"search_window_ms": 3, "search_window_bits": 3000, "baud_control_ms": 9}
FAST_SCENARIO = """
name: A chip of other parameters, at 12 Mbit/s
baud: 12M
end: 12ms
chip: {chip}
slaves:
  - name: board
    address: 5
    gsd: {root}/scenarios/dsdpv1.gsd
    modules: ["8 bytes in, 8 bytes out"]
    init: {{prm_mode: 2, cfg_mode: 0}}
    user_cpu: {{behaviour: loop_back, cycle: 57us, judge_delay: 5us}}
    release_reset: 20us
masters:
  - {{name: plc, address: 2, start: 500us, bus: {{min_slave_interval: 0}}, slaves: [{{slave: board, watchdog: 100ms, outputs: "01 02 03 04 05 06 07 08"}}]}}
script:
{script}
"""
# The user judges the parameters at once and holds the DPRAM when the same come again, with the configuration close behind them: both are
# written in one access, so that the second pulse of INTR0 has to wait.
TWO_PULSES = """  - {at: 6ms, do: hold_dpram, slave: board, for: 400us}
  - {at: 6050us, do: telegram, master: plc, bytes: "68 0C 0C 68 85 82 6D 3D 3E 88 0A 14 0B 00 00 00 00 00"}
"""
SLOW_SCENARIO = """
name: A chip of other times, at 1.5 Mbit/s
baud: 1.5M
end: 60ms
chip: {chip}
slaves:
  - name: board
    address: 5
    gsd: {root}/scenarios/dsdpv1.gsd
    modules: ["8 bytes in, 8 bytes out"]
    user_cpu: {{behaviour: loop_back, cycle: 200us}}
    release_reset: 20us
masters:
  - {{name: plc, address: 2, start: 100us, bus: {{min_slave_interval: 0}}, slaves: [{{slave: board, outputs: "01 02 03 04 05 06 07 08"}}]}}
script:
  - {{at: 30ms, do: stop_master, master: plc}}
  - {{at: 42ms, do: start_master, master: plc}}
"""


def sim(*arguments, folder):
    return subprocess.run([SIM, *arguments], cwd=folder, capture_output=True, text=True, check=False)


def run(folder, scenario, chip, script=""):
    """The pins of a run of a chip with these parameters."""
    (folder / "board.yaml").write_text(scenario.format(chip=json.dumps(chip), root=ROOT, script=script or "  []"), encoding="utf-8")
    done = sim("run", "board.yaml", "-q", "--engine", ENGINE, "--wave", "board.vcd", "--wave-signals", "board.*", folder=folder)
    assert done.returncode in (0, 1) and not done.stderr, done.stderr
    return analyser.read_wave(folder / "board.vcd", "board")


def calibrate(folder, capture, *options):
    done = sim("calibrate", capture, "-q", "--json", "result.json", *options, folder=folder)
    assert done.returncode in (0, 1), done.stderr
    result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    assert result["agrees"] == (done.returncode == 0)
    return result


def take(folder, pins, end, rate, form=".sr", **off):
    sampled, count = analyser.sample(pins, end, rate, **off)
    name = "capture" + form
    analyser.WRITERS[form](folder / name, sampled, count, rate)
    return name


def parameters(result):
    return {each["parameter"]: each for each in result["parameters"]}


def contradicted(result):
    return [(each["ruling"], each["claim"], each["contradictions"]) for each in result["rulings"] if each["verdict"] == "CONTRADICTED"]


def assert_holds(each, right):
    """The interval has the right value in it."""
    low, high = each.get("lo"), each.get("hi")
    assert each["verdict"] != "not shown", each
    assert (low is None or low <= right) and (high is None or right <= high), (each, right)


def assert_is(each, right):
    assert_holds(each, right)
    assert each["value"] == right, (each, right)
    assert (each["verdict"] == "confirmed") == (each["default"] == right), each


ANALYSERS = [(24e6, -100), (24e6, 100), (48e6, 100), (100e6, -100), (200e6, 37)]


def fast_parameters(folder):
    """Every parameter of the pins at 12 Mbit/s is recovered, at each rate, by clocks off by 100 ppm."""
    pins, end = run(folder, FAST_SCENARIO, FAST)
    for rate, ppm in ANALYSERS:
        result = calibrate(folder, take(folder, pins, end, rate, ppm=ppm, jitter_ns=3, skew_ns=2, seed=int(rate) + ppm))
        found = parameters(result)
        assert not contradicted(result), (rate, ppm, contradicted(result))
        for name in ("rts_lead", "rts_trail", "access_interval"):
            assert_is(found[name], FAST[name])
        assert_holds(found["intr_low"], FAST["intr_low"])
        assert_holds(found["ready_cycles"], FAST["ready_cycles"])
        clock = result["chip_clock"]
        assert clock["ppm_lo"] <= -ppm <= clock["ppm_hi"] and clock["ppm_hi"] - clock["ppm_lo"] < 250, (rate, ppm, clock)


def slow_parameters(folder):
    """Times of the search and of the watchdog, from PBRXD, PBTXD, BR and READY."""
    pins, end = run(folder, SLOW_SCENARIO, SLOW)
    for rate, ppm in ((24e6, 100), (24e6, -100)):
        few = analyser.only(pins, ["PBRXD", "PBTXD", "BR", "READY"])
        result = calibrate(folder, take(folder, few, end, rate, ppm=ppm, jitter_ns=3))
        found = parameters(result)
        assert not contradicted(result), contradicted(result)
        assert_is(found["search_window_ms"], SLOW["search_window_ms"])
        assert_is(found["baud_control_ms"], SLOW["baud_control_ms"])
        assert found["rts_lead"]["verdict"] == "not shown" and "PBRTS" in found["rts_lead"]["why"]


CASES = {case.__name__: case for case in (fast_parameters, slow_parameters)}

if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="dsdpv1_calibrate_") as name:
        CASES[sys.argv[2]](pathlib.Path(name))
