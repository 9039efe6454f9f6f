#!/usr/bin/env python3
"""One run, from power-on to data exchange, through every interface to the model: the C API from C, the Python module, DPI-C in Verilator with and
without a CLK, VPI in Icarus, cocotb, SystemC at 1 fs and at 1 ps. Each gets the inputs of the golden trace; each change of each output must match
the golden, and so all interfaces match each other.

    every_way_test.py BUILD SIM WAY...

Each interface has its unit of time: ticks of 1/12 ns, ps or fs. A change is at its tick if its time is the nearest to that tick: at most half a
unit off, 0.5 fs or 0.5 ps. As a unit is less than a tick it belongs to no other.
at most, 0.5 fs or 0.5 ps, and as a unit is less than a tick it belongs to no other.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "bindings_sv"))
from golden import END, GOLDEN, INPUTS, OUTPUTS, golden_changes, write_inputs  # noqa: E402  pylint: disable=wrong-import-position

import dsdpv1  # noqa: E402  pylint: disable=wrong-import-position

PS, FS = 1000, 1_000_000  # units a ns, of which a tick is a twelfth
TICK = 12
BINDINGS = pathlib.Path(sys.argv[1]).resolve() / "bindings" / "systemverilog"
PINS = {pin.name: pin.number for pin in dsdpv1.kind_of("dsdpv1").pins}
NAMES = {number: name for name, number in PINS.items()}
POWER_ON = {pin.number: pin.reset_level for pin in dsdpv1.kind_of("dsdpv1").pins if pin.name in OUTPUTS}


def tick_of(time, unit):
    """The only tick whose time, rounded to the nearest unit (a half up), this is."""
    tick = (2 * time * TICK + unit) // (2 * unit)
    assert (2 * tick * unit + TICK) // (2 * TICK) == time, f"{time} of {unit} units a ns is no tick's time"
    return tick


def level_of(bits):
    return -1 if "z" in bits else -2 if "x" in bits else int(bits, 2)


END_TICK = tick_of(END, PS)


# ---- the interfaces: each returns (tick, pin, level)
def call(command, **options):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    assert done.returncode == 0, f"{command[0]}: {done.stdout}"


def lines_of(path, unit):
    for line in path.read_text(encoding="ascii").splitlines():
        time, pin, level = map(int, line.split())
        yield tick_of(time, unit), pin, level


def c_api(folder, build):
    call([build / "tests/every_way/every_way_play", folder / "changes.txt", folder / "c.txt", END_TICK])
    return lines_of(folder / "c.txt", TICK)


def python(folder, _build):
    chip = dsdpv1.Chip()
    chip.watch(list(OUTPUTS))
    chip.set_many([(tick, 0, pin, level) for tick, pin, level in lines_of(folder / "changes.txt", TICK)])
    chip.advance(END_TICK)
    return [(tick, pin, level) for tick, _, pin, level, *_ in chip.changes().tolist()]


def systemc(folder, build, unit):
    path = folder / f"systemc_{unit}.txt"
    call([build / "tests/every_way/every_way_play_systemc", folder / "changes.txt", path, END_TICK, FS // unit])
    return lines_of(path, unit)


def of_replay(path):
    """replay.sv has a line for all outputs at each change of one."""
    for line in path.read_text(encoding="ascii").splitlines():
        time, bits = line.split()
        d_out = "z" if bits[2] == "0" else bits[3:11]
        for name, value in zip(OUTPUTS, [bits[0], bits[1], d_out, *bits[11:17]]):
            yield tick_of(int(time), PS), PINS[name], level_of(value)


def replayed(folder, name, command):
    call([*command, f"+inputs={folder}/inputs.txt", f"+outputs={folder}/{name}.txt"], cwd=folder)
    return of_replay(folder / f"{name}.txt")


def dpi(folder, build, bench):
    return replayed(folder, bench, [build / "tests/bindings_sv" / bench / "Vreplay"])


def sources():
    return [BINDINGS / line for line in (BINDINGS / "files.txt").read_text(encoding="ascii").split()]


def vpi(folder, build):
    call(["iverilog", "-g2012", "-DDSDPV1_VPI", "-DDSDPV1_IMMEDIATE", "-DUNCLOCKED", "-I", BINDINGS, "-s", "replay", "-o", folder / "replay.vvp", build / "bindings/dsdpv1.vpi",
          *sources(), ROOT / "tests/bindings_sv/replay.sv"])
    return replayed(folder, "vpi", ["vvp", folder / "replay.vvp"])


def cocotb(folder, build):
    from cocotb.runner import get_results, get_runner  # pylint: disable=import-outside-toplevel
    runner, path = get_runner("icarus"), folder / "cocotb"
    runner.build(verilog_sources=[build / "bindings/dsdpv1.vpi", *sources()], hdl_toplevel="dsdpv1_model", includes=[BINDINGS], parameters={"CLOCKED": 0}, timescale=("1ps", "1ps"),
                 build_dir=path, build_args=["-g2012", "-DDSDPV1_VPI", "-DDSDPV1_IMMEDIATE"])
    environment = {"INPUTS": str(folder / "changes.txt"), "OUTPUTS": str(folder / "cocotb.txt"), "END": str(END_TICK),
                   "PYTHONPATH": f"{ROOT / 'tests/every_way'}:{os.environ.get('PYTHONPATH', '')}"}
    results = get_results(runner.test(hdl_toplevel="dsdpv1_model", test_module="play_cocotb", test_dir=path, build_dir=path, results_xml=str(path / "results.xml"),
                                      extra_env=environment))
    assert results == (1, 0), results
    return lines_of(folder / "cocotb.txt", PS)


WAYS = {
    "C": c_api,
    "Python": python,
    "SystemC, 1 fs": lambda folder, build: systemc(folder, build, FS),
    "SystemC, 1 ps": lambda folder, build: systemc(folder, build, PS),
    "DPI": lambda folder, build: dpi(folder, build, "replay"),
    "DPI, no CLK": lambda folder, build: dpi(folder, build, "replay_unclocked"),
    "VPI": vpi,
    "cocotb": cocotb,
}
WITHOUT_X = ("DPI", "DPI, no CLK")  # Verilator has two levels: what is X elsewhere is some value


# ---- comparison
def settled(changes, begin):
    """{tick: levels of all outputs} from `begin` on, where one differs from before."""
    levels, at = dict(POWER_ON), {}
    for tick, pin, level in changes:
        if pin in NAMES and NAMES[pin] in OUTPUTS and tick < END_TICK:
            levels[pin] = level
            at[max(tick, begin)] = dict(levels)
    kept, before = {}, None
    for tick in sorted(at):
        if at[tick] != before:
            kept[tick] = before = at[tick]
    return kept


def same(golden, here, has_x):
    return golden == here or (golden == -2 and here >= 0 and not has_x)


def difference(golden, here, has_x):
    """The first one, in words; "" when there is none."""
    wanted, seen = POWER_ON, POWER_ON
    for tick in sorted({*golden, *here}):
        wanted, seen = golden.get(tick, wanted), here.get(tick, seen)
        for pin in wanted:
            if not same(wanted[pin], seen[pin], has_x):
                return f"tick {tick}: {NAMES[pin]} of the golden is {wanted[pin]}, here {seen[pin]}"
    return ""


def main(build, sim, ways):
    with tempfile.TemporaryDirectory(prefix="dsdpv1_every_way_") as name:
        folder = pathlib.Path(name)
        call([sim, "traces", "wave", GOLDEN, folder / "golden.vcd"], cwd=ROOT)
        write_inputs(folder / "golden.vcd", folder / "inputs.txt")
        changes = [(tick_of(time, PS), PINS[pin], level_of(bits)) for time, pin, bits in golden_changes(folder / "golden.vcd") if pin in PINS and time < END]
        played = [each for each in changes if NAMES[each[1]] in INPUTS]
        (folder / "changes.txt").write_text("".join("%d %d %d\n" % each for each in played), encoding="ascii")
        begin = next(tick for tick, pin, level in played if pin == PINS["RESET"] and level == 1)
        golden = settled(changes, begin)
        assert len(golden) > 3000 and golden[max(golden)][PINS["PBF"]] == 0, "the golden does not come to data exchange"
        failed = 0
        for way in ways:
            here = settled(WAYS[way](folder, build), begin)
            what = difference(golden, here, way not in WITHOUT_X)
            failed += what != ""
            print(f"{way:14}  {what or f'{len(here)} times at which an output changes, all as in the golden'}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3:]))
