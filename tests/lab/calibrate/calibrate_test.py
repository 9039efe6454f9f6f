#!/usr/bin/env python3
"""Captures of a chip with other parameters, as recorded by an analyser, and calibrate's results for them.

    calibrate_test.py SIM CASE [ENGINE]     ENGINE: rtl where it is built, else skip
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import analyser

ROOT = pathlib.Path(__file__).resolve().parents[3]
SIM = pathlib.Path(sys.argv[1]).resolve()
ENGINE = sys.argv[3] if len(sys.argv) > 3 else "skip"
MS = 1_000_000_000  # ps
CYCLE = 125_000 / 6  # ps

FAST = {"rts_lead": 7, "rts_trail": 2, "intr_low": 81, "intr_gap": 230, "access_interval": 61, "ready_cycles": 5000}
SLOW = {"search_window_ms": 3, "search_window_bits": 3000, "baud_control_ms": 9}
FAST_SCENARIO = """
name: A chip of other parameters, at 12 Mbit/s
baud: 12M
end: 25ms
chip: {chip}
slaves:
  - name: board
    address: 5
    gsd: {root}/scenarios/dsdpv1.gsd
    modules: ["8 bytes in, 8 bytes out"]
    init: {{prm_mode: 0, cfg_mode: 0}}
    user_cpu: {{behaviour: loop_back, cycle: 57us, judge_delay: 5us}}
    release_reset: 20us
masters:
  - {{name: plc, address: 2, start: 500us, bus: {{min_slave_interval: 0}}, slaves: [{{slave: board, watchdog: 100ms, outputs: "01 02 03 04 05 06 07 08"}}]}}
script:
{script}
"""
# The user holds the DPRAM while parameters and configuration arrive: both are written in one access, and the second pulse of INTR0 waits.
TWO_PULSES = "  - {at: 1500us, do: hold_dpram, slave: board, for: 400us}"
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
    """The interval contains the right value."""
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
    pins, end = run(folder, FAST_SCENARIO, FAST, TWO_PULSES)
    for rate, ppm in ANALYSERS:
        result = calibrate(folder, take(folder, pins, end, rate, ppm=ppm, jitter_ns=3, skew_ns=2, seed=int(rate) + ppm))
        found = parameters(result)
        assert not contradicted(result), (rate, ppm, contradicted(result))
        for name in ("rts_lead", "rts_trail", "access_interval"):
            assert_is(found[name], FAST[name])
        for name in ("intr_low", "intr_gap"):
            (assert_is if rate > 150e6 else assert_holds)(found[name], FAST[name])
            assert found[name]["hi"] - found[name]["lo"] < 6, found[name]
        if rate > 90e6:  # else a read of B004 is too short for the samples
            assert_holds(found["ready_cycles"], FAST["ready_cycles"])
        clock = result["chip_clock"]
        assert clock["ppm_lo"] <= -ppm <= clock["ppm_hi"] and clock["ppm_hi"] - clock["ppm_lo"] < 250, (rate, ppm, clock)


def slow_parameters(folder):
    """Times of the search and of the watchdog, from PBRXD, PBTXD, BR, READY and PBF; without PBF the one fall of BR may be a new initialisation."""
    pins, end = run(folder, SLOW_SCENARIO, SLOW)
    for ppm, more in ((100, ["PBF"]), (-100, ["PBF"]), (100, [])):
        few = analyser.only(pins, ["PBRXD", "PBTXD", "BR", "READY", *more])
        result = calibrate(folder, take(folder, few, end, 24e6, ppm=ppm, jitter_ns=3))
        found = parameters(result)
        assert not contradicted(result), contradicted(result)
        assert_is(found["search_window_ms"], SLOW["search_window_ms"])
        (assert_is if more else assert_holds)(found["baud_control_ms"], SLOW["baud_control_ms"])
        assert found["rts_lead"]["verdict"] == "not shown" and "PBRTS" in found["rts_lead"]["why"]


def slow_samples(folder):
    """If samples miss strobes, accesses and releases, calibrate contradicts no ruling for a correct chip."""
    pins, end = run(folder, FAST_SCENARIO, {})
    host = {name: trace for name, trace in pins.items() if not name.startswith("PB")}
    for rate in (24e6, 12e6, 8e6, 4e6, 1e6):
        result = calibrate(folder, take(folder, host, end, rate, ".vcd", ppm=60, jitter_ns=3, skew_ns=2), "--rate", str(int(rate)))
        assert not contradicted(result) and result["agrees"], (rate, contradicted(result))


def forms_and_names(folder):
    """Sigrok, CSV and VCD give the same; channels of other names and levels, a part of the pins, a wave of a run."""
    pins, end = run(folder, FAST_SCENARIO, FAST)
    some = ["PBRXD", "PBTXD", "PBRTS", "R_REQ", "R_STA", "L_REQ"]
    results = [calibrate(folder, take(folder, analyser.only(pins, some), end, 100e6, form, ppm=50, jitter_ns=2)) for form in analyser.WRITERS]
    for result in results:
        assert result["sample_ns"] == 10, "the rate is in the file, or shows in the times"
        assert [each.get("value") for each in result["parameters"]] == [each.get("value") for each in results[0]["parameters"]]
        assert_is(parameters(result)["access_interval"], FAST["access_interval"])
        assert parameters(result)["intr_low"]["why"] == "not in the capture: INTR0"
    renamed = {f"D{i}": pins[name] for i, name in enumerate(some)}
    renamed["D2"] = (1 - pins["PBRTS"][0], pins["PBRTS"][1])
    capture = take(folder, renamed, end, 100e6, ppm=50, jitter_ns=2)
    done = sim("calibrate", capture, folder=folder)
    assert done.returncode == 2 and "shows no pin of the chip" in done.stderr, "an analyser's D0 is no D0 of the chip"
    signals = [word for i, name in enumerate(some) for word in ("--signal", f"{name}={'!' * (i == 2)}D{i}")]
    for options in (signals, ["--map", "pins.yaml"]):
        ports = "".join(f"  {name}: {{port: D{i}, inverted: {'true' if i == 2 else 'false'}}}\n" for i, name in enumerate(some))
        (folder / "pins.yaml").write_text("pins:\n" + ports, encoding="utf-8")
        found = parameters(calibrate(folder, capture, *options))
        assert_is(found["rts_lead"], FAST["rts_lead"])
        assert_is(found["access_interval"], FAST["access_interval"])
    exact = calibrate(folder, "board.vcd", "--scope", "board", "--station", "5")
    assert_is(parameters(exact)["rts_trail"], FAST["rts_trail"])
    assert not contradicted(exact), contradicted(exact)


def answer_times(pins, after):
    """Begin and end in ps of the first answer after `after`, by PBRTS."""
    edges = [at for at in pins["PBRTS"][1] if at > after]
    return edges[1:3] if analyser.level_at(pins["PBRTS"], after) else edges[:2]


def contradictions(folder):
    """Each planted contradiction is reported with its ruling, place, and amount; there are no others."""
    pins, end = run(folder, FAST_SCENARIO, {})
    after = 7 * MS
    begin, finish = answer_times(pins, after)

    def planted(edited, ruling, at, by=None, rate=100e6):
        result = calibrate(folder, take(folder, edited, end, rate, ppm=30, jitter_ns=2))
        found = contradicted(result)
        assert found and all(each[0] == ruling for each in found), (ruling, found)
        places = [each for _, _, named in found for each in named]
        near = [each for each in places if abs(each["us"] * 1e6 * (1 + 30e-6) - at) < 60 * CYCLE + 1e5]
        assert near, (ruling, at, found)
        if by is not None:
            assert any(abs(abs(float(each["how"].split(" cycles")[0].split()[-1])) - by) < 2.5 for each in near), (by, near)

    result = calibrate(folder, take(folder, pins, end, 100e6, ppm=30, jitter_ns=2))
    assert not contradicted(result) and result["agrees"], contradicted(result)
    for wire, ruling in (("PBRTS", "P2"), ("L_STA", "H1")):
        edited, at = analyser.shifted(pins, wire, after, round(5 * CYCLE))
        planted(edited, ruling, at, 5 if wire == "PBRTS" else None)
    alone = idle_between(pins["L_STA"], after)
    planted({**pins, "L_STA": with_pulse(pins["L_STA"], alone, round(7 * CYCLE))}, "H1", alone)
    late = {**pins, **{pin: shift_all(pins[pin], begin, finish, round(9 * CYCLE)) for pin in ("PBRTS", "PBTXD", "PBRXD")}}
    planted(late, "S3", begin, 8)
    dropped = analyser.without(analyser.without(pins, "PBTXD", begin, finish), "PBRTS", begin, finish)
    dropped = analyser.without(dropped, "PBRXD", begin, finish)
    planted(dropped, "S3", begin)
    edited, at = analyser.shifted(pins, "PBTXD", begin + round(100 * CYCLE), round(1.6 * CYCLE))
    planted(edited, "S2", at, 2)
    edited, at = analyser.shifted(pins, "INTR0", 0, -round(9 * CYCLE))
    found = contradicted(calibrate(folder, take(folder, edited, end, 100e6, ppm=30, jitter_ns=2)))
    assert {each[0] for each in found} == {"P7"}, found


def idle_between(trace, after):
    """The middle of the first pause between two pulses after `after`, ps."""
    falls = [(edge, following) for i, (edge, following) in enumerate(zip(trace[1], trace[1][1:])) if edge > after and i % 2 == 1 - trace[0]]
    return sum(falls[0]) // 2


def with_pulse(trace, at, length):
    return trace[0], sorted([*trace[1], at, at + length])


def shift_all(trace, begin, finish, by):
    first, edges = trace
    return first, [at + by if begin <= at <= finish else at for at in edges]


def chip_block(folder):
    """The output of calibrate is a scenario's `chip`, and a run with it has the chip's own times."""
    pins, end = run(folder, FAST_SCENARIO, FAST, TWO_PULSES)
    capture = take(folder, pins, end, 200e6, ppm=-80, jitter_ns=1)
    calibrate(folder, capture, "--chip", "chip.yaml", "--jitter", "2")
    block = (folder / "chip.yaml").read_text(encoding="utf-8")
    scenario = FAST_SCENARIO.format(chip="CHIP", root=ROOT, script=TWO_PULSES).replace("chip: CHIP\n", block)
    (folder / "board.yaml").write_text(scenario, encoding="utf-8")
    done = sim("run", "board.yaml", "-q", "--checks", "report", "--wave", "again.vcd", "--wave-signals", "board.*", folder=folder)
    assert done.returncode == 0, done.stderr + done.stdout
    again, _ = analyser.read_wave(folder / "again.vcd", "board")
    for pin in ("PBRTS", "INTR0", "PBTXD"):
        assert again[pin] == pins[pin], f"{pin} of the run is not that of the capture\n{block}"


def shipped_scenarios(folder):
    """The model's own waves contradict nothing, and show the parameters of their scenarios."""
    for scenario, station, window in (("watchdog", "demo", 5), ("baud_change", "demo", 10), ("dpv1_c1", "demo", 5), ("set_slave_address", "demo", None)):
        sim("run", str(ROOT / "scenarios" / (scenario + ".yaml")), "-q", "--wave", "own.fst", folder=folder)
        result = calibrate(folder, "own.fst", "--scope", station)
        assert not contradicted(result), (scenario, contradicted(result))
        if window:
            assert_is(parameters(result)["search_window_ms"], window)


CASES = {case.__name__: case for case in (fast_parameters, slow_parameters, slow_samples, forms_and_names, contradictions, chip_block, shipped_scenarios)}

if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="dsdpv1_calibrate_") as name:
        CASES[sys.argv[2]](pathlib.Path(name))
