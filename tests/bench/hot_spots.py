"""Where the core spends its time: samples of perf, each assigned to the file of its line, inlined or not."""
import collections
import re

from programs import FOLDER, ROOT, Failed, samples

PROGRAM = FOLDER / "bench_profile"
LINE = re.compile(r"^\s*([\d.]+)%\s+(\S*)\s*$")
REST = "elsewhere"


def blocks():
    """Maps a file name to its block, which consists of header and source: model/profibus/uart_rx.*"""
    return {path.name: f"model/{path.parent.name}/{path.stem}.*" for path in (ROOT / "model").glob("*/*.[ch]pp") if path.parent.name != "systemc"}


def shares(printed, names):
    """(block, percent), greatest first. The standard library, the bus and everything below one percent is 'elsewhere'."""
    total = collections.Counter()
    for line in printed.splitlines():
        match = LINE.match(line)
        if match:
            total[names.get(match.group(2), REST)] += float(match.group(1))
    for block in [block for block, share in total.items() if share < 1 and block != REST]:
        total[REST] += total.pop(block)
    return sorted(total.items(), key=lambda each: (each[0] == REST, -each[1]))


def profile(folder):
    """The shares, and a note where there are none."""
    try:
        return shares(samples(folder, [PROGRAM, "profile"], "srcfile"), blocks()), ""
    except Failed as failure:
        return [], str(failure)
