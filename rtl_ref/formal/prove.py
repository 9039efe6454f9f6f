#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Unbounded proofs of the reference RTL, each with broken twins that have to fail.

A proof takes copies of the RTL, binds its properties into one block (in front of endmodule), makes its surroundings free and
proves the properties without a bound. A twin is the same with one defect, from a list of faults or an edit, and has to have a trace from
RESET that violates them.
"""
import argparse
import concurrent.futures
import pathlib
import re
import subprocess
import sys
import time

from proofs import CHIP, PROOFS

FORMAL = pathlib.Path(__file__).resolve().parent
RTL = FORMAL.parent
BINDINGS = RTL.parent / "bindings" / "systemverilog"
ASSERTIONS = "dsdpv1_assertions.sv"
HEADERS = [path.name for path in RTL.glob("*.svh")]
HOLDS, VIOLATED, UNKNOWN = "holds", "violated", "unknown"
LIMIT_SECONDS = 900  # for one run of a tool; far more than a busy machine needs
ROW = "{:70} | {:9} | {:8} | {:>7} | {}"


def fail(message):
    sys.exit(f"prove.py: {message}")


def replace_once(text, old, new, where):
    if text.count(old) != 1:
        fail(f"{where}: '{old}' stands there {text.count(old)} times, not once")
    return text.replace(old, new)


def defects(proof):
    """The defects of its twins: faults of a list, and the edit."""
    return proof.faults + tuple(each for each in (proof.edit, proof.second) if each)


def files(proof):
    return (RTL / proof.chip / "files.txt").read_text(encoding="utf-8").split()


def sources(proof, defect):
    """Texts by name: the RTL, bound properties, and the defect if there is one."""
    texts = {name: (RTL / name).read_text(encoding="utf-8") for name in files(proof) + HEADERS}
    for block, properties in proof.bind.items():
        text = (FORMAL / f"{properties}.svh").read_text(encoding="utf-8")
        texts[block] = replace_once(texts[block], "\nendmodule", f"\n{text}endmodule", block)
    if proof.asserts:
        texts[CHIP] = replace_once(texts[CHIP], "\nendmodule", f"\n{bound_assertions()}\nendmodule", CHIP)
        texts[ASSERTIONS] = (BINDINGS / ASSERTIONS).read_text(encoding="utf-8")
    if isinstance(defect, int):
        name = "profibus_types.svh"
        texts[name] = replace_once(texts[name], "`define FAULT(n) 1'b0", f"`define FAULT(n) (n == {defect})", name)
    elif defect:
        name, old, new = defect
        texts[name] = replace_once(texts[name], old, new, name)
    return texts


def bound_assertions():
    """The module that dsdpv1_bind.sv binds, as an instance: Yosys 0.23 reads a `bind` and forgets it."""
    return re.search(r"^bind `DSDPV1_TOP (.*;)$", (BINDINGS / "dsdpv1_bind.sv").read_text(encoding="utf-8"), re.M)[1]


def only_asserts(proof):
    """Commands that delete all other assertions of the chip: those of this proof are known by their lines."""
    lines = (BINDINGS / ASSERTIONS).read_text(encoding="utf-8").splitlines()
    here = [number for number, line in enumerate(lines, 1) for name in proof.asserts if f"HOLDS({name}," in line or f": {name} assert" in line]
    if len(here) != len(proof.asserts):
        fail(f"{proof.name}: {len(proof.asserts)} assertions are named, {len(here)} found in {ASSERTIONS}")
    kept = " ".join(f"a:src=*{ASSERTIONS}:{number}.*" for number in here)
    return f"select -set named {kept}; select -set others t:$assert @named %d; delete @others; "


def yosys(proof, folder, is_twin):
    """Writes model.aig or model.smt2. TWIN is defined for a twin, which has to violate the goal, not only a lemma."""
    cuts = "".join(f"cutpoint {cell}; " for cell in proof.cut_cells)
    wires = "".join(f"cutpoint {wire}; " for wire in proof.cut_wires)
    defines = " ".join(f"-D{define}" for define in proof.defines + (("TWIN",) if is_twin else ()))
    names = files(proof) + ([ASSERTIONS] if proof.asserts else [])
    common = (f"read_verilog -formal -sv {defines} -I. -I{RTL.parent / 'registers'} {' '.join(names)}; "
              f"hierarchy -check -top {proof.top}; proc; {cuts}flatten; {wires}{only_asserts(proof) if proof.asserts else ''}{'clk2fflogic' if proof.two_clocks else 'async2sync'}; delete -output; opt_clean; "
              "memory_map; setundef -undriven -anyseq; opt -full; dffunmap; ")
    if engine_of(proof, is_twin) != "induction":
        script = common + "techmap; opt -fast; dffunmap; abc -g AND -fast; opt_clean; write_aiger -I -zinit model.aig"
    else:
        script = common + "write_smt2 -wires model.smt2"
    run(["yosys", "-q", "-e", "implicitly declared", "-l", "yosys.log", "-p", script], folder)


def miter(proof, folder):
    """Two copies from any two states, the excepted registers equal: those others that differ three edges after RESET, or later."""
    excepted = " ".join(f"w:{name}" for name in proof.excepted)
    script = (f"read_verilog -sv -I. -I{RTL.parent / 'registers'} {' '.join(files(proof))}; hierarchy -check -top {proof.top}; proc; flatten; opt_clean; "
              f"memory_collect; opt_clean; expose -input {excepted} %u; opt_clean -purge; memory_map; opt_clean; expose -dff; async2sync; opt_clean; "
              f"rename {proof.top} gold; copy gold gate; miter -equiv -flatten -make_outputs gold gate miter; hierarchy -top miter; "
              "sat -verify -seq 4 -prove-skip 3 -set-at 1 in_reset_i 0 -prove trigger 0 miter; "
              "sat -verify -seq 2 -prove-skip 1 -set-at 1 trigger 0 -prove trigger 0 miter")
    output = run(["yosys", "-q", "-l", "yosys.log", "-p", script], folder, (0, 1))
    if "proof did fail" in output:
        return VIOLATED
    return HOLDS if (folder / "yosys.log").read_text(encoding="utf-8").count("SAT proof finished - no model found: SUCCESS!") == 2 else UNKNOWN


def run(command, folder, allowed=(0,)):
    """Output of a tool, "" when it took too long."""
    try:
        done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False, timeout=LIMIT_SECONDS)
    except subprocess.TimeoutExpired:
        return ""
    if done.returncode not in allowed:
        fail(f"{command[0]} in {folder}:\n{done.stdout[-2000:]}")
    return done.stdout


def engine_of(proof, is_twin):
    """A twin of an induction without a depth is a search for a trace alone."""
    return "bmc3" if is_twin and proof.engine == "induction" and not proof.twin_depth else proof.engine


def pdr(folder, command="pdr"):
    output = run(["yosys-abc", "-c", f"read_aiger model.aig; fold; strash; {command}"], folder)
    (folder / "pdr.log").write_text(output, encoding="utf-8")
    if "Property proved" in output:
        return HOLDS
    return VIOLATED if "was asserted in frame" in output else UNKNOWN


def induction(proof, folder, is_twin):
    """k-induction; a twin only counts as violated by a trace from RESET."""
    smtbmc = ["yosys-smtbmc", "-s", "z3", "--unroll", "--noprogress"]
    base = run([*smtbmc, "-t", str(proof.twin_depth if is_twin else proof.depth), "model.smt2"], folder, (0, 1))
    if "Status: FAILED" in base:
        return VIOLATED
    if "Status: PASSED" not in base:
        return UNKNOWN
    step = run([*smtbmc, "-i", "-t", str(proof.depth), "model.smt2"], folder, (0, 1))
    return HOLDS if "Status: PASSED" in step else UNKNOWN


def folder_of(proof, defect):
    if not defect:
        return "chip"
    return f"twin_{defect}" if isinstance(defect, int) else "twin_second" if defect == proof.second else "twin"


def solve(proof, defect, out):
    """Result and seconds, of the chip or of the twin with this defect."""
    folder = out / proof.name / folder_of(proof, defect)
    for name, text in sources(proof, defect).items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    begin = time.monotonic()
    engine = engine_of(proof, bool(defect))
    if engine == "miter":
        return miter(proof, folder), time.monotonic() - begin
    yosys(proof, folder, bool(defect))
    result = induction(proof, folder, bool(defect)) if engine == "induction" else pdr(folder, engine)
    return result, time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for models and logs")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("names", nargs="*", help="proofs, by default all")
    arguments = parser.parse_args()
    chosen = [proof for proof in PROOFS if not arguments.names or proof.name in arguments.names]
    if len(chosen) < len(arguments.names):
        fail(f"unknown proof, known are {', '.join(proof.name for proof in PROOFS)}")
    proved = twins = found = 0
    print(ROW.format("proof", "engine", "result", "seconds", "broken twins found"))
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        runs = [[pool.submit(solve, proof, defect, arguments.out) for defect in (None, *defects(proof))] for proof in chosen]
        for proof, (chip, *broken) in zip(chosen, runs):
            (result, seconds), results = chip.result(), [twin.result()[0] for twin in broken]
            proved += result == HOLDS
            twins += len(results)
            found += results.count(VIOLATED)
            missed = [each for each in results if each != VIOLATED]
            answer = f"NO: {', '.join(missed)}" if missed else "yes" if len(results) == 1 else f"all {len(results)}"
            print(ROW.format(proof.title, proof.engine, result, f"{seconds:.1f}", answer), flush=True)
    print(f"{proved} of {len(chosen)} proofs hold, {found} of {twins} broken twins found")
    return 0 if proved == len(chosen) and found == twins else 1


if __name__ == "__main__":
    sys.exit(main())
