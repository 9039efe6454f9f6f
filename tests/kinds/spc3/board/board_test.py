#!/usr/bin/env python3
"""Firmware on the ARM board with a chip of the SPC3 family: by interrupt and polled, with each chip, engine, debugger and saved run; bad settings.

    board_test.py DSDPV1_SIM FIRMWARE_FOLDER GDB
"""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[4]
SCENARIO = ROOT / "scenarios/spc3_arm.yaml"
POLLED = ("--set", "user_cpu.switches=[PB0=high]")
FAILURES = []


class Bench:
    def __init__(self, simulator, firmware, gdb, folder):
        self.simulator, self.firmware, self.gdb, self.folder = simulator, firmware, gdb, folder

    def words(self, *words, scenario=SCENARIO):
        elf = ("--set", f"user_cpu.elf={self.firmware}/device_spc3.elf") if scenario == SCENARIO else ()
        return [self.simulator, "run", scenario, "-q", *elf, *words]

    def sim(self, *words, expected=0, scenario=SCENARIO):
        done = subprocess.run(self.words(*words, scenario=scenario), cwd=self.folder, capture_output=True, text=True, check=False)
        expect(words, done.returncode, expected, done.stdout[-1500:] + done.stderr)
        return done

    def read(self, name):
        return (self.folder / name).read_bytes()

    def is_refused(self, text, *words, scenario=SCENARIO):
        done = self.sim(*words, expected=2, scenario=scenario)
        expect(words, (done.stderr.count("\n"), text in done.stderr), (1, True), done.stderr)


def expect(what, seen, wanted, said=""):
    if seen != wanted:
        FAILURES.append(f"{what}: {seen} instead of {wanted}\n{said}")


def each_chip(bench):
    for kind in ("spc3", "vpc3"):
        bench.sim("--set", f"chip.kind={kind}")
    for engine in ("skip", "step"):
        bench.sim(*POLLED, "--engine", engine, "--trace", f"{engine}.trace", "--log", f"{engine}.log")
    expect("polled: pins of both engines", bench.read("step.trace"), bench.read("skip.trace"))
    expect("polled: logs of both engines", bench.read("step.log"), bench.read("skip.log"))


def spi(bench):
    """A VPC3+S at SPI1: the firmware keeps all checks; both engines agree."""
    scenario, elf = ROOT / "scenarios/vpc3_spi_arm.yaml", f"user_cpu.elf={bench.firmware}/device_spc3_spi.elf"
    for engine in ("skip", "step"):
        bench.sim("--set", elf, "--engine", engine, "--checks", "fail", "--trace", f"{engine}.trace", scenario=scenario)
    expect("SPI: pins of both engines", bench.read("step.trace"), bench.read("skip.trace"))
    for wrong, why in (("user_cpu.switches=[PA5=high]", "a pin that the board wires to the chip"), ("user_cpu.fsmc.datast=3", "fsmc with bus: spi")):
        bench.is_refused(why, "--set", elf, "--set", wrong, scenario=scenario)


def saved(bench):
    bench.sim("--log", "whole.log", "--save-at", "8ms", "x.run")
    done = subprocess.run([bench.simulator, "run", "--restore", "x.run", "-q"], cwd=bench.folder, capture_output=True, text=True, check=False)
    expect("restored", done.returncode, 0, done.stdout[-1500:] + done.stderr)


def debugger_looks(bench):
    """gdb reads all registers, the commands among them, in three places: no pin moves otherwise."""
    bench.sim("--trace", "alone.trace")
    run = subprocess.Popen(bench.words("--trace", "looked.trace", "--gdb", "0"), cwd=bench.folder, stderr=subprocess.PIPE, text=True)
    port = next(line for line in run.stderr if "localhost:" in line).rpartition("localhost:")[2].split()[0].strip(".,;")
    look = ("continue", "x/64bx 0x60000000", "x/16bx 0x600005f0")
    words = [f"target remote localhost:{port}", "break spc3_service", *look, *look, *look, "delete", "detach"]
    done = subprocess.run([bench.gdb, "-nx", "-batch", "-ex", "set remotetimeout 60", *(word for each in words for word in ("-ex", each)),
                           f"{bench.firmware}/device_spc3.elf"], capture_output=True, text=True, timeout=300, check=False)
    expect("gdb", (done.returncode, done.stdout.count("0x60000000:"), "0x60000038:" in done.stdout), (0, 3, True), done.stdout[-1000:] + done.stderr)
    expect("run with gdb", run.wait(timeout=300), 0)
    expect("pins with gdb", bench.read("looked.trace"), bench.read("alone.trace"))


def bad_settings(bench):
    without = bench.folder / "without.yaml"
    without.write_text("".join(line for line in SCENARIO.read_text(encoding="utf-8").splitlines(True) if " elf: " not in line), encoding="utf-8")
    bench.is_refused("elf is missing, slave board has an ARM board", scenario=without)
    bench.is_refused("it is firmware for a DSDPV1, expected some for apc3", "--set", f"user_cpu.elf={bench.firmware}/device_O2.elf")
    bench.is_refused("a pin that the board wires to the chip", "--set", "user_cpu.switches=[PG6=high]")
    bench.is_refused("interrupt_latency is that of kind: native", "--set", "user_cpu.interrupt_latency=1us")
    bench.is_refused("kind is arm and bus of the chip neither intel_async nor spi", "--set", "chip.bus=motorola_async")
    bench.is_refused("behaviour is for the program of board", "--set", "user_cpu.behaviour=constant")
    bench.is_refused("cpi without kind: arm", "--set", "user_cpu.cpi=2", scenario=ROOT / "scenarios/spc3_power_on.yaml")


def too_fast(bench):
    """DATAST without the time in which the FSMC sees NWAIT: the accesses end before XREADY."""
    done = bench.sim("--set", "user_cpu.fsmc.datast=3", "--set", "user_cpu.fsmc.addset=0", "--log", "fast.log", expected=1)
    expect("reason", "BEFORE_READY" in bench.read("fast.log").decode(), True, done.stdout[-500:])


def main():
    simulator, firmware, gdb = sys.argv[1:]
    for test in (each_chip, spi, saved, debugger_looks, bad_settings, too_fast):
        with tempfile.TemporaryDirectory() as folder:
            test(Bench(simulator, firmware, gdb, pathlib.Path(folder)))
        print(test.__name__, flush=True)
    print("\n".join(FAILURES))
    return 1 if FAILURES else 0


if __name__ == "__main__":
    sys.exit(main())
