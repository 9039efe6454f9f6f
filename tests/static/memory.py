"""Valgrind's memcheck over one run of each kind: reads of uninitialised memory, accesses outside of allocated memory, and leaks.

The view tlm is excluded: valgrind cannot follow the stack switches of SystemC's threads, and takes stack contents for uninitialised. The preset
debug checks that view with AddressSanitizer. The cases depend on their order: later ones read files of earlier ones, all in one folder.
"""
import dataclasses
import pathlib
import re
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIM = ROOT / "build" / "default" / "apps" / "dsdpv1-sim"
VALGRIND = ("valgrind", "--trace-children=yes", "--leak-check=full", "--show-leak-kinds=definite", "--errors-for-leak-kinds=definite", "--log-file=valgrind.%p", "--")
LIMIT_S = 1800


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    words: tuple
    status: tuple = (0,)  # of the program


def run(name, scenario, *words):
    return Case(name, ("run", f"{{scenarios}}/{scenario}.yaml", *words))


SHORT = """name: short
baud: 12M
end: 3ms
slaves:
  - {{name: demo, address: 5, gsd: "{scenarios}/dsdpv1.gsd", modules: ["2 bytes in, 2 bytes out"]}}
masters:
  - {{name: plc, address: 2, slaves: [{{slave: demo, outputs: "01 02"}}]}}
"""
CASES = (
    run("parallel port, native program, skip; wave, log, capture, trace, report", "power_on_12m", "--wave", "w.fst", "--log", "l.jsonl", "--capture",
        "c.pcapng", "--trace", "t", "--report", "r.html", "--result", "r.json"),
    Case("step", ("run", "short.yaml", "--engine", "step", "--wave", "w.vcd")),
    Case("lockstep with the reference RTL", ("run", "short.yaml", "--engine", "lockstep")),
    run("checks that find something", "violations"),
    run("two masters, DPV1 class 2", "dpv1_c2_two_masters"),
    run("SPI port", "rsu_spi"),
    run("UART port", "rsu_uart"),
    run("ARM program", "arm_board_12m"),
    run("ARM program at the SPI port", "arm_spi"),
    run("ARM program at an APC3", "spc3_arm"),
    Case("replay of a capture", ("replay", "c.pcapng", "--as", "5", "--scenario", "{scenarios}/power_on_12m.yaml", "--wave", "again.vcd"), (0, 1)),
    Case("decode", ("decode", "c.pcapng", "--table", "d.tsv")),
    Case("compare of two waves", ("compare", "w.vcd", "again.vcd"), (0, 1)),
    Case("GSD file", ("gsd", "{scenarios}/dsdpv1.gsd")),
    Case("serve", ("serve", "{scenarios}/serve_19k2.yaml", "--tcp", "0", "--for", "200ms")),
    Case("random lockstep in two threads", ("rtl-random", "--cycles", "20000", "--jobs", "2", "--seed", "1")),
)


def errors_in(logs):
    """The number of errors that valgrind counts in each process, and its first message about them."""
    counts = [int(count) for log in logs for count in re.findall(r"ERROR SUMMARY: (\d+) errors", log)]
    words = [line.split("== ", 1)[1] for log in logs for line in log.splitlines() if re.search(r"== (Invalid|Conditional|Use of|Syscall|.*definitely lost in)", line)]
    if not counts:
        return None, "valgrind has not come to its end"
    return max(sum(counts), len(words)), "; ".join(words[:3])


def carry_out(case, folder):
    """Errors (None: another failure), a text about them, seconds."""
    begin = time.monotonic()
    words = [word.format(scenarios=ROOT / "scenarios") for word in case.words]
    result = subprocess.run([*VALGRIND, SIM, *words], cwd=folder, capture_output=True, text=True, check=False, timeout=LIMIT_S)
    logs = [path.read_text(encoding="utf-8", errors="replace") for path in sorted(folder.glob("valgrind.*"))]
    for path in folder.glob("valgrind.*"):
        path.unlink()
    errors, said = errors_in(logs)
    if result.returncode not in case.status:
        errors, said = None, f"exit {result.returncode}: {result.stderr.strip()[-300:]}"
    return errors, said, time.monotonic() - begin


def check(tell):
    """Each case: `tell(name, errors, words, seconds)`."""
    with tempfile.TemporaryDirectory(prefix="dsdpv1_memory_") as folder:
        pathlib.Path(folder, "short.yaml").write_text(SHORT.format(scenarios=ROOT / "scenarios"), encoding="utf-8")
        for case in CASES:
            tell(case.name, *carry_out(case, pathlib.Path(folder)))
