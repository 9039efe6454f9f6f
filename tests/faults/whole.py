"""Checks that an output is whole: the same as that of an undisturbed run, or, for a run ended early, valid up to its end."""
import json
import os
import re
import struct
import subprocess

BEFORE = b"what was there before\n"


def read(path):
    with open(path, "rb") as file:
        return file.read()


def last_line(content):
    lines = content.decode().splitlines()
    return lines[-1] if lines else ""


def packets(content):
    """The number of whole blocks in a pcapng file, and of the bytes after them."""
    at, count = 0, 0
    while at + 12 <= len(content):
        length = struct.unpack_from("<I", content, at + 4)[0]
        if length < 12 or content[at + length - 4:at + length] != content[at + 4:at + 8]:
            break
        at, count = at + length, count + 1
    return count, len(content) - at


def ended_early(program, path, content):
    """The output of an interrupted run by its ending."""
    ending = os.path.splitext(path)[1]
    if ending == ".fst":
        told = subprocess.run([program, "recover", path, "-o", path + ".x.fst"], stderr=subprocess.PIPE, check=False).stderr
        return b"is complete, so there is nothing to recover" in told
    if ending == ".json":
        result = json.loads(content)
        return result["interrupted"] is ("pacing" not in result)  # serve does not end on its own
    if ending == ".pcapng":
        return packets(content)[0] >= 2 and packets(content)[1] == 0
    if not content.endswith(b"\n"):
        return False
    if ending == ".html":
        return (b'"interrupted": true' in content) is (b'"pacing": ' not in content) and content.endswith(b"</html>\n")
    if ending == ".vcd":
        return re.fullmatch(r"#\d+", last_line(content)) is not None
    if ending == ".jsonl":
        return all("at_ns" in json.loads(line) for line in content.splitlines())
    if ending == ".log":
        return re.match(r" *\d+\.\d{3} ns  \S+ +\w+ ", last_line(content)) is not None
    return re.fullmatch(r"\d+(\+\d+)? demo \w+ [0-9A-Fxz]+", last_line(content)) is not None  # the trace


def readable(path, content):
    """A temporary file left by a killed run: whole lines of simulated time, except perhaps the last; FST's is for `recover`."""
    ending = os.path.splitext(re.sub(r"\.\d+\.part$", "", path))[1]
    if ending == ".fst":
        return True
    if ending == ".pcapng":
        return packets(content)[0] >= 2
    lines = content.decode().split("\n")[:-1]
    if ending == ".jsonl":
        return bool(lines) and all("at_ns" in json.loads(line) for line in lines)
    return bool(lines) and (ending != ".log" or all(" ns  " in line for line in lines))


def without_wall_time(content):
    """Removes the differences between runs: duration and pace, the port, and in a save file the path of the wave."""
    if content.startswith(b"{"):
        result = json.loads(content)
        for key in ("wall_s", "real_time_factor", "pacing"):
            result.pop(key, None)
        return result
    if content.startswith(b"number\t"):  # kills of faults: the seconds
        return [line.split(b"\t")[:5] + line.split(b"\t")[6:] for line in content.splitlines()]
    if content.startswith(b"[*] dsdpv1-sim"):
        return re.sub(rb"\[dumpfile\] .*", b"", content)
    if content.startswith(b"<!DOCTYPE html>"):
        return re.sub(rb'"(wall_s|real_time_factor)": [^,}]*|"pacing": {[^}]*}|\n  (simulated|host|pacing|served) .*', b"", content)
    return re.sub(rb".* host .* this computer is too slow.*\n", b"", content)


def same(content, reference):
    return content == reference or without_wall_time(content) == without_wall_time(reference)
