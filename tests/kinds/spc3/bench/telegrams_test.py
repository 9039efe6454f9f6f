#!/usr/bin/env python3
"""The same scenario with a DSDPV1 and with each chip of the SPC3 family: the telegrams on the line are equal, to the tick, except for what
docs/spc3.md says.

    telegrams_test.py DSDPV1_SIM
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[4]
POWER_ON = ROOT / "scenarios/spc3_power_on.yaml"
BY_SPI = ROOT / "scenarios/vpc3_spi_power_on.yaml"
SLOW_JUDGE = """name: x
baud: 12M
end: 20ms
slaves:
  - name: io
    address: 5
    init: {ident: 0x1234, max_inputs: 2, max_outputs: 2, max_prm: 3, max_diag: 8, max_cfg: 8, cfg: "31", prm_mode: 2, cfg_mode: 2}
    user_cpu: {behaviour: constant, constant: "A1 A2", cycle: 100us, judge_delay: 3ms}
masters:
  - {name: plc, address: 2, start: 2ms, slaves: [{slave: io, user_prm: "00 01 02", outputs: "01 02"}]}
"""
KINDS = ("apc3", "spc3", "vpc3")
OTHER_BUSES = ("intel_sync", "motorola_async", "motorola_sync")
FAILURES = []


def telegrams(simulator, scenario, *settings):
    """Time, bytes and words of each."""
    with tempfile.TemporaryDirectory() as folder:
        words = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([simulator, "run", scenario, "-q", "--checks", "off", "--log", "x.jsonl", *words], cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1):
            sys.exit(done.stderr)
        lines = (json.loads(line) for line in pathlib.Path(folder, "x.jsonl").read_text(encoding="utf-8").splitlines())
        return [(line["at_ns"], line["bytes"], line["text"]) for line in lines if line["kind"] == "telegram"]


def expect(what, seen, wanted):
    if seen != wanted:
        FAILURES.append(f"{what}: {seen} instead of {wanted}")


def power_on(simulator):
    """A24: DATA_EX waits for the first inputs, so its first answer has them. The DSDPV1's has zeros."""
    usual = telegrams(simulator, POWER_ON, "chip.kind=dsdpv1")
    expect("telegrams of the DSDPV1", len(usual) > 3000, True)
    for kind in KINDS:
        own = telegrams(simulator, POWER_ON, f"chip.kind={kind}")
        expect(f"{kind}: telegrams", len(own), len(usual))
        expect(f"{kind}: times", [each[0] for each in own], [each[0] for each in usual])
        differ = [(a[1][21:44], b[1][21:44]) for a, b in zip(usual, own) if a[1] != b[1]]
        expect(f"{kind}: what differs", differ, [("00 00 00 00 00 00 00 00", "C0 C1 C2 C3 C4 C5 C6 C7")])


def other_buses(simulator):
    """The line does not show which bus the user CPU has. From the first access on it keeps the set-up of its settings, 27.75 ns (13.9 ns to
    ALE's fall with a latch), which a bus that is not at rest at power-on would not."""
    usual = telegrams(simulator, POWER_ON)
    for bus in OTHER_BUSES:
        expect(f"{bus}: telegrams", telegrams(simulator, POWER_ON, f"chip.bus={bus}") == usual, True)
        for limit, code in (("27ns", 0), ("28ns", 1)):
            words = [simulator, "run", POWER_ON, "-q", "--set", f"chip.bus={bus}", "--set", f"checks.BUS_SETUP.min={limit}"]
            expect(f"{bus}: set-up of {limit}", subprocess.run(words, capture_output=True, check=False).returncode, code)


def exchanges(heard):
    """Requests with their answers, without tokens, each once while it is repeated, and without diagnoses that wait for the user's verdict."""
    pairs = []
    for words in (re.sub(r" FCB=\d", "", each[2]) for each in heard if "token" not in each[2]):
        if "request" in words:
            pairs.append([words])
        elif pairs:
            pairs[-1].append(words)
    pairs = [pair for pair in pairs if not any("[Station_Not_Ready] [WD_On]" in words for words in pair)]
    return [pair for number, pair in enumerate(pairs) if number == 0 or pair != pairs[number - 1]]


def spi(simulator):
    """A slower bus: the same exchanges in the same order. A user CPU that is quick enough for the master's polls has the same telegrams, to the tick."""
    own, usual = telegrams(simulator, BY_SPI), telegrams(simulator, BY_SPI, "chip.bus=intel_async")
    expect("SPI: some exchanges", len(exchanges(usual)) > 50, True)
    expect("SPI: exchanges", exchanges(own), exchanges(usual))
    for setting in ("spi_mode=1", "spi_mode=2", "spi_mode=3", "spi_fetch=ahead"):
        words = [simulator, "run", BY_SPI, "-q", "--checks", "fail", "--set", f"chip.{setting}"]
        expect(f"SPI: {setting}", subprocess.run(words, capture_output=True, check=False).returncode, 0)
    slow = ("baud=1.5M", "end=90ms")
    expect("SPI: telegrams", telegrams(simulator, BY_SPI, *slow), telegrams(simulator, BY_SPI, "chip.bus=intel_async", *slow))


def slow_judge(simulator, scenario):
    """A49: a Set_Prm is taken when it is received, so a Chk_Cfg is served before the user's verdict. S15 has it the DSDPV1's way."""
    usual = telegrams(simulator, scenario, "chip.kind=dsdpv1")
    expect("the DSDPV1 refuses Chk_Cfg meanwhile", any("RS" in each[2] for each in usual), True)
    for kind in KINDS:
        expect(f"{kind}, prm_taken: verdict", telegrams(simulator, scenario, f"chip.kind={kind}", "chip.prm_taken=verdict"), usual)
        own = telegrams(simulator, scenario, f"chip.kind={kind}")
        expect(f"{kind}: refusals", [each[2] for each in own if " RS " in each[2]], [])
        expect(f"{kind}: data exchange", "Data_Exchange" in own[-2][2] or "Data_Exchange" in own[-3][2], True)


def long_parameters(simulator, scenario):
    """5.1: a telegram that is longer than its buffer is answered RR. The DSDPV1 acknowledges it, and reports Prm_Fault."""
    def answer(kind):
        heard = telegrams(simulator, scenario, f"chip.kind={kind}", "masters.0.slaves.0.user_prm=00*60")
        place = next(place for place, each in enumerate(heard) if "Set_Prm" in each[2])
        return heard[place + 1][1]
    expect("dsdpv1: Set_Prm too long", answer("dsdpv1"), "E5")
    for kind in KINDS:
        expect(f"{kind}: Set_Prm too long", answer(kind), "10 02 05 02 09 16")


def main():
    simulator = sys.argv[1]
    power_on(simulator)
    other_buses(simulator)
    spi(simulator)
    with tempfile.TemporaryDirectory() as folder:
        scenario = pathlib.Path(folder, "x.yaml")
        scenario.write_text(SLOW_JUDGE, encoding="utf-8")
        slow_judge(simulator, scenario)
        long_parameters(simulator, scenario)
    print("\n".join(FAILURES))
    return 1 if FAILURES else 0


if __name__ == "__main__":
    sys.exit(main())
