"""Reads the line from a VCD of dsdpv1-sim, with an independent reader."""
import re


def changes_of(wave):
    """(ps, level) of the line in a VCD of this program."""
    code, changes, now = None, [], 0
    for line in wave.read_text(encoding="utf-8").splitlines():
        if match := re.match(r"\$var wire 1 (\S+) line ", line):
            code = match.group(1)
        elif line.startswith("#"):
            now = int(line[1:])
        elif code and line[1:] == code and line[0] in "01":
            changes.append((now, int(line[0])))
    return changes
