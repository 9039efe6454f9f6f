#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""The tables of docs/rtl.md have a row for each proof of rtl_ref/formal, with the faults of its twins, and for each register with illegal codes."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORMAL = ROOT / "rtl_ref" / "formal"
sys.path.insert(0, str(FORMAL))
import proofs  # noqa: E402
import prove  # noqa: E402


def rows(page):
    """[names, cells] of each row of the table of proofs."""
    table = page.split("| proof | says | assumed | made free |")[1].split("\n\n")[0]
    for line in table.splitlines()[2:]:
        cells = [cell.strip() for cell in line.strip("|").split(" | ")]
        yield re.findall(r"`(\w+)`", cells[0]), cells


def faults(cell):
    """Numbers of the faults that a cell names."""
    return {int(number) for list_of in re.findall(r"\b(?:faults? )?(\d+(?:, \d+)*):|\bfaults? (\d+(?:, \d+)*)", cell) for group in list_of for number in re.findall(r"\d+", group)}


def complaints(page, known, files):
    """What of page, proofs and files does not agree."""
    named = [name for names, _ in rows(page) for name in names]
    yield from (f"{name} has {named.count(name)} rows in docs/rtl.md" for name in known if named.count(name) != 1)
    yield from (f"docs/rtl.md has a row of {name}, which is not a proof" for name in named if name not in known)
    used = {properties for proof in known.values() for properties in proof.bind.values()}
    yield from (f"{file}.svh belongs to no proof" for file in files if file not in used)
    yield from (f"{properties}.svh is missing" for properties in used if properties not in files)
    yield from (f"{proof.name} has no twin" for proof in known.values() if not prove.defects(proof))
    for names, cells in rows(page):
        if len(cells) != 5 or not all(cells):
            yield f"the row of {', '.join(names)} has not five cells"
            continue
        of_list = {fault for name in names if name in known for fault in known[name].faults}
        if of_list - faults(cells[4]):
            yield f"the row of {', '.join(names)} does not name the faults {sorted(of_list - faults(cells[4]))}"


def registers(texts):
    """(block, register, first illegal code, last one) of each register of an enumeration that has fewer names than codes."""
    shared = {}
    for name, text in sorted(texts.items(), key=lambda each: not each[0].endswith(".svh")):
        here = dict(shared)
        for width, body, kind in re.findall(r"typedef enum logic \[(\d+):0\] \{(.*?)\} (\w+);", text, re.S):
            here[kind] = len(re.findall(r"^\s*\w+ = \d+'d\d+", body, re.M)), 2 ** (int(width) + 1)
        if name.endswith(".svh"):
            shared = here
            continue
        declared = re.findall(r"^  (\w+_t) ([\w, ]+);", text, re.M) + [(kind, kind.replace("_t", "_q")) for kind in here if kind not in shared]
        for kind, names in declared:
            yield from ((name.split("/")[1][:-3], each, here[kind][0], here[kind][1] - 1) for each in names.split(", ")
                        if kind in here and each.endswith("_q") and here[kind][0] < here[kind][1])


def without_row(page, texts):
    """The registers of which the table of illegal codes has no right row."""
    table = page.split("| register | illegal | left |")[1].split("\n\n")[0].splitlines()[2:]
    for block, register, first, last in registers(texts):
        codes = {str(first)} if first == last else {f"{first}, {last}", f"{first} to {last}"}
        if not any(f"`{block}`" in row and f"`{register}`" in row and any(each in row.split(" | ")[1] for each in codes) for row in table):
            yield f"docs/rtl.md, illegal codes: no row of {block} {register}, {first} to {last}"


def main():
    page = (ROOT / "docs" / "rtl.md").read_text(encoding="utf-8")
    known = {proof.name: proof for proof in proofs.PROOFS}
    files = {path.stem for path in FORMAL.glob("*.svh")}
    texts = {str(path.relative_to(FORMAL.parent)): path.read_text(encoding="utf-8") for pattern in ("*.svh", "*/*.sv") for path in FORMAL.parent.glob(pattern)}
    found = [*complaints(page, known, files), *without_row(page, texts)]
    # Each kind of disagreement is found
    name = "banks_dpv1"
    broken = (
        (page.replace(f"| `{name}` |", "| `banks_dpv2` |"), known, files),
        (page, {**known, "another": known[name]}, files),
        (page, {each: proof for each, proof in known.items() if each != name}, files),
        (page, known, files | {"another"}),
        (page, known, files - {name}),
        (page.replace("fault 47: CSR", "fault 48: CSR"), known, files),
    )
    found += [f"disagreement {number} was not found" for number, each in enumerate(broken) if not set(complaints(*each)) - set(found)]
    another = {**texts, "dsdpv1/another.sv": "  typedef enum logic [1:0] {\n    IDLE = 2'd0,\n    RUN = 2'd1\n  } state_t;\n"}
    found += [] if len(list(without_row(page, another))) > len(list(without_row(page, texts))) else ["a register without a row was not found"]
    print("\n".join(found) or f"{len(known)} proofs, {sum(len(prove.defects(proof)) for proof in known.values())} twins, {len(files)} files: as docs/rtl.md says")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
