"""Host instructions per item, counted by callgrind, which are the same on a busy machine. The difference of two run lengths excludes the start of
a run. instructions.tsv has the counts of the last record."""
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import typing

import programs
import scenarios

RECORD = pathlib.Path(__file__).with_name("instructions.tsv")
GROWN = 1.05  # times the record: a row with more fails
OFF = ("--checks", "off")


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    unit: str  # the unit of the count
    what: str
    scenario: str
    lengths: tuple  # short and long, in ms of simulated time, or arguments for `command`
    options: tuple = OFF
    units: typing.Callable = lambda short, long: (long["simulated_ns"] - short["simulated_ns"]) / 1e6  # of the results of both runs
    start: bool = False  # not the difference, but the rest of the short run without it
    command: typing.Callable = None  # or a command to run instead of a scenario, in a folder, at a length


def arm(short, long):
    """ARM instructions."""
    return long["slaves"][0]["arm_board"]["instructions"] - short["slaves"][0]["arm_board"]["instructions"]


def looks(short, long):
    """Passes of a loop of three ARM instructions."""
    return arm(short, long) / 3


def sck_edges(short, long):
    """Counted in a wave of the time between both ends."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scenarios.write_all(folder)
        command = [*programs.run_command("spi_9m", *OFF), "--set", f"end={long['simulated_ns']}ns", "--wave", "sck.vcd", "--wave-signals", "*.SCK",
                   "--wave-from", f"{short['simulated_ns']}ns"]
        subprocess.run([*map(str, command)], cwd=folder, env=programs.QUIET, capture_output=True, check=False)  # its verdict does not matter either
        return len(re.findall(r"^[01]\S", (folder / "sck.vcd").read_text(encoding="utf-8"), re.M)) - 1  # the first is the level at the begin


def on_board(name, unit, what, scenario, lengths, units=arm, **others):
    return Row(name, unit, what, scenario, lengths, units=units, **others)


def compare_megabytes(folder, length):
    """dsdpv1-sim compare on a made-up VCD and itself."""
    programs.call([sys.executable, "-B", programs.ROOT / "tests" / "lab" / "compare" / "large_vcd.py", folder / "large.vcd", length])
    return [programs.SIM, "compare", "large.vcd", "large.vcd", "--quiet"]


MS, DEMO, ARM = "simulated ms", "power_on_12m", "arm_board_12m"
# glibc copies large blocks by `rep movsb` or not, as their addresses suit, and callgrind counts each repetition.
COUNTED = {**programs.QUIET, "GLIBC_TUNABLES": "glibc.cpu.x86_rep_movsb_threshold=0x7fffffff"}
ROWS = (
    on_board("arm", "ARM instruction", "The example firmware on the ARM board, checks off.", ARM, (6, 12)),
    on_board("arm_checks", "ARM instruction", "The same with checks.", ARM, (6, 12), options=()),
    on_board("arm_start", "run", "What starts that run.", ARM, (6, 12), start=True),
    on_board("arm_stores", "ARM instruction", "A loop that counts in RAM: one store in six instructions.", "loop_ram", (1, 2)),
    on_board("gpio_poll", "look", "A loop that looks at L_REQ by GPIO.", "loop_gpio", (1, 2), looks),
    on_board("dpram_poll", "look", "A loop that reads a cell of the DPRAM without holding it, after the first 10000, which the result lists.",
             "loop_dpram", (4, 5), looks),
    Row("demo", MS, "The scenario power_on_12m, checks off.", DEMO, (20, 30)),
    Row("demo_checks", MS, "The same with checks.", DEMO, (20, 30), ()),
    Row("demo_wave", MS, "The same with an FST wave, checks off.", DEMO, (20, 30), (*OFF, "--wave", "demo.fst")),
    Row("demo_full", MS, "The same with checks, log and FST wave.", DEMO, (20, 30), ("--wave", "demo.fst", "--log", "demo.log")),
    Row("spi_9m", "edge of SCK", "A user CPU that looks at a DSDPV1-RSU without a pause, over SPI at 9 MHz.", "spi_9m", (16, 26), units=sck_edges),
    Row("compare", "MB", "dsdpv1-sim compare on VCD.", "", (1, 3), command=compare_megabytes, units=lambda short, long: long["length"] - short["length"]),
    Row("busy", MS, "One slave with 16 bytes each way, checks off.", "one_busy", (100, 200)),
    Row("spc3_busy", MS, "The same with an APC3.", "spc3_busy", (100, 200)),
    Row("slaves_125", MS, "One master and 125 slaves in data exchange.", "slaves_125", (100, 110)),
)
NAMES = tuple(row.name for row in ROWS)
TARGETS = ("dsdpv1-sim", "dsdpv1_firmware", "bench_firmware")


def command_of(row, folder, length):
    if row.command:
        return row.command(folder, length)
    return programs.run_command(row.scenario, "--set", f"end={length}ms", "--result", "result.json", *row.options)


def counted(row, length):
    """Instructions of a run of this length, and its result."""
    with tempfile.TemporaryDirectory(prefix="instructions-") as name:
        folder = pathlib.Path(name)
        scenarios.write_all(folder)
        valgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", f"--log-file={folder / 'log'}"]
        done = subprocess.run([*map(str, valgrind + command_of(row, folder, length))], cwd=folder, env=COUNTED, capture_output=True, text=True, check=False)
        collected = re.search(r"Collected : (\d+)", (folder / "log").read_text(encoding="utf-8") if (folder / "log").exists() else "")
        if done.returncode not in (0, 1) or not collected:  # a verdict on so short a run does not matter
            raise programs.Failed(programs.first_line(done.stderr, done.stdout) or f"{row.scenario} ended with {done.returncode}")
        result = folder / "result.json"
        return int(collected[1]), {"length": length, **(json.loads(result.read_text(encoding="utf-8")) if result.exists() else {})}


def value_of(row):
    (short, first), (long, second) = (counted(row, length) for length in row.lengths)
    if row.start:
        return short - (long - short) / (row.lengths[1] - row.lengths[0]) * row.lengths[0]
    return (long - short) / row.units(first, second)


def recorded():
    lines = RECORD.read_text(encoding="utf-8").splitlines() if RECORD.exists() else []
    return {row: float(value) for row, value, *_ in (line.split("\t") for line in lines if line and not line.startswith("#"))}


def measured(rows, jobs):
    """Maps a row to its value, or to the reason why there is none."""
    def one(row):
        try:
            return value_of(row)
        except (programs.Failed, OSError) as failure:
            return str(failure)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return dict(zip((row.name for row in rows), pool.map(one, rows)))


def judged(row, value, before):
    """The cells of a row, and whether it has passed."""
    if isinstance(value, str):
        return [row.name, "failed", row.unit, "", value], False
    if before is None:
        return [row.name, f"{value:.4g}", row.unit, "", "not recorded"], False
    grown = value > before * GROWN
    return [row.name, f"{value:.4g}", row.unit, f"{before:.4g}", "grown" if grown else f"{100 * (value / before - 1):+.1f} %"], not grown


def record(values):
    known = {**recorded(), **values}
    lines = ["# Row and host instructions each, as ./run bench --instructions --record counted them."]
    RECORD.write_text("\n".join(lines + [f"{name}\t{known[name]:.6g}" for name in NAMES if name in known]) + "\n", encoding="utf-8")


def run(rows, keep):
    values, before, right = measured(rows, os.cpu_count() or 1), recorded(), True
    print("row\tinstructions\teach\trecorded\tchange")
    for row in rows:
        cells, met = judged(row, values[row.name], before.get(row.name))
        print("\t".join(cells), flush=True)
        right &= met
    if keep:
        counts = {name: value for name, value in values.items() if not isinstance(value, str)}
        record(counts)
        return 0 if len(counts) == len(values) else 1
    return 0 if right else 1
