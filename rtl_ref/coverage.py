#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
"""Coverage of the reference RTL: Verilator's counts by file, and the reasons for the rest (coverage.txt of a chip)."""
import argparse
import collections
import fnmatch
import pathlib
import re
import sys

import figures

COUNTED_ON = "Counted on RTL with the checksum `{}`."


# kind: line or toggle. name: the signal's bit, or the direction of a branch.
Point = collections.namedtuple("Point", "kind file line name")
# bits: of a signal, None for all of them
Reason = collections.namedtuple("Reason", "kind file pattern bits why")

BITS = re.compile(r"([^\[]+)\[(\d+(?::\d+)?(?:, *\d+(?::\d+)?)*)\]")


def read_points(data, chip):
    """Point -> count, of all blocks of the first chip, and of the other chips' additional blocks; a point in several instances of a module has their sum."""
    counts = collections.Counter()
    for record in pathlib.Path(data).read_text(encoding="utf-8").splitlines():
        if record.startswith("#"):
            continue
        match = re.fullmatch(r"C '(.*)' (\d+)", record)
        if not match:
            sys.exit(f"{data}: not a record of coverage: {record[:60]!r}, expected those of Verilator 5")
        fields = dict(field.split("\2", 1) for field in match[1].split("\1") if field)
        kind = "toggle" if fields["page"].startswith("v_toggle") else "line"
        file = "/".join(pathlib.PurePath(fields["f"]).parts[-2:])
        if chip != figures.CHIPS[0] and not file.startswith(f"{chip}/"):
            continue
        # Several branches may begin in one line: the column tells them apart
        name = fields["o"] if kind == "toggle" else f"{fields['o']}@{fields['n']}"
        counts[Point(kind, file, int(fields["l"]), name)] += int(match[2])
    return counts


def read_bits(text):
    """The bits of `7:4, 2`."""
    bits = set()
    for part in text.split(","):
        ends = [int(end) for end in part.split(":")]
        bits |= set(range(min(ends), max(ends) + 1))
    return frozenset(bits)


def read_reasons(path):
    """Lines `line | file | part of the source line | why` and `toggle | file | pattern of signals, [bits] after it | why`."""
    reasons = []
    for number, text in enumerate(pathlib.Path(path).read_text(encoding="utf-8").splitlines(), 1):
        if not text.strip() or text.startswith("#"):
            continue
        fields = [field.strip() for field in text.split(" | ")]
        if len(fields) != 4 or fields[0] not in ("line", "toggle") or not all(fields):
            sys.exit(f"{path}:{number}: not a reason, expected: line or toggle | file | pattern | why")
        kind, file, pattern, why = fields
        bits = None
        if kind == "toggle" and "[" in pattern:
            match = BITS.fullmatch(pattern)
            if not match:
                sys.exit(f"{path}:{number}: wrong bits in {pattern}, expected: a pattern, then [7:4, 2]")
            pattern, bits = match[1], read_bits(match[2])
        reasons.append(Reason(kind, file, pattern, bits, why))
    return reasons


def signal(name):
    return name.split("[")[0]


def bit(name):
    """Number of the bit; 0 for a scalar signal."""
    return int(name[name.index("[") + 1:-1]) if "[" in name else 0


def ranges(bits):
    """Text of the bits, neighbours together: 7:4, 2."""
    text, bits = [], sorted(bits, reverse=True)
    while bits:
        length = next((i for i in range(1, len(bits)) if bits[i] != bits[0] - i), len(bits))
        text.append(str(bits[0]) if length == 1 else f"{bits[0]}:{bits[length - 1]}")
        bits = bits[length:]
    return ", ".join(text)


def words(reason):
    bits = f"[{ranges(reason.bits)}]" if reason.bits else ""
    return f"{reason.kind} | {reason.file} | {reason.pattern}{bits} | {reason.why}"


def fits(point, reason, sources):
    if reason.kind != point.kind or not fnmatch.fnmatchcase(point.file, reason.file):
        return False
    if point.kind == "line":
        return reason.pattern in sources.text(point)
    return fnmatch.fnmatchcase(signal(point.name), reason.pattern) and (reason.bits is None or bit(point.name) in reason.bits)


class Sources:
    """Texts of source lines, as the list and the reasons name them."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.texts = {}

    def text(self, point):
        if point.file not in self.texts:
            self.texts[point.file] = (self.folder / point.file).read_text(encoding="utf-8").splitlines()
        text = self.texts[point.file][point.line - 1].split("//")[0].strip()
        return f"else of: {text}" if point.name.startswith("else@") else text


def reason_of(point, sources, reasons):
    """The first reason that fits, or None."""
    return next((reason for reason in reasons if fits(point, reason, sources)), None)


def share(points, counts):
    covered = sum(counts[point] > 0 for point in points)
    return f"{covered} of {len(points)}, {100 * covered / len(points):.1f} %" if points else "none"


def table(counts):
    lines = ["| file | lines and branches | toggles |", "|---|---|---|"]
    for file in [*sorted({point.file for point in counts}), ""]:
        columns = [[p for p in counts if p.kind == kind and file in ("", p.file)] for kind in ("line", "toggle")]
        name = f"`{figures.RTL.name}/{file}`" if file else "all"
        lines.append(f"| {name} | {share(columns[0], counts)} | {share(columns[1], counts)} |")
    return "\n".join(lines)


def uncovered_lines(counts, sources, reasons):
    """Text of the list, number of lines without a reason, reasons used."""
    text, missing, used = [], 0, set()
    for point in sorted(p for p in counts if p.kind == "line" and counts[p] == 0):
        reason = reason_of(point, sources, reasons)
        used.add(reason)
        missing += reason is None
        why = reason.why if reason else "NO EXPLANATION"
        text.append(f"{point.file}:{point.line}: {sources.text(point)}\n    {why}")
    return "\n".join(text), missing, used


def uncovered_toggles(counts, sources, reasons):
    """Text of the list by reason and signal, number of bits without a reason, reasons used."""
    bits = collections.defaultdict(lambda: collections.defaultdict(list))
    for point in counts:
        if point.kind == "toggle" and counts[point] == 0:
            bits[reason_of(point, sources, reasons)][point.file, signal(point.name)].append(bit(point.name))
    text = []
    for reason, signals in bits.items():
        text.append((reason.why if reason else "NO EXPLANATION") +
                    "".join(f"\n    {file}: {name}[{ranges(signals[file, name])}]" for file, name in sorted(signals)))
    return "\n".join(text), sum(map(len, bits.get(None, {}).values())), set(bits)


def summary(counts, reasons, chip):
    """The page's text below the table."""
    lines, bits = (sum(counts[p] == 0 for p in counts if p.kind == kind) for kind in ("line", "toggle"))
    rules = collections.Counter(reason.kind for reason in reasons)
    return (f"{lines} lines and branches were not reached, explained by {rules['line']} reasons in `rtl_ref/{chip}/coverage.txt`; {bits} bits did\n"
            f"not change, explained by {rules['toggle']} rules there.")


def report(data, chip, folder, path, update):
    counts = read_points(data, chip)
    sources, reasons = Sources(folder), read_reasons(path or figures.RTL / chip / "coverage.txt")
    lines, missing, used_lines = uncovered_lines(counts, sources, reasons)
    toggles, missing_bits, used_toggles = uncovered_toggles(counts, sources, reasons)
    text = table(counts)
    print(f"{text}\n\nLines and branches that were not reached:\n{lines}\n\nBits that did not change:\n{toggles}\n")
    unused = [reason for reason in reasons if reason not in used_lines | used_toggles]
    for reason in unused:
        print(f"explains nothing: {words(reason)}")
    print(f"{missing} lines and {missing_bits} bits without an explanation, {len(unused)} explanations of nothing")
    if missing or missing_bits or unused:
        return 1
    if update:
        figures.rewrite(f"{text}\n\n{summary(counts, reasons, chip)}\n\n{COUNTED_ON.format(figures.checksum(chip))}", "./run rtl-coverage", chip)
    return 0


def check():
    """Fails when the page's figures are those of other RTL."""
    page = figures.PAGE.read_text(encoding="utf-8")
    for chip in figures.CHIPS:
        if COUNTED_ON.format(figures.checksum(chip)) not in page:
            sys.exit(f"docs/rtl.md: the coverage of {chip} is not of this RTL (checksum {figures.checksum(chip)}); count again with "
                     "./run rtl-coverage")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    show = commands.add_parser("report", help="tables and lists; exit 1 unless just what was not reached is explained")
    show.add_argument("data", help="what verilator_coverage has merged")
    show.add_argument("--chip", choices=figures.CHIPS, default="dsdpv1")
    show.add_argument("--sources", default=figures.RTL, help="folder of the RTL")
    show.add_argument("--reasons", help="why the rest was not reached; default: the chip's list")
    show.add_argument("-u", "--update", action="store_true", help="rewrite docs/rtl.md")
    commands.add_parser("check", help="whether docs/rtl.md is of this RTL")
    arguments = parser.parse_args()
    if arguments.command == "check":
        check()
        return 0
    return report(arguments.data, arguments.chip, arguments.sources, arguments.reasons, arguments.update)


if __name__ == "__main__":
    sys.exit(main())
