#!/usr/bin/env python3
"""Firmware compiled for the host as a user CPU: what it does reaches chip and log, and what goes wrong is said.

    host_process.py SIM CC SOURCE_FOLDER
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SIM, CC, TREE = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], pathlib.Path(sys.argv[3])
HERE = pathlib.Path(__file__).resolve().parent
SCENARIO = """name: host process
baud: 1.5M
end: 60ms
chip: {chip}
slaves:
  - name: device
    address: 5
    init: {{ident: 0x0CC9, max_inputs: 2, max_outputs: 2, cfg: "11 21"}}
    user_cpu: {{kind: process, program: {program}, arguments: [{arguments}]{more}}}
masters:
  - {{name: plc, address: 2, start: 1ms, slaves: [{{slave: device, outputs: "01 02"}}]}}
script:
  - {{at: 25ms, do: set_outputs, slave: device, bytes: "A5 5A"}}
expect:
  - {{slave: device, dp_state: data_exch, inputs: "A5 5A"}}
"""
PORTS = {"parallel": "{search_window_ms: 1}",
         "spi": "{kind: dsdpv1_rsu, mode: spi, search_window_ms: 1}",
         "uart": "{kind: dsdpv1_rsu, mode: uart, uart_rate: 1.8432M, search_window_ms: 1}"}


def build(program, *options):
    rest = program.with_suffix(".o")
    subprocess.run([CC, "-x", "c++", "-fno-exceptions", "-fno-inline", "-g", "-O1", "-Wall", "-Wextra", "-Werror", "-I", TREE, "-c", HERE / "rest.cpp", "-o", rest], check=True)
    sources = [*sorted((TREE / "driver").glob("dsdpv1*.c")), TREE / "driver/host/dsdpv1_bench.c", HERE / "device.c"]
    subprocess.run([CC, "-std=c99", "-g", "-O1", "-Wall", "-Wextra", "-pedantic", "-Werror", "-I", TREE, *sources, rest, "-o", program, *options], check=True)


class HostProcess(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.place.name)
        build(cls.folder / "device")

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def run_it(self, *options, port="parallel", fault="", more="", program="./device", command="run"):
        arguments = ", ".join(word for word in (port, fault) if word)
        scenario = self.folder / "scenario.yaml"
        scenario.write_text(SCENARIO.format(chip=PORTS[port], program=program, arguments=arguments, more=more))
        return subprocess.run([SIM, command, scenario, *options], capture_output=True, text=True, check=False, timeout=300, cwd=self.folder)

    def log(self, *options, **more):
        done = self.run_it("--log", "log.jsonl", *options, **more)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return (self.folder / "log.jsonl").read_text()

    def test_each_port_comes_to_data_exchange_and_fetches_outputs(self):
        for port in PORTS:
            for fault in ("", "polls"):
                with self.subTest(port=port, fault=fault):
                    done = self.run_it(port=port, fault=fault)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_every_engine_gives_the_same_log_and_a_second_run_too(self):
        for port in PORTS:
            with self.subTest(port=port):
                skip = self.log(port=port)
                self.assertEqual(skip, self.log(port=port))
                self.assertEqual(skip, self.log("--engine", "step", port=port))

    def test_transactions_bring_it_to_data_exchange(self):
        done = self.run_it("--view", "tlm")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_what_it_prints_is_in_the_log_with_its_time(self):
        events = [json.loads(line) for line in self.log().splitlines()]
        texts = [event for event in events if "initialised" in event.get("text", "") and event["kind"] == "text"]
        self.assertEqual([event["station"] for event in texts], ["device"])

    def test_the_handler_follows_the_fall_within_an_access(self):
        events = [json.loads(line) for line in self.log().splitlines()]
        falls = [event["at_ns"] for event in events if event.get("code") == "PRM_TO_USER"]
        said = [event for event in events if "INTR0 at" in event.get("text", "")]
        self.assertGreaterEqual(len(said), 1)
        self.assertLess(said[0]["at_ns"] - falls[0], 5000)

    def test_its_mistakes_are_violations(self):
        for fault, check in (("hasty", "OWNERSHIP_SYNC_WINDOW"), ("blind", "LOOK_IN_WINDOW")):
            with self.subTest(fault=fault):
                done = self.run_it(fault=fault)
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertIn(check, done.stdout)

    def looks(self, *options, port="parallel"):
        """What the run has of LOOK_IN_WINDOW."""
        self.run_it("--result", "result.json", *options, port=port)
        checks = json.loads((self.folder / "result.json").read_text())["checks"]
        return [each for each in checks if each["id"] == "LOOK_IN_WINDOW"]

    def test_its_looks_are_judged_alike_in_every_engine_and_view_of_the_parallel_port(self):
        first = self.looks()
        self.assertGreater(first[0]["count"], 100)
        for options in (("--engine", "step"), ("--view", "tlm")):
            self.assertEqual(self.looks(*options), first)
        for port in ("spi", "uart"):
            self.assertEqual(self.looks(port=port), [])

    def places(self, code, *options, **more):
        """The places that the run gives for what it finds."""
        self.run_it("--result", "result.json", "--log", "log.txt", *options, **more)
        result = json.loads((self.folder / "result.json").read_text())
        found = [each["where"] for check in result["checks"] if check["id"] == code for each in check["listed"]]
        return found + [event["where"] for event in result["violated"] if event["code"] == code]

    @staticmethod
    def line_with(words, file="device.c"):
        lines = (HERE / file).read_text().splitlines()
        return [number for number, line in enumerate(lines, 1) if words in line]

    def assert_at(self, places, words, function, file="device.c"):
        self.assertTrue(places)
        for place in places:
            self.assertEqual((place["file"], [place["line"]], place["function"]), (file, self.line_with(words, file), function))

    def test_a_mistake_is_where_the_firmware_called_the_driver(self):
        for options in ((), ("-no-pie",), ("-O2",)):
            build(self.folder / "other", *options)
            with self.subTest(options=options):
                self.assert_at(self.places("OWNERSHIP_BOTH_OWN", fault="hasty", program="./other"), "dsdpv1_initialise(&chip, &config)", "main")
                self.assertIn(f"at device.c:{self.line_with('dsdpv1_initialise(')[0]} in main()", (self.folder / "log.txt").read_text())

    def test_a_look_that_is_too_early_is_where_it_was_made(self):
        self.assert_at(self.places("LOOK_IN_WINDOW", fault="early")[:1], "dsdpv1_initialise(&chip, &config)", "main")

    def test_what_is_told_of_mistakes_is_alike_in_every_engine_and_view(self):
        for fault in ("hasty", "blind", "early", "keeps"):
            told = set()
            for options in ((), ("--engine", "step"), ("--view", "tlm")):
                self.run_it("--log", "log.txt", *options, fault=fault)
                told.add((self.folder / "log.txt").read_text())
            self.assertEqual(len(told), 1, fault)

    def test_an_omission_is_where_the_firmware_was_instead(self):
        for port, code in (("parallel", "OWNERSHIP_NEVER_RELEASED"), ("spi", "B014_HELD")):
            with self.subTest(port=port):
                places = self.places(code, port=port, fault="keeps")
                self.assert_at(places, "dsdpv1_bench_wait_ns(1000000)", "pass", "rest.cpp")
                self.assertAlmostEqual(places[0]["stayed_ns"], 11e6, delta=1e5)

    def test_its_end_is_where_it_called_its_port_last(self):
        for port in PORTS:
            with self.subTest(port=port):
                self.assert_at(self.places("PROCESS_ENDED", port=port, fault="ends"), "dsdpv1_bench_wait_ns(100000)", "main")

    def test_a_program_that_another_has_started_in_its_place_has_lines_too(self):
        (self.folder / "starts").write_text('#!/bin/sh\nexec ./device "$@"\n')
        (self.folder / "starts").chmod(0o755)
        self.assert_at(self.places("PROCESS_ENDED", fault="ends", program="./starts"), "dsdpv1_bench_wait_ns(100000)", "main")

    def test_without_debug_information_there_is_an_address(self):
        build(self.folder / "other", "-s")
        for place in self.places("PROCESS_ENDED", fault="ends", program="./other"):
            self.assertEqual((place["file"], place["line"], place["function"]), ("", 0, ""))
            self.assertGreater(int(place["pc"], 16), 0x1000)

    def test_another_version_of_the_wire_is_refused(self):
        (self.folder / "old").write_text("#!/usr/bin/env python3\nimport os, socket, struct\nbench = socket.socket(fileno=int(os.environ['DSDPV1_BENCH_FD']))\n"
                                         "bench.sendall(struct.pack('=IIIIQQ', 1, 0, 1, 0, 0, 0))\nbench.recv(100)\n")
        (self.folder / "old").chmod(0o755)
        done = self.run_it(program="./old")
        self.assertEqual(done.returncode, 1)
        self.assertIn("old has version 1 of dsdpv1_bench_wire.h, expected 2: compile it with this dsdpv1_bench.c", " ".join(done.stdout.split()))

    def test_its_end_is_a_violation(self):
        done = self.run_it(fault="ends")
        self.assertEqual(done.returncode, 1)
        self.assertIn("device has ended with exit code 3", done.stdout)
        self.assertIn("PROCESS_ENDED", done.stdout)
        done = self.run_it(program="/bin/true")
        self.assertEqual(done.returncode, 1)
        self.assertIn("true has ended with exit code 0", done.stdout)
        done = self.run_it(fault="crashes")
        self.assertEqual(done.returncode, 1)
        self.assertIn("device was ended by signal 6, Aborted", done.stdout)

    def test_a_loop_without_a_call_is_found(self):
        done = self.run_it(fault="hangs", more=", patience: 1s")
        self.assertEqual(done.returncode, 1)
        self.assertIn("device has not called its port for 1 s of the host's time", done.stdout)

    def test_it_may_print_more_than_a_pipe_holds(self):
        said = [event for event in map(json.loads, self.log(fault="talks", more=", patience: 2s").splitlines()) if event["kind"] == "text"]
        self.assertEqual([event["text"][:9] for event in said if event["text"].startswith("line")], [f"line {line:4}" for line in range(2000)])

    def test_a_run_goes_on_where_it_was_saved(self):
        whole = self.log("--save-at", "20ms", "saved.run")
        done = subprocess.run([SIM, "run", "--restore", "saved.run", "--log", "rest.jsonl"], capture_output=True, text=True, check=False,
                              timeout=300, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        rest = (self.folder / "rest.jsonl").read_text()
        self.assertTrue(rest and whole.endswith(rest))

    def test_what_cannot_be_is_one_line(self):
        for options, more, program, words in (
                ((), "", "./missing", "program is"),
                ((), "", "./scenario.yaml", "which is no program"),
                ((), ", elf: a.elf", "./device", "elf without kind: arm"),
                ((), ", without_mailbox: leave_out", "./device", "without_mailbox is that of kind: arm"),
                ((), ", behaviour: count", "./device", "behaviour is for the program of device"),
                (("--rewind-on", "DP_STATE", "1ms", "--wave", "a.vcd"), "", "./device", "cannot be rewound"),
                (("--set", "user_cpu.kind=native"), "", "./device", "program without kind: process")):
            with self.subTest(words=words):
                done = self.run_it(*options, more=more, program=program)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(words, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)

    def test_alone_it_says_who_starts_it(self):
        done = subprocess.run([self.folder / "device", "parallel"], capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual(done.returncode, 2)
        self.assertIn("is started by dsdpv1-sim", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
