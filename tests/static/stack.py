"""How deep the C drivers' stack is on a Cortex-M3, for each public function and port: from GCC's own figures for each function, and its graph of calls.

The target of a call by pointer is found in the source: `link` and `wire` point to functions of the port's file, all other pointers to functions of
the application.
The application's depth is unknown; its functions that a public function can call are listed. The C library's memcpy, memset and memmove are not
counted: those of newlib need at most 16 bytes more.
"""
import dataclasses
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DRIVER = ROOT / "driver"
COMPILER = ("arm-none-eabi-gcc", "-mcpu=cortex-m3", "-mthumb", "-std=c99", "-ffreestanding", "-I.", "-isystem", "examples/firmware/freestanding",
            "-fcallgraph-info=su", "-c")
LEVELS = ("-Os", "-O2")
PORTS = ("parallel", "spi", "uart")
PARALLEL = PORTS[:1]
LIBRARY = ("memcpy", "memset", "memmove", "strlen")
OF_PORT = ("link", "wire")  # what points to functions of the port's file
JUDGES = {"prm", "cfg", "handler", "address", "control"}  # functions of the application that are not its port's
INDIRECT = "__indirect_call"


class Unknown(Exception):
    """A cause of a wrong figure."""


@dataclasses.dataclass(frozen=True)
class Depth:
    bytes: int
    callbacks: frozenset


class Graph:
    """Functions of one build: their stack bytes, and the functions that they call."""

    def __init__(self):
        self.own, self.calls = {}, {}

    def read(self, text):
        for title, label in re.findall(r'^node: { title: "([^"]+)" label: "([^"]*)"', text, re.M):
            if found := re.search(r"(\d+) bytes \((\w+)", label):
                if found[2] != "static":
                    raise Unknown(f"{title} needs {found[2]} space on the stack")
                self.own[title] = int(found[1])
        for caller, called, place in re.findall(r'^edge: { sourcename: "([^"]+)" targetname: "([^"]+)"(?: label: "([^"]*)")? }', text, re.M):
            self.calls.setdefault(caller, set()).add((called, place))

    def named(self, file, function):
        """The function of that file, also in a modified copy by the compiler (constprop, isra, part)."""
        exact = [f"{file}:{function}", function]
        found = [each for each in exact if each in self.own]
        return found or [each for each in self.own if re.match(rf"{re.escape(file)}:{function}\.", each)]


def pointer_called(place, root=ROOT):
    """The call in the source: the pointer before the last arrow or dot, and the name."""
    if not place:
        raise Unknown("a call of a pointer, and GCC does not say where")
    file, line, column = place.rsplit(":", 2)
    text = (root / file).read_text(encoding="utf-8").split("\n")[int(line) - 1]
    called = re.match(r"(?:\w+(?:->|\.))*?(?:(\w+)(?:->|\.))?(\w+)\(", text[int(column) - 1:])
    if not called:
        raise Unknown(f"{place}: no call of a pointer stands there")
    return called[1] or "", called[2]


class Depths:
    """The worst path of each function, with one port."""

    def __init__(self, graph, port):
        self.graph, self.file, self.known, self.path = graph, f"driver/dsdpv1_{port}.c", {}, []

    def of(self, function):
        if function not in self.known:
            if function in self.path:
                raise Unknown("functions call themselves: " + ", ".join(self.path))
            self.path.append(function)
            self.known[function] = self.worst(function)
            self.path.pop()
        return self.known[function]

    def worst(self, function):
        if function not in self.graph.own:
            if function not in LIBRARY:
                raise Unknown(f"{function} is nowhere")
            return Depth(0, frozenset())
        below, callbacks = 0, set()
        for called, place in self.graph.calls.get(function, ()):
            for depth in self.called(called, place):
                below = max(below, depth.bytes)
                callbacks |= depth.callbacks
        return Depth(self.graph.own[function] + below, frozenset(callbacks))

    def called(self, called, place):
        if called != INDIRECT:
            return [self.of(called)]
        pointer, name = pointer_called(place)
        if pointer not in OF_PORT:
            return [Depth(0, frozenset({name}))]
        return [self.of(each) for each in self.of_port(name)]

    def of_port(self, name):
        """The port's functions for a member; none when the port has no such function, and the pointer is null."""
        text = (ROOT / self.file).read_text(encoding="utf-8")
        given = re.search(rf"\.{name} = (\w+)", text)
        function = given[1] if given else name
        found = self.graph.named(self.file, function)
        if not found and re.search(rf"\b{function}\([^;]*\) \{{", text):
            raise Unknown(f"{self.file}: {function} is nowhere in the graph")
        return found


def public_functions():
    """The functions that the headers declare for applications, each with its ports."""
    found = {}
    for header in ("dsdpv1.h", "dsdpv1_acyclic.h", "dsdpv1_spi.h", "dsdpv1_uart.h", "spc3/spc3.h"):
        text = re.sub(r"/\*.*?\*/", "", (DRIVER / header).read_text(encoding="utf-8"), flags=re.S)
        ports = PARALLEL if header == "spc3/spc3.h" else tuple(port for port in PORTS if header.endswith(f"_{port}.h")) or PORTS
        found |= {name: ports for name in re.findall(r"^[\w* ]+?\b((?:dsdpv1|spc3)_\w+)\([^()]*\);", text, re.M)}
    return found


def build(level):
    graph = Graph()
    with tempfile.TemporaryDirectory() as folder:
        for source in [*sorted(DRIVER.glob("*.c")), *sorted((DRIVER / "spc3").glob("*.c"))]:
            target = pathlib.Path(folder, source.stem + ".o")
            subprocess.run([*COMPILER, level, source.relative_to(ROOT), "-o", target], cwd=ROOT, check=True)
            graph.read(target.with_suffix(".ci").read_text(encoding="utf-8"))
    return graph


def measure():
    """Rows: function, then for each port bytes at each level, then the application's functions that it calls."""
    depths = {(level, port): Depths(graph, port) for level in LEVELS for graph in [build(level)] for port in PORTS}
    rows = []
    for function, ports in public_functions().items():
        row, callbacks = [function], set()
        for port in PORTS:
            found = [depths[level, port].of(function) for level in LEVELS] if port in ports else []
            row.append(" / ".join(str(each.bytes) for each in found) or "-")
            callbacks |= {name for each in found for name in each.callbacks}
        rows.append([*row, ", ".join([*(["port"] if callbacks - JUDGES else []), *sorted(callbacks & JUDGES)]) or "-"])
    return rows


def compiler():
    return subprocess.run([COMPILER[0], "-dumpfullversion"], capture_output=True, text=True, check=True).stdout.strip()
