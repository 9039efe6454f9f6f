#!/usr/bin/env python3
"""The logic of the speed table on made-up measurements: goals met, output, errors. Nothing is measured here."""
import contextlib
import io
import json
import pathlib
import re
import tempfile
import types
import unittest
from unittest import mock

import bench
import hot_spots
import instructions
import page
import parts
import programs
import rows
import scenarios
import table


def row(name="speed", goal=10, at_most=False, measure=None):
    return rows.Row(name, goal, "x real time", "What it does.", measure, ("bench_core",), at_most)


def outcome(*values, error="", **others):
    return table.Outcome(row(**others), list(values), error)


def state(*times, refused=0):
    return types.SimpleNamespace(times=list(times), refused=refused)


def called(*words):
    """Exit code, standard output, standard error of ./run bench."""
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        try:
            status = bench.main(list(words))
        except SystemExit as end:
            status = end.code
    return status, out.getvalue(), errors.getvalue()


class Judging(unittest.TestCase):
    def test_the_value_is_the_median(self):
        self.assertEqual(outcome(9, 1, 5).value, 5)
        self.assertEqual(outcome(1, 2, 4, 9).value, 3)

    def test_a_goal_is_met_from_its_number_on(self):
        self.assertEqual([outcome(value).met for value in (9.99, 10, 11)], [False, True, True])

    def test_a_goal_that_is_at_most_is_met_up_to_its_number(self):
        self.assertEqual([outcome(value, at_most=True).met for value in (9.99, 10, 11)], [True, True, False])

    def test_a_failed_row_is_not_met_and_shows_why(self):
        failed = outcome(11, error="no such thing")
        self.assertFalse(failed.met)
        self.assertEqual(table.cells(failed), ["speed", "failed", "at least 10 x real time", "not met", "no such thing"])

    def test_cells_are_row_value_goal_met_and_range(self):
        self.assertEqual(table.cells(outcome(12.345, 11, 1234)), ["speed", "12.3", "at least 10 x real time", "met", "11..1234"])
        self.assertEqual(table.cells(outcome(0.5, at_most=True))[2], "at most 10 x real time")

    def test_a_spread_of_more_than_a_tenth_is_busy(self):
        self.assertFalse(table.is_busy([100, 110]))
        self.assertTrue(table.is_busy([100, 111]))
        self.assertIn("the machine was busy", table.calibration_line(state(100, 120)))


class Counting(unittest.TestCase):
    """Instructions of made-up runs."""

    def row(self, **others):
        return instructions.Row("demo", "simulated ms", "What it does.", "power_on_12m", (20, 30), **others)

    def value(self, row, short, long):
        counts = {20: (short, {"simulated_ns": 20e6}), 30: (long, {"simulated_ns": 30e6})}
        with mock.patch.object(instructions, "counted", lambda _, length: counts[length]):
            return instructions.value_of(row)

    def test_what_starts_a_run_is_out_of_it(self):
        self.assertEqual(self.value(self.row(), 1200, 1700), 50)
        self.assertEqual(self.value(self.row(start=True), 1200, 1700), 200)

    def test_a_row_fails_from_a_twentieth_more_than_recorded_on(self):
        row = self.row()
        for value, before, change, right in ((105, 100, "+5.0 %", True), (106, 100, "grown", False), (50, 100, "-50.0 %", True), (50, None, "not recorded", False),
                                             ("no valgrind", 100, "no valgrind", False)):
            cells, met = instructions.judged(row, value, before)
            self.assertEqual((cells[-1], met), (change, right))

    def test_a_record_keeps_the_other_rows(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(instructions, "RECORD", pathlib.Path(folder, "record.tsv")):
            instructions.record({"demo": 1, "arm": 2})
            instructions.record({"demo": 3})
            self.assertEqual(instructions.recorded(), {"arm": 2, "demo": 3})

    def test_every_row_is_recorded(self):
        self.assertEqual(set(instructions.recorded()), set(instructions.NAMES))

    def test_the_page_of_the_checks_says_what_they_cost(self):
        record, page_of_checks = instructions.recorded(), (programs.ROOT / "docs/checks.md").read_text(encoding="utf-8")
        said = re.search(r"takes ([\d.]+) times the host instructions of one without in `power_on_12m`, and ([\d.]+) times in `arm_board_12m`", page_of_checks)
        for times, row_name in zip(said.groups(), ("demo", "arm")):
            self.assertEqual(times, f"{record[f'{row_name}_checks'] / record[row_name]:.1f}")


class Measuring(unittest.TestCase):
    """The whole program with its own rows and calibration."""

    def bench(self, *words, measured=(), times=lambda: 20.0):
        with mock.patch.object(rows, "ROWS", tuple(measured)), mock.patch.object(rows, "NAMES", tuple(each.name for each in measured)), \
                mock.patch.object(programs, "calibration", times), mock.patch.object(bench, "FIRST_LOOKS", 0), \
                mock.patch("os.sched_setaffinity"):
            return called(*words)

    def test_every_row_is_measured_in_every_round(self):
        values = iter([3, 30, 4, 40, 5, 50])
        measured = [row("slow", measure=lambda turn: next(values)), row("quick", measure=lambda turn: next(values))]
        status, out, _ = self.bench("--rounds", "3", measured=measured)
        self.assertEqual(status, 1)
        self.assertEqual(out.splitlines()[:3], ["row\tvalue\tgoal\tmet\tmin..max", "slow\t4\tat least 10 x real time\tnot met\t3..5",
                                                "quick\t40\tat least 10 x real time\tmet\t30..50"])

    def test_all_met_is_exit_0(self):
        self.assertEqual(self.bench(measured=[row(measure=lambda turn: 11)])[0], 0)

    def test_the_calibration_stands_before_between_and_after_the_rows(self):
        calls = []
        measured = [row(name, measure=lambda turn, name=name: calls.append(name) or 11) for name in ("one", "two")]
        self.bench("--rounds", "1", measured=measured, times=lambda: calls.append("time") or 20.0)
        self.assertEqual(calls, ["time", "one", "time", "two", "time"])

    def test_what_is_measured_while_others_use_the_machine_is_measured_again(self):
        values, times = iter([5, 11]), iter([20.0, 30.0, 31.0, 21.0, 20.0])  # busy after the first value, then quiet
        measured = [row(measure=lambda turn: next(values))]
        status, out, _ = self.bench("--rounds", "1", "--wait", "1", measured=measured, times=lambda: next(times))
        self.assertEqual(status, 0)
        self.assertIn("speed\t11\t", out)
        self.assertIn("the machine was quiet, 1 values were measured again", out)

    def test_runs_made_while_others_use_the_machine_are_made_again_for_other_rows_too(self):
        runs, times = iter([1, 2]), iter([20.0, 30.0, 20.0, 20.0, 20.0])
        shared = [row(name, measure=lambda turn: turn.once("run", lambda: next(runs))) for name in ("one", "two")]
        out = self.bench("--rounds", "1", "--wait", "1", measured=shared, times=lambda: next(times))[1]
        self.assertEqual([line.split("\t")[1] for line in out.splitlines()[1:3]], ["2", "2"])

    def test_without_time_to_wait_a_busy_machine_is_only_said(self):
        values, times = iter([5]), iter([20.0, 30.0])
        out = self.bench("--rounds", "1", measured=[row(measure=lambda turn: next(values))], times=lambda: next(times))[1]
        self.assertIn("speed\t5\t", out)
        self.assertIn("the machine was busy", out)

    def test_a_row_that_fails_is_said_and_is_exit_1(self):
        def fail(turn):
            raise programs.Failed("slaves has 125 items")

        status, out, _ = self.bench(measured=[row("bad", measure=fail), row("good", measure=lambda turn: 11)])
        self.assertEqual(status, 1)
        self.assertIn("bad\tfailed\tat least 10 x real time\tnot met\tslaves has 125 items\n", out)
        self.assertIn("good\t11\t", out)

    def test_where_no_row_could_be_measured_the_table_says_why_and_the_calibration_is_the_last_look(self):
        def fail(turn):
            raise programs.Failed("is not there")

        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "table.json")
            status, out, _ = self.bench("--json", str(file), measured=[row("bad", measure=fail)])
            report = json.loads(file.read_text(encoding="utf-8"))
        self.assertEqual(status, 1)
        self.assertIn("bad\tfailed\tat least 10 x real time\tnot met\tis not there\n", out)
        self.assertIn("\ncalibration\t20 ms\t20..20 ms\tspread 0 %\t", out)
        self.assertEqual((report["calibration"]["median_ms"], report["rows"][0]["error"]), (20, "is not there"))

    def test_json_has_every_value(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "table.json")
            self.bench("--json", str(file), "--rounds", "2", measured=[row(measure=lambda turn: 11)])
            report = json.loads(file.read_text(encoding="utf-8"))
            self.assertEqual([each.name for each in pathlib.Path(folder).iterdir()], ["table.json"])
        self.assertEqual(report["rows"], [{"name": "speed", "goal": 10, "at_most": False, "unit": "x real time", "met": True, "value": 11, "min": 11,
                                           "max": 11, "values": [11, 11]}])
        self.assertEqual((report["rounds"], report["clock"], report["calibration"]["busy"]), (2, "wall", False))

    def test_json_is_left_as_it_was_when_writing_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "table.json")
            file.write_text("before", encoding="utf-8")
            with mock.patch("os.replace", side_effect=OSError(28, "No space left on device", str(file))):
                status, _, errors = self.bench("--json", str(file), measured=[row(measure=lambda turn: 11)])
            self.assertEqual((status, errors.count("\n")), (2, 6))  # a line per round, and the error
            self.assertTrue(errors.endswith("table.json: No space left on device\n"))
            self.assertEqual([each.read_text(encoding="utf-8") for each in pathlib.Path(folder).iterdir()], ["before"])

    def test_only_the_asked_rows_are_measured(self):
        measured = [row("one", measure=lambda turn: 11), row("two", measure=lambda turn: 11)]
        self.assertNotIn("one", self.bench("--only", "two", measured=measured)[1])

    def test_a_run_is_shared_in_a_round_and_made_again_in_the_next(self):
        count = []
        turn = programs.Round(pathlib.Path())
        for _ in range(2):
            turn.once("demo", lambda: count.append(1))
        programs.Round(pathlib.Path()).once("demo", lambda: count.append(1))
        self.assertEqual(len(count), 2)

    def test_a_program_that_is_not_there_fails_its_row_in_one_line(self):
        with self.assertRaisesRegex(programs.Failed, "^no_such_program cannot be run: No such file or directory$"):
            programs.call(["/nowhere/no_such_program"])

    def test_pin_changes_are_of_the_time_that_exchanges_take_without_the_start(self):
        with mock.patch.object(programs, "cpu_of_children", side_effect=[1, 3, 10, 16]), \
                mock.patch.object(programs, "call", side_effect=["changes\t0\n", "note\nchanges\t8000000\n"]) as calls:
            self.assertEqual(programs.pin_changes("vvp", "bench.vvp"), 2)
        self.assertEqual([call.args[0] for call in calls.mock_calls], [["vvp", "bench.vvp", "+exchanges=0"], ["vvp", "bench.vvp", "+exchanges=2000"]])


class CommandLine(unittest.TestCase):
    def refuses(self, words, *arguments):
        status, out, errors = called(*arguments)
        self.assertEqual((status, out, errors.count("\n")), (2, "", 1), errors)
        self.assertIn(words, errors)

    def test_what_it_does_not_know_is_one_line_and_exit_2(self):
        self.refuses("unknown row core_3, expected core_2, ", "--only", "core_2,core_3")
        self.refuses("unknown row (none)", "--only", ",")
        for rounds in ("0", "-1", "1001", "many", "²"):
            self.refuses("is no number of rounds, expected 1 to 1000", f"--rounds={rounds}")
        self.refuses("its folder is not there", "--json", "/nowhere/table.json")
        self.refuses("is no file that can be replaced", "--json", "/")
        self.refuses("--document needs all rows", "--document", "--only", "demo")
        self.refuses("--document needs all rows", "--document", "--rounds", "4")
        self.refuses("invalid choice: 'sun'", "--clock", "sun")
        self.refuses("unrecognized arguments: --quick", "--quick")

    def test_help_has_examples(self):
        status, out, _ = called("--help")
        self.assertEqual(status, 0)
        self.assertIn("examples:\n  ./run bench\n", out)

    def test_list_has_every_row_with_its_goal(self):
        status, out, _ = called("--list")
        self.assertEqual((status, [line.split("\t")[0] for line in out.splitlines()]), (0, list(rows.NAMES)))
        self.assertIn("chip\tat most 64 KB\t", out)

    def test_only_what_the_rows_need_is_built(self):
        self.assertEqual(called("--targets", "--only", "core_2")[1].split(), ["bench_core"])
        self.assertEqual(called("--targets", "--only", "arm")[1].split(), ["bench_core", "dsdpv1-sim", "dsdpv1_firmware"])


class Scenarios(unittest.TestCase):
    def test_all_stations_have_addresses_of_their_own_besides_the_masters(self):
        slaves = scenarios.SCENARIOS["slaves_125"]["slaves"]
        self.assertEqual([each["address"] for each in slaves], list(range(1, 126)))

    def test_configuration_is_for_all_bytes(self):
        for io in (2, 8, 16, 32, 244):
            self.assertEqual(sum((each & 0x0F) + 1 for each in scenarios.identifiers(io)), io)

    def test_idle_slaves_are_served_by_nobody(self):
        idle = scenarios.SCENARIOS["with_idle"]
        self.assertEqual((len(idle["slaves"]), len(idle["masters"][0]["slaves"])), (scenarios.IDLE + 1, 1))


class Page(unittest.TestCase):
    def test_samples_go_to_the_block_of_their_file(self):
        printed = ("# Overhead  Source File\n    40.00%  chip.cpp\n    30.50%  uart_rx.cpp\n     4.50%  uart_rx.hpp\n"
                   "    24.30%  array\n     0.70%  fdl.cpp\n")
        names = {"chip.cpp": "dsdpv1/chip", "uart_rx.cpp": "profibus/uart_rx", "uart_rx.hpp": "profibus/uart_rx", "fdl.cpp": "profibus/fdl"}
        self.assertEqual([(block, round(share, 1)) for block, share in hot_spots.shares(printed, names)],
                         [("dsdpv1/chip", 40), ("profibus/uart_rx", 35), ("elsewhere", 25)])

    def test_every_source_of_the_core_is_in_a_block(self):
        self.assertEqual(hot_spots.blocks()["uart_rx.hpp"], "model/profibus/uart_rx.*")
        self.assertNotIn("dsdpv1_tlm.cpp", hot_spots.blocks())

    def test_samples_of_a_run_go_to_the_part_of_their_function(self):
        printed = """# Overhead  Shared Object  Symbol
            12.00%  dsdpv1-sim                [.] dsdpv1::Chip::Impl::advance
             8.00%  dsdpv1-sim                [.] dsdpv1::profibus::UartRx::eval
             5.00%  dsdpv1-sim                [.] non-virtual thunk to dsdpv1::tb::PinChip::next() const
             4.00%  dsdpv1-sim                [.] std::_Function_handler<void (dsdpv1::bus::ReceivedCharacter const&), dsdpv1::bus::Monitor::Monitor(dsdpv1::bus::Segment&)>::_M_invoke
             3.00%  dsdpv1-sim                [.] fstWriterEmitValueChange
             2.00%  libsystemc-2.3.4.so       [.] sc_core::sc_event::trigger
             1.50%  dsdpv1-sim                [.] virtual thunk to dsdpv1::systemc::TlmModule::write
             0.50%  bench_systemc             [.] dsdpv1::systemc::PinModule::evaluate
             0.25%  bench_systemc             [.] dsdpv1::speed::(anonymous namespace)::EdgeMaster::run
             1.00%  dsdpv1-sim                [.] sc_core::sc_signal<bool, (sc_core::sc_writer_policy)0>::write
             6.00%  dsdpv1-sim                [.] dsdpv1::arm::Engine::run
             0.50%  libdsdpv1.so.0.1.0        [.] dpsim_chip_next
             0.75%  libdsdpv1.so.0.1.0        [.] dsdpv1::capi::(anonymous namespace)::Alone::next
             1.00%  libdsdpv1.so.0.1.0        [.] dsdpv1::Chip::Impl::advance
             1.25%  libdsdpv1_dpi.so.0.1.0    [.] dsdpv1::simulator::Model::step
             2.50%  Vbinding_speed            [.] VlDelayScheduler::resume
             7.00%  dsdpv1-sim                [.] void dsdpv1::arm::Operations::load_many<false>(dsdpv1::arm::Engine&, dsdpv1::arm::Instruction const&)
             8.00%  libc.so.6                 [.] malloc
             9.00%  [kernel.kallsyms]         [k] clear_page_erms
            10.00%  dsdpv1-sim                [.] dsdpv1_crc
            11.00%  dsdpv1-sim                [.] jump_over"""
        self.assertEqual(parts.shares(printed), {"chip": 21, "binding": 2.5, "Verilator": 2.5, "module": 2, "bench": 5.25, "bus": 4, "FST library": 3, "SystemC": 3, "processor": 13, "libraries": 8,
                                                 "kernel": 9, "driver": 10, "elsewhere": 11})

    def test_a_measured_limit_is_what_the_part_that_bounds_a_row_would_leave(self):
        speed = table.Outcome(rows.Row("speed", 2, "x", "What.", None, (), bound="SystemC"), [0.5])
        ratio = table.Outcome(rows.Row("ratio", 2, "x", "What.", None, (), at_most=True, bound="FST library"), [4.0])
        profiles = {"speed": {"SystemC": 50}, "ratio": {"FST library": 40}}
        self.assertEqual(page.measured_limit(speed, {}, profiles), "1 (SystemC, 50 %)")
        self.assertEqual(page.measured_limit(ratio, {}, profiles), "1.6 (FST library, 40 %)")
        self.assertEqual(page.measured_limit(ratio, {}, {}), "-")

    def test_a_measured_limit_may_be_what_other_rows_say(self):
        missed = table.Outcome(rows.Row("pins", 2, "x", "What.", None, (), limit_of=lambda values, _: values["kernel"] / 3, limit_by="a third of kernel"), [0.5])
        self.assertEqual(page.measured_limit(missed, {"kernel": 4.5}, {}), "1.5 (a third of kernel)")
        self.assertEqual(page.measured_limit(missed, {"core": 6}, {}), "-")

    def test_every_limit_out_of_other_rows_is_of_rows_that_are_measured(self):
        values = {each.name: 2.0 for each in rows.ROWS}
        profiles = {name: {part: 50.0 for part in parts.NAMES} for name in rows.PROFILED}
        limits = {each.name: each.limit_of(values, profiles) for each in rows.ROWS if each.limit_of}
        self.assertEqual({name: round(limit, 3) for name, limit in limits.items()},
                         {"dpi": 1, "demo_full": 0.667, "tlm_vs_demo": 0.8, "systemc_tlm_handshake": 4, "systemc_pins": 4, "fst": 3})

    def test_every_bound_is_a_part_of_a_run_that_is_looked_into(self):
        for each in rows.ROWS:
            if each.bound:
                self.assertIn(each.name, rows.PROFILED)
                self.assertIn(each.bound, parts.NAMES)

    def test_without_perf_the_page_says_so(self):
        with mock.patch("shutil.which", return_value=None):
            profile = hot_spots.profile(pathlib.Path())
            profiles = parts.profiles(pathlib.Path())
        text = page.performance_page([outcome(11)], state(20.0, 30.0), 5, "wall", {"cpu": "A | B", "cores": 2}, profile, profiles)
        self.assertIn("No profile was made: perf is not installed.", text)
        self.assertIn("| `speed` | 11 | at least 10 x real time | met | 11..11 |", text)
        self.assertIn("1 of 1 goals are met.", text)
        self.assertNotIn("The others have these bounds", text)
        self.assertIn("The machine was busy", text)

    def test_a_goal_that_is_missed_has_its_limit_on_the_page(self):
        missed = table.Outcome(rows.Row("slow", 10, "x", "What.", None, (), limit="Because."), [9.0])
        comparison = table.Outcome(rows.Row("other", None, "x", "What.", None, ()), [1.0])
        text = page.performance_page([missed, comparison], state(20, 21, 20), 5, "wall", {"cpu": "A", "cores": 2}, ([], "perf is not installed"), {})
        self.assertIn("0 of 1 goals are met.", text)
        self.assertIn("| `slow` | - | Because. |", text)
        self.assertIn("| `other` | 1 | for comparison, x | - | 1..1 |", text)
        self.assertTrue(comparison.met)

    def test_every_goal_that_the_document_says_is_missed_has_a_reason(self):
        text = bench.PAGE.read_text(encoding="utf-8")
        for each in rows.ROWS:
            if re.search(rf"\| `{each.name}` \|.*\| not met \|", text):
                self.assertTrue(each.limit, each.name)

    def test_the_document_names_every_row(self):
        text = bench.PAGE.read_text(encoding="utf-8")
        for each in rows.ROWS:
            self.assertIn(f"\n| `{each.name}` | ", text)
            self.assertIn(f" | {table.goal(each)} | ", text)


if __name__ == "__main__":
    unittest.main()
