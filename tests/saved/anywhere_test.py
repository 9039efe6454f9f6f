#!/usr/bin/env python3
"""A run is saved at edges of its pins: the file is the same with and without a trace or a wave. For these the bench produces the edges of
characters that it otherwise passes as a whole; if the file depended on them, a run could not be restored without them.

usage: anywhere_test.py DSDPV1_SIM [--seed N]"""
import argparse
import os
import pathlib
import random
import tempfile

import runs

PS_PER_TICK = 1000 / runs.TICKS_PER_NS
EDGES = 12  # for each pin, and for the line
CASES = (("bus_timing",), ("bus_timing", "--view", "tlm"), ("two_slaves", "--checks", "off"), ("rsu_spi_limits",), ("rsu_uart_460k8",))


def edges_in(path):
    """The ticks at which each signal of a wave in VCD changes."""
    edges, tick, within = {}, 0, False
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            tick, within = round(int(line[1:]) / PS_PER_TICK), True
        elif within and line[:1] in ("0", "1", "x", "z", "b"):
            identifier = line.split()[1] if line[0] == "b" else line[1:]
            edges.setdefault(identifier, []).append(tick)
    return edges


def some_of(edges, chance):
    picked = {tick for ticks in edges.values() for tick in chance.sample(ticks, min(EDGES, len(ticks)))}
    return sorted(picked - {0})


def files_of(program, options, ticks, folder, outputs):
    """The runs saved at each tick."""
    files = [folder / f"{tick}.run" for tick in ticks]
    saves = [word for tick, file in zip(ticks, files) for word in ("--save-at", runs.time_of(tick), file)]
    done = runs.call(program, *options, *saves, *outputs)
    if done.returncode not in (0, 1):
        raise SystemExit(f"{' '.join(options)}: {done.stderr}")
    return [file.read_bytes() for file in files]


def check(program, case, seed):
    options = [f"scenarios/{case[0]}.yaml", *case[1:]]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        runs.call(program, *options, "--wave", folder / "all.vcd")
        ticks = some_of(edges_in(folder / "all.vcd"), random.Random(f"{seed} {case}"))
        alone = files_of(program, options, ticks, folder, [])
        for outputs in (["--trace", folder / "a.txt"], ["--wave", folder / "a.fst", "--log", folder / "a.log"]):
            saved = files_of(program, options, ticks, folder, outputs)
            others = [tick for tick, one, other in zip(ticks, alone, saved) if one != other]
            if others:
                yield f"{' '.join(case)}: with {outputs[0]} {len(others)} of {len(ticks)} files are others, the first at tick {others[0]}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--seed", default="1")
    arguments = parser.parse_args()
    return runs.report([failure for case in CASES for failure in check(arguments.program, case, arguments.seed)])


if __name__ == "__main__":
    raise SystemExit(main())
