"""The rows of the speed table: the task of each, its goal, and the measurement of one round."""
import dataclasses
import typing

import programs
import scenarios

OFF = ("--checks", "off")
TIMES = "x real time"


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    goal: typing.Optional[float]  # None: only for comparison
    unit: str
    what: str
    measure: typing.Callable
    targets: tuple
    at_most: bool = False
    limit: str = ""  # its bound, shown if the goal is not met
    bound: str = ""  # the part of its profile (parts.py) that would remain if all else cost nothing: the limit that is measured
    limit_of: typing.Optional[typing.Callable] = None  # or the limit, computed from other rows: values and profiles by row to a number
    limit_by: str = ""  # which they are


def in_program(program, name):
    return lambda turn: turn.program(program, name)


def real_time(scenario, *options):
    def measure(turn):
        run = turn.simulate(scenario, *options)
        return run["simulated_s"] / run["taken_s"]

    return measure


def time_ratio(scenario, one, other):
    """The time of a run with the options `one` relative to one with the options `other`."""
    return lambda turn: turn.simulate(scenario, *one)["taken_s"] / turn.simulate(scenario, *other)["taken_s"]


def fst_library(turn):
    """The library's time for the wave of the row fst, as a fraction of demo."""
    turn.simulate(DEMO, *WAVE)
    wave = turn.folder / WAVE[-1]
    return turn.once("fst_library", lambda: programs.row_of("bench_fst", "fst_library", wave)) / turn.simulate(DEMO, *OFF)["taken_s"]


def idle_station(turn):
    alone, together = (turn.simulate(name, *OFF)["taken_s"] for name in ("one_busy", "with_idle"))
    return 100 * (together - alone) / scenarios.IDLE / alone


def core(io):
    return Row(f"core_{io}", 10, TIMES, f"The core alone: data exchange with {io} bytes each way, back to back at 12 Mbit/s; L_REQ and PBTXD are "
               "watched and their changes counted. Requests arrive as runs of characters (`Chip::hear`).", in_program("bench_core", f"core_{io}"),
               ("bench_core",), limit=CORE_LIMIT)


def of_sim(name, goal, what, measure, **others):
    return Row(name, goal, others.pop("unit", TIMES), what, measure, ("dsdpv1-sim", *others.pop("targets", ())), **others)


def on_board(name, goal, what, scenario, **others):
    return of_sim(name, goal, f"{what} Checks off.", real_time(scenario, *OFF, "--set", "end=50ms"), targets=("bench_firmware",), **others)


def without(part, row):
    """The row if this part of its run cost nothing."""
    return lambda values, profiles: values[row] / (1 - profiles[row][part] / 100)


def kernel_beside_demo(values, profiles):
    """tlm_vs_demo if the TLM view had the work of demo, and its share of the SystemC kernel."""
    return 1 / (1 + profiles["demo_tlm"]["SystemC"] / 100 / values["tlm_vs_demo"])


def chip_beside_verilator(values, _):
    """dpi if the layers between the simulator and the C API cost nothing."""
    return 1 / (1 / values["dpi_alone"] + 1 / values["c_api_changes"])


CORE_LIMIT = ("Every change of a watched pin is an edge that the core evaluates: two a microsecond on L_REQ and five or six a character on PBTXD leave "
              "some 28 ns for each at ten times real time. Unless PBTXD is watched, answers are runs; unless L_REQ is watched, the chip dozes.")
DEMO = "power_on_12m"
FULL = ("--log", "full.log", "--wave", "full.fst")
TLM = (*OFF, "--view", "tlm")
WAVE = (*OFF, "--wave", "demo.fst")
DPI = (programs.FOLDER / "dpi" / "Vbinding_speed",)
# Row to the command that is profiled.
PROFILED = {**{name: programs.run_command(*run) for name, run in {
    "demo": (DEMO, *OFF), "demo_full": (DEMO, *FULL), "demo_tlm": (DEMO, *TLM), "1m5": ("1m5", *OFF), "slaves_32": ("slaves_32", *OFF),
    "slaves_125": ("slaves_125", *OFF), "arm": ("arm_board_12m", *OFF)}.items()},
    **{name: [programs.FOLDER / "bench_systemc", name] for name in ("systemc_tlm_handshake", "systemc_pins")},
    "dpi": [*DPI, f"+exchanges={programs.EXCHANGES}"]}
RTL, SYSTEMC, CAPI = ("bench_rtl",), ("bench_systemc",), ("bench_capi",)
TLM_LIMIT = ("The view `pins` of the bench needs no SystemC. In the TLM view accesses of the user CPU run ahead of the kernel, except one in fourteen, during "
             "which the chip or an agent acts. But each event of the chip costs an event and a process of the kernel, each turn "
             "of an agent costs a switch to its thread, and each access queries three times whether the kernel is idle.")
SLAVES_LIMIT = ("Each telegram reaches every station, and all user CPUs exchange their data in the same microseconds, so that their accesses, unlike "
                "those of one slave, take turns edge by edge.")

ROWS = (
    core(2), core(16), core(64), core(244),
    Row("core_spc3_16", 10, TIMES, "The core of the SPC3 family alone, on the stimulus of core_16; X/INT and TXD are watched, and the changes of TXD counted.",
        in_program("bench_core", "core_spc3_16"), ("bench_core",)),
    Row("spc3_vs_dsdpv1", 0.5, "times as fast", "core_spc3_16 against core_16 of the same round.",
        lambda turn: turn.program("bench_core", "core_spc3_16") / turn.program("bench_core", "core_16"), ("bench_core",)),
    Row("core_vs_rtl", 200, "times as fast", "The core against the Verilated RTL on the stimulus of core_16, neither inside a bench: in "
        "turns, in one process, in CPU time. The RTL is built with -O3, --x-assign fast, --x-initial fast and without limits of run time.",
        in_program("bench_rtl", "core_vs_rtl"), RTL, limit="The core's limit, see core_16."),
    Row("c_api", 90, "%", "The chip through the C API as a share of the core itself, on the stimulus of core_16: a request is one call (`dpsim_chip_receive`, "
        "`Chip::hear`); L_REQ and PBTXD are watched by a callback and counted. In turns, in one process, in CPU time.", in_program("bench_capi", "c_api"), CAPI,
        limit="Each change of a watched pin is two more calls: from the core's pin to the number that all kinds of chip share, and out of the library."),
    Row("c_api_edges", None, "%", "The same with a call for each edge of a request (`dpsim_chip_set`, `Chip::set`), as in a simulator that has the chip's pins.",
        in_program("bench_capi", "c_api_edges"), CAPI),
    Row("c_api_changes", 10, "million/s", "Changes of all pins that the C API writes into the caller's buffer, on the same stimulus.",
        in_program("bench_capi", "c_api_changes"), CAPI, limit="The core's time to make them."),
    Row("dpi", 10, "million/s", "Changes of the pins of `dsdpv1_model` by DPI-C under Verilator, without CLK: data exchange with 16 bytes each way, back to "
        "back at 12 Mbit/s, each bit of a request at its time. In CPU time.", lambda turn: turn.pin_changes(*DPI), ("bench_dpi",),
        limit="Verilator takes most of the time to wait for the next time and to find changes. dpi_alone is the rest without a model; "
              "the chip has to make the changes as it does in c_api_changes.", limit_of=chip_beside_verilator, limit_by="dpi_alone and c_api_changes"),
    Row("dpi_alone", None, "million/s", "Verilator alone: the same simulation, with the model's answers from a recording.",
        lambda turn: turn.replayed_pin_changes(*DPI), ("bench_dpi",)),
    Row("vpi", None, "million/s", "The same by VPI in Icarus, which alone takes 98 % of the time.", lambda turn: turn.pin_changes("vvp", programs.FOLDER / "vpi" / "binding_speed.vvp"), ("bench_vpi",)),
    Row("python", 10, "million/s", "Changes of all pins that the Python module writes into numpy arrays, on the same stimulus, given to the chip in one call "
        "each 9 ms; in CPU time.", lambda turn: turn.once("python", lambda: programs.row_of_python("python_speed.py", "python")), ("dsdpv1_capi", "dsdpv1_python"),
        limit="The core's time to make them."),
    Row("cocotb", 20, "%", "The CPU time that `cocotbext.profibus` adds to a simulation of the reference RTL in Icarus: a master brings it up, host port "
        "and model as scoreboard are at its pins. Compared with cocotb alone, which plays the same inputs from a recording.",
        lambda turn: turn.once("cocotb", lambda: programs.row_of_python("cocotb_speed.py", "cocotb", programs.FOLDER / "cocotb")), ("dsdpv1_capi", "dsdpv1_python"),
        at_most=True, limit="Each change of a pin is a call into Python."),
    of_sim("demo", 3, "The scenario power_on_12m, checks off, no files.", real_time(DEMO, *OFF),
           limit="A saturated bus and a user CPU that exchanges data every 40 us: half of the time goes to its accesses, one a turn of a coroutine "
                 "that runs the driver, a fifth to master and monitor, which decode each character of the telegrams separately, to "
                 "check the chip.", bound="chip"),
    of_sim("demo_full", 1.5, "The same with checks, log and FST wave.", real_time(DEMO, *FULL),
           limit="The wave takes two thirds of the time: 19 changes a microsecond, each generated and written: see fst and fst_library.",
           limit_of=lambda values, _: values["demo"] / (1 + values["fst_library"]), limit_by="demo and fst_library"),
    of_sim("demo_tlm", 2, "As demo, with `--view tlm`.", real_time(DEMO, *TLM), limit=TLM_LIMIT,
           bound="SystemC"),
    of_sim("tlm_vs_demo", 1, "demo_tlm against demo of the same round: TLM should not be slower.", time_ratio(DEMO, OFF, TLM), unit="times as fast",
           limit=TLM_LIMIT, limit_of=kernel_beside_demo, limit_by="demo and the SystemC of demo_tlm"),
    Row("systemc_tlm", 5, TIMES, "The TLM module in a SystemC platform: an idle user, INTR0 bound, 16 bytes each way back to back at 12 Mbit/s as "
        "characters.", in_program("bench_systemc", "systemc_tlm"), SYSTEMC,
        limit="An event of SystemC for each character of the answer, which `bus_out` reports at its end."),
    Row("systemc_tlm_handshake", 5, TIMES, "The same with L_REQ and L_STA bound, as required by a user who accesses the DPRAM.",
        in_program("bench_systemc", "systemc_tlm_handshake"), SYSTEMC,
        limit="L_REQ and L_STA change twice a microsecond: a timed event, a process and two signals of SystemC each time, nearly half of the run; "
              "kernel_handshake is the kernel's share alone. The limit assumes that the module between kernel and core "
              "costs nothing: neither its next turn, nor writing outputs, nor collecting characters.",
        limit_of=without("module", "systemc_tlm_handshake"), limit_by="systemc_tlm_handshake without the module's own part"),
    Row("kernel_handshake", None, TIMES, "The SystemC kernel alone: the characters of systemc_tlm_handshake without a receiver, the same changes of L_REQ and "
        "L_STA replayed.", in_program("bench_systemc", "kernel_handshake"), SYSTEMC),
    Row("systemc_pins", 2, TIMES, "The pin module in a SystemC platform, all pins bound, the same exchanges edge by edge.",
        in_program("bench_systemc", "systemc_pins"), SYSTEMC,
        limit="The kernel: each change of a pin is an event, a process and a signal to update, seven a microsecond. kernel_pins is "
              "the kernel's share alone, and the core works as in core_pins. The limit assumes that the module between them costs "
              "nothing: neither finding changed inputs, nor its next turn, nor writing outputs.",
        limit_of=without("module", "systemc_pins"), limit_by="systemc_pins without the module's own part"),
    Row("kernel_pins", None, TIMES, "The SystemC kernel alone: the same changes of the same signals as in systemc_pins, replayed, and an empty process that "
        "hears PBRXD.",
        in_program("bench_systemc", "kernel_pins"), SYSTEMC),
    Row("core_pins", None, TIMES, "The core alone with the exchanges of systemc_pins: PBRXD edge by edge, all output pins watched.",
        in_program("bench_core", "core_pins"), ("bench_core",)),
    of_sim("1m5", 30, "A slave with 32 bytes each way at 1.5 Mbit/s; its user CPU exchanges data every millisecond. Checks off.",
           real_time("1m5", *OFF), limit="The user CPU's accesses, and master and monitor, which decode each character separately.",
           bound="chip"),
    of_sim("spi_9m", None, "A DSDPV1-RSU with 32 bytes each way at 1.5 Mbit/s whose user CPU exchanges data without a pause over SPI at 9 MHz: 18 edges of SCK "
           "a microsecond, each an event of the core. Checks off.", real_time("spi_9m", *OFF)),
    of_sim("uart_1m8", None, "The same over the UART at 1.8432 Mbit/s.", real_time("uart_1m8", *OFF)),
    of_sim("power_on_9k6", 100, "The scenario power_on_9k6, checks off.", real_time("power_on_9k6", *OFF),
           limit="The start of the program is a third of the run."),
    Row("search_9k6", 1000, TIMES, "The core alone: the baud rate search from 12 Mbit/s to the end of 9.6 kbit/s on a silent line; no pin "
        "is watched.",
        in_program("bench_core", "search_9k6"), ("bench_core",)),
    of_sim("slaves_32", 1, "One master and 32 slaves with 8 bytes each way, all in data exchange at 12 Mbit/s; user CPUs exchange data every "
           "millisecond. Checks off.", real_time("slaves_32", *OFF), limit=SLAVES_LIMIT, bound="chip"),
    of_sim("slaves_125", 0.25, "The same with 125 slaves.", real_time("slaves_125", *OFF), limit=SLAVES_LIMIT,
           bound="chip"),
    of_sim("idle_station", 2, f"One more slave that is not addressed on a saturated 12 Mbit/s bus, on the bench: the time that {scenarios.IDLE} of them add "
           "to the run with one busy slave, divided by their number, as a share of that run, which is 2 s long. Their user CPUs idle after the initialisation.",
           idle_station, unit="%", at_most=True,
           limit="A station does not receive telegrams for others; the segment evaluates its filter for each."),
    of_sim("arm", 2, "The scenario arm_board_12m, checks off: the example firmware on the ARM board looks for data every 40 us.",
           real_time("arm_board_12m", *OFF), targets=("dsdpv1_firmware",),
           limit="600 thousand instructions in 20 ms, and a check for other agents after each access to the chip or a peripheral.",
           bound="processor"),
    on_board("arm_busy", 2, "Firmware that counts in RAM without a pause.", "loop_ram"),
    on_board("arm_gpio", 5, "Firmware that raises R_REQ and then polls L_REQ by GPIO without a pause.", "loop_gpio"),
    on_board("arm_dpram", 5, "Firmware that reads a cell of the DPRAM without a pause, and without holding it: each access is a violation.", "loop_dpram",
             limit="An access is one step of the chip, but each is reported, and takes the processor from its stack to the bench's and back."),
    of_sim("arm_interrupts", None, "The example firmware with power_on_9k6: asleep until INTR0 or its cycle of a millisecond. Checks off.",
           real_time("power_on_9k6", *OFF, "--set", "user_cpu.kind=arm", "--set", f"user_cpu.elf={programs.FIRMWARE / 'device_interrupts.elf'}"), targets=("dsdpv1_firmware",)),
    of_sim("arm_spi", None, "The scenario arm_spi, checks off.", real_time("arm_spi", *OFF), targets=("dsdpv1_firmware",)),
    of_sim("arm_uart", None, "The scenario arm_uart, checks off.", real_time("arm_uart", *OFF), targets=("dsdpv1_firmware",)),
    of_sim("fst", 1.5, "demo with an FST wave against demo without.", time_ratio(DEMO, WAVE, OFF), unit="times as long", at_most=True,
           limit="The demo without a wave does not make the changes that a wave shows: telegrams and accesses cost one step each. With a wave, there are 2.3 million "
                 "changes in 120 ms of simulated time: those of telegrams as runs in the recorder, those of accesses edge by edge in the chip. "
                 "fst_library gives the library's share alone.",
           limit_of=lambda values, _: 1 + values["fst_library"], limit_by="demo and fst_library"),
    of_sim("fst_library", None, "The FST library alone: the changes of that wave, read in advance and written again, in CPU time, against demo.", fst_library,
           unit="times as long", at_most=True, targets=("bench_fst",)),
    Row("lockstep", 80, "%", "Random lockstep as `rtl-random --seed 1 --jobs 1` does it: its cycles per second as a share of those of the same "
        "Verilated RTL alone, which gets the same inputs from a recording; in turns, in one process, in CPU time.",
        in_program("bench_rtl", "lockstep"), RTL, limit="Making the stimulus and comparing the pins."),
    of_sim("start", 50, "`dsdpv1-sim --version`, from the call to the end.", lambda turn: turn.start(), unit="ms", at_most=True),
    Row("chip", 64, "KB", "The total memory of one chip.", in_program("bench_core", "chip"), ("bench_core",), at_most=True),
)
NAMES = tuple(row.name for row in ROWS)


def targets_of(rows):
    """The targets to build for these rows; the calibration is in bench_core."""
    return sorted({"bench_core", *(target for row in rows for target in row.targets)})
