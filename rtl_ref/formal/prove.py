#!/usr/bin/env python3
"""Unbounded proofs of the reference RTL, each with a broken twin that has to fail.

A proof takes copies of the RTL, binds its properties into one block (in front of endmodule), makes its surroundings free and
proves the properties for ever. Its twin is the same with one defect, from faults.txt or an edit, and has to have a trace from
RESET that violates them.
"""
import argparse
import concurrent.futures
import pathlib
import subprocess
import sys
import time

from proofs import PROOFS

FORMAL = pathlib.Path(__file__).resolve().parent
RTL = FORMAL.parent
SOURCES = (RTL / "files.txt").read_text(encoding="utf-8").split()
HOLDS, VIOLATED, UNKNOWN = "holds", "violated", "unknown"
LIMIT_SECONDS = 120  # for one run of a tool
ROW = "{:70} | {:9} | {:8} | {:>7} | {}"


def fail(message):
    sys.exit(f"prove.py: {message}")


def replace_once(text, old, new, where):
    if text.count(old) != 1:
        fail(f"{where}: '{old}' stands there {text.count(old)} times, not once")
    return text.replace(old, new)


def sources(proof, with_defect):
    """Texts by name: the RTL, bound properties, and the defect."""
    texts = {name: (RTL / name).read_text(encoding="utf-8") for name in SOURCES + ["dsdpv1_types.svh"]}
    for block, properties in proof.bind.items():
        text = (FORMAL / f"{properties}.svh").read_text(encoding="utf-8")
        texts[block] = replace_once(texts[block], "\nendmodule", f"\n{text}endmodule", block)
    if with_defect and proof.fault:
        name = "dsdpv1_types.svh"
        texts[name] = replace_once(texts[name], "`define FAULT(n) 1'b0", f"`define FAULT(n) (n == {proof.fault})", name)
    elif with_defect:
        name, old, new = proof.edit
        texts[name] = replace_once(texts[name], old, new, name)
    return texts


def yosys(proof, folder, with_defect):
    """Writes model.aig or model.smt2. TWIN is defined for a twin, which has to violate the goal, not only a lemma."""
    cuts = "".join(f"cutpoint {cell}; " for cell in proof.cut_cells)
    wires = "".join(f"cutpoint {wire}; " for wire in proof.cut_wires)
    defines = " ".join(f"-D{define}" for define in proof.defines + (("TWIN",) if with_defect else ()))
    common = (f"read_verilog -formal -sv {defines} -I. -I{RTL.parent / 'registers'} {' '.join(SOURCES)}; "
              f"hierarchy -check -top {proof.top}; proc; {cuts}flatten; {wires}async2sync; delete -output; opt_clean; "
              "memory_map; setundef -undriven -anyseq; opt -full; dffunmap; ")
    if proof.engine == "pdr":
        script = common + "techmap; opt -fast; dffunmap; abc -g AND -fast; opt_clean; write_aiger -I -zinit model.aig"
    else:
        script = common + "write_smt2 -wires model.smt2"
    run(["yosys", "-q", "-e", "implicitly declared", "-l", "yosys.log", "-p", script], folder)


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


def pdr(folder):
    output = run(["yosys-abc", "-c", "read_aiger model.aig; fold; strash; pdr"], folder)
    (folder / "pdr.log").write_text(output, encoding="utf-8")
    if "Property proved" in output:
        return HOLDS
    return VIOLATED if "was asserted in frame" in output else UNKNOWN


def induction(proof, folder, with_defect):
    """k-induction; a twin only counts as violated by a trace from RESET."""
    smtbmc = ["yosys-smtbmc", "-s", "z3", "--unroll", "--noprogress"]
    base = run([*smtbmc, "-t", str(proof.twin_depth if with_defect else proof.depth), "model.smt2"], folder, (0, 1))
    if "Status: FAILED" in base:
        return VIOLATED
    if "Status: PASSED" not in base:
        return UNKNOWN
    step = run([*smtbmc, "-i", "-t", str(proof.depth), "model.smt2"], folder, (0, 1))
    return HOLDS if "Status: PASSED" in step else UNKNOWN


def solve(proof, with_defect, out):
    """Result and seconds."""
    folder = out / proof.name / ("twin" if with_defect else "chip")
    for name, text in sources(proof, with_defect).items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    begin = time.monotonic()
    yosys(proof, folder, with_defect)
    result = pdr(folder) if proof.engine == "pdr" else induction(proof, folder, with_defect)
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
    proved = found = 0
    print(ROW.format("proof", "engine", "result", "seconds", "broken twin found"))
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        runs = [[pool.submit(solve, proof, defect, arguments.out) for defect in (False, True)] for proof in chosen]
        for proof, (chip, twin) in zip(chosen, runs):
            (result, seconds), (twin_result, _) = chip.result(), twin.result()
            proved += result == HOLDS
            found += twin_result == VIOLATED
            answer = "yes" if twin_result == VIOLATED else f"NO: {twin_result}"
            print(ROW.format(proof.title, proof.engine, result, f"{seconds:.1f}", answer), flush=True)
    print(f"{proved} of {len(chosen)} proofs hold, {found} of {len(chosen)} broken twins found")
    return 0 if proved == found == len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
