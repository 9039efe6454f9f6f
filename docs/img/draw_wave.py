#!/usr/bin/env python3
"""Draws docs/img/power_on_12m.svg and docs/img/handshake.svg from the waves of the demo.

    ./run sim run scenarios/power_on_12m.yaml -q --wave out/power_on_12m.vcd
    docs/img/draw_wave.py out/power_on_12m.vcd docs/img/power_on_12m.svg docs/img/handshake.svg

The first has two windows, found by the telegrams in the waves: from Set_Prm to the answer of the first data exchange, and the
user's judgement of Set_Prm in detail. The second is the hold after Set_Prm for which the user waits longest, as the chip is in the
DPRAM. Python's standard library only. The tests draw them again and compare (tests/docs).
"""
import sys
from xml.sax.saxutils import escape

US, NS = 1_000_000, 1_000  # the waves count picoseconds
LEFT, WIDTH, ROW, HIGH = 78, 1000, 24, 13
PINS = ["PBRXD", "PBRTS", "PBTXD", "INTR0", "R_REQ", "R_STA", "L_REQ", "L_STA"]
LAMPS = ["BR", "PBF", "READY"]
MARGIN = 4 * US


class Vcd:
    """The values of one scope's signals as lists of (time, value), and the telegrams as (begin, end, words)."""

    def __init__(self, lines, scope):
        self.changes = {}
        self.telegrams = []
        self._names = {}
        self._line_fell = None
        now, current = 0, None
        for line in lines:
            line = line.strip()
            if line.startswith("#"):
                now = int(line[1:])
            elif line.startswith("$scope"):
                current = line.split()[2]
            elif line.startswith("$var"):
                self._declare(line.split(), current, scope)
            elif line and line[0] in "01xzs":
                value, name = self._split(line)
                if name in self._names:
                    self._note(now, self._names[name], value)
                if self._is_done(now):
                    return
        raise SystemExit("draw_wave: no data exchange in the waves")

    def _is_done(self, now):
        if not self.telegrams:
            return False
        _, end, words = self.telegrams[-1]
        return short(words) == "inputs" and now > end + MARGIN

    def _declare(self, words, current, scope):
        if current in (scope, "bus"):
            self._names[words[3]] = words[4]

    @staticmethod
    def _split(line):
        return (line[1:].split()[0], line.split()[1]) if line[0] == "s" else (line[0], line[1:])

    def _note(self, now, name, value):
        self.changes.setdefault(name, []).append((now, value))
        if name == "line" and value == "0" and self._line_fell is None:
            self._line_fell = now
        if name == "telegram" and value != "-":
            self.telegrams.append((self._line_fell, now, value.replace("_", " ")))
            self._line_fell = None

    def level(self, name, time):
        """The last value at or before a time."""
        value = None
        for at, new in self.changes[name]:
            if at > time:
                break
            value = new
        return value

    def find(self, name):
        return next(each for each in self.telegrams if short(each[2]) == name)


def short(words):
    """The text that fits above a telegram."""
    for text, name in (("token", "token"), ("SC", "SC"), ("Set Prm", "Set_Prm"), ("Chk Cfg", "Chk_Cfg")):
        if text in words:
            return name
    answer = words.startswith("5 -> 2")
    if "Slave Diag" in words:
        return "diagnosis" if answer else "Slave_Diag"
    if "Data Exchange" in words:
        return "inputs" if answer else "outputs"
    return ""


class Panel:
    """One window of time: title, strips of boxes (telegrams and states, unless others are given), pins and a time axis, drawn from y downwards."""

    def __init__(self, vcd, begin, end, title, tick, pins, strips=None, zero=0, unit=(US, "µs")):
        self.vcd, self.begin, self.end, self.title, self.tick, self.pins, self.zero, self.unit = vcd, begin, end, title, tick, pins, zero, unit
        self.strips = strips or [("bus", self.telegrams()), ("DP state", self.states())]
        self.out = []

    def x(self, time):
        return LEFT + WIDTH * (min(max(time, self.begin), self.end) - self.begin) / (self.end - self.begin)

    def text(self, x, y, words, kind="", anchor="start"):
        kind = f' class="{kind}"' if kind else ""
        self.out.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{kind}>{escape(words)}</text>')

    def draw(self, y):
        self.text(8, y + 14, self.title, "title")
        top = y + 26
        rows = len(self.strips) + len(self.pins)
        self.grid(top, top + ROW * rows)
        for row, (name, boxes) in enumerate(self.strips):
            self.strip(name, top + ROW * row, boxes)
        for row, pin in enumerate(self.pins, len(self.strips)):
            self.pin(pin, top + ROW * row)
        return top + ROW * rows + 30

    def grid(self, top, bottom):
        time = self.zero - (self.zero - self.begin) // self.tick * self.tick
        while time <= self.end:
            self.out.append(f'<path class="grid" d="M{self.x(time):.1f} {top}V{bottom + 4}"/>')
            self.text(self.x(time), bottom + 17, f"{(time - self.zero) / self.unit[0]:g}", "axis", "middle")
            time += self.tick
        self.text(LEFT - 16, bottom + 17, f"time / {self.unit[1]}", "axis", "end")

    def telegrams(self):
        for begin, end, words in self.vcd.telegrams:
            if end > self.begin and begin < self.end:
                yield begin, end, short(words), "answer" if words.startswith(("5", "SC")) else "request"

    def states(self):
        changes = self.vcd.changes["dp_state"] + [(self.end, None)]
        for (begin, state), (end, _) in zip(changes, changes[1:]):
            if end > self.begin and begin < self.end:
                yield begin, end, state, "state"

    def strip(self, name, top, boxes):
        self.text(LEFT - 8, top + 17, name, "pin", "end")
        for begin, end, words, kind in boxes:
            left, right = self.x(begin), self.x(end)
            size = f'width="{right - left:.1f}" height="17"'
            self.out.append(f'<rect class="{kind}" x="{left:.1f}" y="{top + 4}" {size}/>')
            if right - left > 5.5 * len(words):
                self.text((left + right) / 2, top + 16.5, words, "box", "middle")
            elif left > LEFT and right < LEFT + WIDTH:  # too narrow for its words
                self.text((left + right) / 2, top + 1, words, "box", "middle")

    def pin(self, name, top):
        self.text(LEFT - 8, top + 17, name, "pin", "end")
        height = {"1": top + ROW - 4 - HIGH, "0": top + ROW - 4}
        path = [f"M{LEFT} {height[self.vcd.level(name, self.begin)]}"]
        for time, value in self.vcd.changes[name]:
            if self.begin < time <= self.end:
                path.append(f"H{self.x(time):.2f}V{height[value]}")
        self.out.append(f'<path class="wave {name}" d="{"".join(path)}H{LEFT + WIDTH}"/>')


STYLE = """
text { font: 11px "DejaVu Sans", Arial, sans-serif; fill: #24292f }
.title { font-weight: bold; font-size: 12.5px }
.pin { font-family: "DejaVu Sans Mono", monospace } .axis { fill: #57606a; font-size: 10px }
.box { font-size: 9px } .grid { stroke: #d0d7de; stroke-width: 1 }
.wave { fill: none; stroke: #57606a; stroke-width: 1.1 }
.PBRXD, .PBTXD, .PBRTS { stroke: #0550ae } .R_REQ, .R_STA { stroke: #8250df }
.L_REQ, .L_STA { stroke: #1a7f37 } .INTR0 { stroke: #cf222e }
rect { stroke: #57606a; stroke-width: .6 } .request { fill: #ddf4ff } .answer { fill: #dafbe1 } .state { fill: #fff8c5 }
"""


def power_on(vcd):
    set_prm, exchange = vcd.find("Set_Prm"), vcd.find("inputs")
    judged = next(at for at, state in vcd.changes["dp_state"] if state == "WAIT_CFG")
    return [
        Panel(vcd, set_prm[0] - MARGIN, exchange[1] + MARGIN,
              "From Set_Prm to the answer of the first data exchange", 10 * US, PINS + LAMPS),
        Panel(vcd, set_prm[1] - US, judged + 2 * US,
              "In detail: Set_Prm ends, the chip acknowledges, interrupts the user, who fetches the parameters and sends "
              "the verdict", US, PINS)]


def spans(vcd, pin, level):
    """From when to when it has the level."""
    changes = vcd.changes[pin]
    return [(at, end) for (at, value), (end, _) in zip(changes, changes[1:]) if value == level]


def handshake(vcd):
    def granted(asked):
        return next(at for at, _ in spans(vcd, "R_STA", "1") if at > asked)

    holds = [hold for hold in spans(vcd, "R_REQ", "1") if hold[0] > vcd.find("Set_Prm")[1]]
    asked, released = max(holds, key=lambda hold: granted(hold[0]) - hold[0])
    begin, end, held = asked - 350 * NS, released + 300 * NS, granted(asked)
    window = asked + 3 * 125_000 // 6  # 3 cycles of 48 MHz (H2)
    has = [(*hold, "the user", "request") for hold in spans(vcd, "R_STA", "1")] + [(*access, "the chip", "answer") for access in spans(vcd, "L_REQ", "1")]
    does = [(asked, window, "3 cycles", "state"), (window, held, "looks at L_REQ, L_STA", "state")]
    does += [(*access, " ".join(vcd.level("user", access[0]).split("_")[:2]), "request")
             for access in spans(vcd, "CSR", "0")]
    strips = [(name, [box for box in boxes if box[1] > begin and box[0] < end]) for name, boxes in (("DPRAM", has), ("user", does))]
    pins = ["R_REQ", "R_STA", "L_REQ", "L_STA", "CSR", "RD", "WR"]
    return [Panel(vcd, begin, end, "The user asks while the chip is in the DPRAM, waits, accesses three cells, and lets the chip in", 100 * NS, pins, strips, asked, (NS, "ns"))]


def write(picture, panels, title):
    y, parts = 8, []
    for panel in panels:
        y = panel.draw(y)
        parts += panel.out
    size = f'width="{LEFT + WIDTH + 16}" height="{y}"'
    with open(picture, "w", encoding="utf-8") as svg:
        svg.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + 16} {y}" {size}>\n'
                  f"<title>{title}; drawn by docs/img/draw_wave.py</title>\n"
                  f'<style>{STYLE}</style>\n<rect {size} style="fill:#fff;stroke:none"/>\n'
                  + "\n".join(parts) + "\n</svg>\n")


def main(waves, whole, hold):
    with open(waves, encoding="utf-8") as lines:
        vcd = Vcd(lines, "demo")
    write(whole, power_on(vcd), "Pins of the chip in scenarios/power_on_12m.yaml")
    write(hold, handshake(vcd), "A hold of the DPRAM in scenarios/power_on_12m.yaml")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        raise SystemExit("usage: draw_wave.py WAVES.vcd POWER_ON.svg HANDSHAKE.svg")
    main(*sys.argv[1:])
