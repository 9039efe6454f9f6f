#!/usr/bin/env python3
"""Many commands at once in one folder, disturbed regressions, goldens on a full disk, and the common behaviour of all commands: docs/robustness.md
has the rules.

    together.py DSDPV1_SIM [--many N] [TEST...]
"""
import collections
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
DEADLINE = 300
SCENARIO = """name: %s
baud: 12M
end: %s
slaves:
  - {name: demo, address: 5, gsd: device.gsd, modules: ["2 bytes in, 2 bytes out"]}
masters:
  - {name: plc, address: 2, slaves: [{slave: demo, outputs: "01 02"}]}
"""
LONG = "3000s"  # until it is interrupted
MANY = 12


class Folder(unittest.TestCase):
    """Each test has a folder with a scenario and the output of its run."""

    program, kept = None, None

    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.mkdtemp(prefix="dsdpv1_together_")
        shutil.copy(os.path.join(ROOT, "scenarios", "dsdpv1.gsd"), os.path.join(cls.kept, "device.gsd"))
        for name, end in (("short", "3ms"), ("other", "3ms")):
            with open(os.path.join(cls.kept, name + ".yaml"), "w", encoding="utf-8") as file:
                file.write(SCENARIO % (name, end))
        subprocess.run([cls.program, "run", "short.yaml", "--quiet", "--log", "log", "--capture", "c.pcapng", "--wave", "w.vcd", "--trace", "trace"],
                       cwd=cls.kept, check=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.kept)

    def setUp(self):
        self.path = tempfile.mkdtemp(prefix="dsdpv1_together_")
        shutil.copytree(self.kept, self.path, dirs_exist_ok=True)
        self.addCleanup(shutil.rmtree, self.path)

    def file(self, *names):
        return os.path.join(self.path, *names)

    def write(self, name, text):
        with open(self.file(name), "w", encoding="utf-8") as file:
            file.write(text)

    def start(self, *words, faults="", stdout=subprocess.PIPE):
        launcher = [sys.executable, "-S", os.path.join(HERE, "launch.py"), faults] if faults else []
        return subprocess.Popen([*launcher, self.program, *words], cwd=self.path, stdout=stdout, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)

    def do(self, *words, **how):
        return self.end(self.start(*words, **how))

    def end(self, process):
        """Exit code and the lines of standard error."""
        out, errors = process.communicate(timeout=DEADLINE)
        self.assertNotIn(b"terminate", errors)
        self.said = (out or b"").decode()
        return process.returncode, errors.decode().splitlines()

    def found(self, folder="."):
        """All files in it, without the numbers that are another's each time."""
        names = (os.path.relpath(os.path.join(place, name), self.file(folder)) for place, _, names in os.walk(self.file(folder)) for name in names)
        return sorted(re.sub(r"\.[0-9a-f]{16}\b", "", re.sub(r"\.\d+(?=\.(run|part)\b)", ".PID", name)) for name in names)


class ManyAtOnce(Folder):
    def test_each_run_leaves_its_outputs_complete_and_nothing_else(self):
        before = self.found()
        outputs = {"--log": "same.log", "--capture": "same.pcapng", "--wave": "same.vcd", "--trace": "same.trace", "--result": "same.json", "--report": "same.html"}
        words = [word for pair in outputs.items() for word in pair]
        codes = [self.end(process) for process in [self.start("run", "short.yaml", "--quiet", *words) for _ in range(MANY)]]
        self.assertEqual(codes, [(0, [])] * MANY)
        self.assertEqual(self.found(), sorted([*before, *outputs.values()]))
        for mine, alone in (("same.log", "log"), ("same.pcapng", "c.pcapng"), ("same.vcd", "w.vcd"), ("same.trace", "trace")):
            with open(self.file(mine), "rb") as one, open(self.file(alone), "rb") as other:
                self.assertEqual(one.read(), other.read(), mine)
        with open(self.file("same.json"), encoding="utf-8") as file:
            self.assertTrue(json.load(file)["passed"])
        with open(self.file("same.html"), encoding="utf-8") as file:
            self.assertTrue(file.read().rstrip().endswith("</html>"))

    def test_one_sweep_or_regression_has_the_folder_and_the_others_say_so(self):
        for words in (["sweep", "short.yaml", "--param", "end=600us,700us", "--out", "out"], ["regress", "short.yaml", "other.yaml", "--out", "out"]):
            shutil.rmtree(self.file("out"), ignore_errors=True)
            ended = [self.end(process) for process in [self.start(*words, "--jobs", "1") for _ in range(max(4, MANY // 5))]]
            codes = collections.Counter(code for code, _ in ended)
            self.assertGreaterEqual(codes[0], 1)
            self.assertEqual(set(codes) - {0, 2}, set())
            for code, lines in ended:
                if code == 2:
                    self.assertRegex("\n".join(lines), r"^out: a (sweep|regression) (with process id \d+ )?is using it, expected one \w+ at a time$")
            self.assertFalse([name for name in self.found("out") if "PID" in name or "lock" in name])


class Regression(Folder):
    WORDS = ("regress", "short.yaml", "other.yaml", "--out", "out", "--jobs", "1")
    WHOLE = ["index.html", "regression.json", "runs/other.skip.pins.json", "runs/short.skip.pins.json"]

    def assert_the_same_command_goes_on(self):
        self.assertEqual(self.do(*self.WORDS)[0], 0)
        self.assertEqual(self.found("out"), self.WHOLE)

    def test_a_full_disk_is_one_line_and_no_half_file(self):
        for bytes_, left in ((0, []), (700, None), (2500, None)):
            with self.subTest(bytes_):
                shutil.rmtree(self.file("out"), ignore_errors=True)
                code, lines = self.do(*self.WORDS, faults="fsize=%d" % bytes_)
                self.assertEqual(code, 2)
                self.assertRegex("\n".join(lines), r"^.*cannot be written: File too large(; \d of 2 runs are kept)?$")
                self.assertFalse([name for name in self.found("out") if name.endswith(".part")])
                self.assertNotIn("index.html", self.found("out"))
                self.assertEqual(self.found("out") if left is not None else None, left)
                self.assert_the_same_command_goes_on()

    def test_a_folder_that_cannot_be_written_or_is_no_folder(self):
        os.mkdir(self.file("out"))
        os.chmod(self.file("out"), 0o500)
        code, lines = self.do(*self.WORDS, faults="user")
        self.assertEqual((code, lines), (2, ["out: cannot be used for a regression: Permission denied"]))
        os.rmdir(self.file("out"))
        self.write("out", "words")
        code, lines = self.do(*self.WORDS)
        self.assertEqual((code, len(lines)), (2, 1), lines)
        with open(self.file("out"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "words")

    def in_its_second_run(self, end=LONG):
        self.write("other.yaml", SCENARIO % ("other", end))
        process = self.start(*self.WORDS)
        end = time.monotonic() + DEADLINE
        while not any(name.startswith("runs/other") and name.endswith(".part") for name in self.found("out") if os.path.isdir(self.file("out"))):
            self.assertLess(time.monotonic(), end, "the second run never began")
            time.sleep(0.01)  # polls; nothing depends on how long
        return process

    def test_signals_keep_what_is_done(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(number):
                shutil.rmtree(self.file("out"), ignore_errors=True)
                process = self.in_its_second_run()
                process.send_signal(number)
                code, lines = self.end(process)
                self.assertEqual(code, 130)
                self.assertRegex(lines[-1], "^regression: interrupted, [01] of 2 runs are kept; the same command resumes from there$")
                self.assertFalse([name for name in self.found("out") if "PID" in name])
        self.write("other.yaml", SCENARIO % ("other", "3ms"))
        self.assert_the_same_command_goes_on()

    def test_killed_it_leaves_no_half_file_under_its_name(self):
        process = self.in_its_second_run()
        process.kill()
        process.communicate()
        self.assertNotIn("index.html", self.found("out"))
        self.assertNotIn("runs/other.skip.pins.json", self.found("out"))
        self.write("other.yaml", SCENARIO % ("other", "3ms"))
        self.assert_the_same_command_goes_on()

    def test_a_scenario_that_vanishes_meanwhile_is_named(self):
        process = self.in_its_second_run("500ms")
        os.remove(self.file("device.gsd"))
        code, lines = self.end(process)
        self.assertEqual((code, lines[-1]), (2, "device.gsd: was changed while the regression ran, expected the same content for all of its runs"))
        self.assertEqual(self.do(*self.WORDS)[0], 1)  # a refusal of a scenario is the result of its run
        self.assertIn("device.gsd: no such file", self.said)


class Goldens(Folder):
    WORDS = ("traces", "regenerate", "short.yaml", "--folder", "goldens")
    FILES = ("short.json", "short.trace.xz")

    def setUp(self):
        super().setUp()
        os.mkdir(self.file("goldens"))
        self.shorten("30us")
        self.assertEqual(self.do(*self.WORDS), (0, []))

    def shorten(self, end):
        self.write("short.yaml", SCENARIO % ("short", end) + "expect: [{slave: demo, dp_state: offline}]\n")

    def contents(self):
        self.assertEqual(self.found("goldens"), list(self.FILES))
        found = []
        for name in self.FILES:
            with open(self.file("goldens", name), "rb") as file:
                found.append(file.read())
        return found

    def test_on_a_full_disk_both_files_stay_as_they_are(self):
        before = self.contents()
        self.shorten("60us")
        self.assertEqual(self.do(*self.WORDS), (0, []))
        manifest, trace = self.contents()
        self.assertTrue(manifest != before[0] and trace != before[1])
        self.assertLess(len(trace), len(manifest))  # so that there is room for the trace alone, too
        for room in (0, len(trace) // 2, len(trace) - 1, len(trace), len(manifest) - 1):
            with self.subTest(room):
                for name, content in zip(self.FILES, before):
                    with open(self.file("goldens", name), "wb") as file:
                        file.write(content)
                code, lines = self.do(*self.WORDS, faults="fsize=%d" % room)
                does_not_fit = "short.trace.xz" if room < len(trace) else "short.json"
                self.assertEqual((code, lines), (2, ["goldens/%s: cannot be written: File too large" % does_not_fit]))
                self.assertEqual(self.contents(), before)
        self.assertEqual(self.do(*self.WORDS), (0, []))
        self.assertEqual(self.contents(), [manifest, trace])


COMMANDS = (["manual"], ["completion", "bash"], ["schema"], ["reasons"], ["gsd", "device.gsd"], ["decode", "log"], ["compare", "w.vcd", "w.vcd"],
            ["replay", "c.pcapng", "--as", "5", "--gsd", "device.gsd"], ["run", "short.yaml"], ["run", "--help"], ["--version"],
            ["regress", "short.yaml", "--out", "r"], ["sweep", "short.yaml", "--param", "end=600us", "--out", "s"])
# A file that the command reads, and the command
INPUTS = (["short.yaml", "run", "short.yaml"], ["device.gsd", "run", "short.yaml"], ["short.yaml", "serve", "short.yaml", "--for", "1ms"],
          ["device.gsd", "gsd", "device.gsd"], ["log", "decode", "log"], ["w.vcd", "compare", "w.vcd", "w.vcd"],
          ["c.pcapng", "replay", "c.pcapng", "--as", "5"], ["device.gsd", "replay", "c.pcapng", "--as", "5", "--gsd", "device.gsd"],
          ["w.vcd", "calibrate", "w.vcd"], ["w.vcd", "recover", "w.vcd"], ["log", "rtl-random", "--replay", "log"],
          ["short.yaml", "sweep", "short.yaml", "--param", "end=600us", "--out", "s"], ["device.gsd", "sweep", "short.yaml", "--param", "end=600us", "--out", "s"])


class AllCommands(Folder):
    def test_standard_output_that_is_full_or_closed_is_one_line_and_exit_2(self):
        for words in COMMANDS:
            with self.subTest(words), open("/dev/full", "wb") as full:
                for how, why in (({"stdout": full}, "No space left on device"), ({"faults": "closed"}, "Bad file descriptor")):
                    code, lines = self.do(*words, **how)
                    self.assertEqual((code, lines[-1]), (2, "dsdpv1-sim: standard output cannot be written: " + why))

    def test_a_reader_that_has_gone_ends_it_without_a_word(self):
        for words in COMMANDS:
            with self.subTest(words):
                here, there = os.pipe()
                os.close(here)
                process = self.start(*words, faults="nofile=256", stdout=there)
                os.close(there)
                code, lines = self.end(process)
                self.assertEqual(code, -signal.SIGPIPE)
                self.assertFalse([line for line in lines if "annot" in line], lines)

    def test_an_input_that_may_not_be_read_or_is_not_there_is_one_line_and_exit_2(self):
        for name, *words in INPUTS:
            for change in (lambda path: os.chmod(path, 0), os.remove):
                with self.subTest(words):
                    shutil.rmtree(self.file("s"), ignore_errors=True)
                    change(self.file(name))
                    code, lines = self.do(*words, faults="user")
                    self.assertEqual((code, len(lines)), (2, 1), lines)
                    self.assertIn(name, lines[0])
                shutil.copy(os.path.join(self.kept, name), self.path)

    def test_a_folder_that_is_gone_is_no_crash(self):
        os.mkdir(self.file("gone"))
        for words in (["run", self.file("short.yaml"), "--quiet", "--log", "l"], ["regress", self.file("short.yaml")],
                      ["sweep", self.file("short.yaml"), "--param", "end=600us"]):
            script = 'cd gone; rmdir ../gone; "$@"; code=$?; mkdir -p "$0"; exit $code'
            called = subprocess.run(["sh", "-c", script, self.file("gone"), self.program, *words], cwd=self.path, capture_output=True, text=True, check=False)
            self.assertEqual((called.returncode, called.stderr.count("\n")), (2, 1), called.stderr)


if __name__ == "__main__":
    Folder.program = os.path.abspath(sys.argv[1])
    rest = sys.argv[2:]
    if rest[:1] == ["--many"]:
        MANY = int(rest[1])
        rest = rest[2:]
    unittest.main(argv=[sys.argv[0], *rest])
