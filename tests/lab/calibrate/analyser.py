"""A logic analyser at the pins of a run: its wave, sampled with a separate clock and jitter, in the file formats of analysers."""
import bisect
import io
import math
import random
import re
import zipfile

SINGLE = ["RESET", "R_REQ", "R_STA", "CSR", "RD", "WR", "PBRXD", "L_REQ", "L_STA", "INTR0", "PBTXD", "PBRTS", "PBF", "BR", "READY"]
BUSES = [f"A{i}" for i in range(11)] + [f"D{i}" for i in range(8)]
ALL = SINGLE + BUSES


def read_wave(path, scope):
    """For each pin its first level and the times in ps at which it changes. For A and D each wire; X and Z keep the level."""
    codes, levels, edges, scopes = {}, {}, {}, []
    end = now = 0
    with open(path, encoding="utf-8") as wave:
        for line in wave:
            if line.startswith("$scope"):
                scopes.append(line.split()[2])
            elif line.startswith("$upscope"):
                scopes.pop()
            elif line.startswith("$var") and scopes[-1:] == [scope]:
                _, _, width, code, name = line.split()[:5]
                wires = [name] if width == "1" else [f"{name}{bit}" for bit in reversed(range(int(width)))]
                if set(wires) <= set(ALL):
                    codes[code] = wires
            elif line[0] == "#":
                end = now = int(line[1:])
            elif line[0] in "01xzb":
                value, _, code = line[1:].partition(" ") if line[0] == "b" else (line[0], "", line[1:].strip())
                wires = codes.get(code.strip(), [])
                bits = value.rjust(len(wires), value[0] if value[0] in "xz" else "0")
                for wire, bit in zip(wires, bits):
                    if bit not in "01":
                        continue
                    if wire not in levels:
                        levels[wire] = [int(bit)]
                        edges[wire] = []
                    elif levels[wire][-1] != int(bit):
                        levels[wire].append(int(bit))
                        edges[wire].append(now)
    return {wire: (levels[wire][0], edges[wire]) for wire in levels}, end


def sample(pins, end, rate, ppm=0.0, jitter_ns=0.0, skew_ns=0.0, seed=1):
    """Numbers of the samples at which each pin has its new level for the first time. `ppm`: the analyser's clock is fast by this much."""
    chance = random.Random(seed)
    per_ps = rate * 1e-12 * (1 + ppm * 1e-6)
    phase = chance.random()
    sampled = {}
    for wire in sorted(pins):
        first, edges = pins[wire]
        skew = chance.uniform(-skew_ns, skew_ns) / 2 * 1e3
        numbers = []
        for at in edges:
            moved = at + skew + chance.uniform(-jitter_ns, jitter_ns) * 1e3
            number = max(1, math.ceil(moved * per_ps + phase))
            if numbers and number <= numbers[-1]:
                numbers.pop()  # shorter than a sample
            else:
                numbers.append(number)
        sampled[wire] = (first, numbers)
    return sampled, math.ceil(end * per_ps) + 2


def level_at(trace, number):
    first, numbers = trace
    return first ^ (bisect.bisect_right(numbers, number) & 1)


def changes(sampled):
    """Sample numbers with changes, and the pins that change."""
    by_number = {}
    for wire, (_, numbers) in sampled.items():
        for number in numbers:
            by_number.setdefault(number, []).append(wire)
    return sorted(by_number.items())


def write_sigrok(path, sampled, count, rate):
    wires = sorted(sampled)
    unit = (len(wires) + 7) // 8
    value = sum(sampled[wire][0] << i for i, wire in enumerate(wires))
    data, at = io.BytesIO(), 0
    for number, changed in changes(sampled) + [(count, [])]:
        data.write(value.to_bytes(unit, "little") * (number - at))
        at = number
        for wire in changed:
            value ^= 1 << wires.index(wire)
    names = "".join(f"probe{i + 1}={wire}\n" for i, wire in enumerate(wires))
    metadata = f"[global]\nsigrok version=0.5.2\n\n[device 1]\ncapturefile=logic-1\ntotal probes={len(wires)}\nsamplerate={rate / 1e6:g} MHz\n{names}unitsize={unit}\n"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("version", "2")
        archive.writestr("metadata", metadata)
        archive.writestr("logic-1-1", data.getvalue())


def write_csv(path, sampled, _count, rate):
    """As Saleae Logic exports: a line for each change, times in seconds."""
    wires = sorted(sampled)
    levels = [sampled[wire][0] for wire in wires]
    with open(path, "w", encoding="utf-8") as table:
        table.write("Time [s]," + ",".join(wires) + "\n")
        table.write("0.000000000," + ",".join(map(str, levels)) + "\n")
        for number, changed in changes(sampled):
            for wire in changed:
                levels[wires.index(wire)] ^= 1
            table.write(f"{number / rate:.9f}," + ",".join(map(str, levels)) + "\n")


def write_vcd(path, sampled, count, rate):
    """As sigrok-cli -O vcd: whole nanoseconds."""
    wires = sorted(sampled)
    with open(path, "w", encoding="utf-8") as wave:
        wave.write("$timescale 1 ns $end\n$scope module logic $end\n")
        for i, wire in enumerate(wires):
            wave.write(f"$var wire 1 {chr(33 + i)} {wire} $end\n")
        wave.write("$upscope $end\n$enddefinitions $end\n#0\n" + "".join(f"{sampled[wire][0]}{chr(33 + i)}\n" for i, wire in enumerate(wires)))
        levels = {wire: sampled[wire][0] for wire in wires}
        for number, changed in changes(sampled):
            wave.write(f"#{int(number * 1e9 / rate)}\n")
            for wire in changed:
                levels[wire] ^= 1
                wave.write(f"{levels[wire]}{chr(33 + wires.index(wire))}\n")
        wave.write(f"#{int(count * 1e9 / rate)}\n")


WRITERS = {".sr": write_sigrok, ".csv": write_csv, ".vcd": write_vcd}


def only(pins, names):
    return {name: pins[name] for name in names}


def shifted(pins, wire, after, by):
    """Delays the first edge of the pin after `after` by `by`, both in ps."""
    first, edges = pins[wire]
    edges = list(edges)
    at = bisect.bisect_left(edges, after)
    moved = edges[at]
    edges[at] += by
    assert at + 1 == len(edges) or edges[at] < edges[at + 1], "no edge may pass another"
    return {**pins, wire: (first, edges)}, moved


def without(pins, wire, begin, end):
    """The pin does nothing from `begin` to `end`, where it has the same level."""
    first, edges = pins[wire]
    kept = [at for at in edges if not begin <= at <= end]
    assert len(edges) - len(kept) and (len(edges) - len(kept)) % 2 == 0
    return {**pins, wire: (first, kept)}
