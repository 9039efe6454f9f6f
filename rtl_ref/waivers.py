#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Waivers of Verilator's warnings in the reference RTL: each has a reason in its line and ends at a lint_on, and without it there is a warning
between the two. Also constants of the headers that no file uses, as a waiver hides these. Silent when all is well."""
import pathlib
import re
import subprocess
import sys
import tempfile

RTL = pathlib.Path(__file__).resolve().parent
WAIVER = re.compile(r"/\* verilator lint_off (\w+) \*/(?P<reason>  // .+)?")
NARROW = ("UNUSEDSIGNAL", "UNUSEDPARAM")
BUILDS = ((), ("-DSINGLE_FAULTS",), ("-DDSDPV1_RUN_TIME_LIMITS",))


def sources():
    """Texts of headers and blocks by their path from rtl_ref/."""
    files = [*RTL.glob("*.svh"), *(path for path in RTL.glob("*/*.sv") if path.parent.name != "tb")]
    return {str(path.relative_to(RTL)): path.read_text(encoding="utf-8") for path in sorted(files)}


def waivers(name, text, faults):
    """(rule, first line, last line) of each."""
    found = []
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        waiver = WAIVER.search(line)
        if not waiver:
            continue
        rule = waiver[1]
        ends = [end for end, later in enumerate(lines[number:], number + 1) if f"lint_on {rule} */" in later]
        if rule not in NARROW:
            faults.append(f"{name}:{number}: lint_off {rule} is too wide, expected {' or '.join(NARROW)}")
        if not waiver["reason"]:
            faults.append(f"{name}:{number}: a waiver without a reason in its line")
        if not ends:
            faults.append(f"{name}:{number}: a waiver without an end")
        else:
            found.append((rule, number, ends[0]))
    return found


def warnings(texts):
    """(file, rule, line) of what Verilator says of the sources without their waivers, in any build of any top."""
    said = set()
    with tempfile.TemporaryDirectory() as folder:
        for name, text in texts.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(exist_ok=True)
            path.write_text(WAIVER.sub("", text), encoding="utf-8")
        for files in RTL.glob("*/files.txt"):
            for build in BUILDS:
                output = subprocess.run(["verilator", "--lint-only", "-Wall", "-Wno-fatal", *build, "-I.", f"-I{RTL.parent / 'registers'}", "--top-module",
                                         files.parent.name, *files.read_text(encoding="utf-8").split()],
                                        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False).stdout
                said.update((name, rule, int(line)) for rule, name, line in re.findall(r"^%Warning-(\w+): ([^:\n]+):(\d+):", output, re.M))
    return said


def unused_constants(texts):
    words = re.findall(r"\w+", re.sub(r"//.*", "", " ".join(line for text in texts.values() for line in text.splitlines(True))))
    counts = {}
    for word in words:
        counts[word] = counts.get(word, 0) + 1
    for name, text in texts.items():
        for number, line in enumerate(text.splitlines(), 1):
            constant = re.match(r"localparam [^=]*?(\w+) = |  ([A-Z]\w+) = \d+'", line)
            if name.endswith(".svh") and constant and counts[constant[1] or constant[2]] < 2:
                yield f"{name}:{number}: nothing uses {constant[1] or constant[2]}"


def main():
    texts, faults = sources(), []
    said = warnings(texts)
    for name, text in texts.items():
        for rule, first, last in waivers(name, text, faults):
            if not any(file == name and what == rule and first <= line <= last for file, what, line in said):
                faults.append(f"{name}:{first}: no warning needs this waiver")
    faults.extend(unused_constants(texts))
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    main()
