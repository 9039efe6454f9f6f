#!/usr/bin/env python3
"""run --rewind-on: its wave equals that of an unbroken run with the same window, early in a run and after many snapshots; exit codes, outputs and
processes are the same as without.

usage: rewind_test.py DSDPV1_SIM [--firmware ELF]"""
import argparse
import filecmp
import pathlib
import re
import signal
import subprocess
import tempfile
import time

import runs

# A collision after some seconds of real time: snapshots exist by then.
LATE = """name: A late collision
baud: 12M
end: 500ms
slaves:
  - {name: demo, address: 5, init: {ident: 1, max_inputs: 8, max_outputs: 8, cfg: "37"}, user_cpu: {cycle: 40us}}
masters:
  - {name: plc, address: 2, slaves: [{slave: demo}]}
script:
  - {at: 450ms, do: early_r_sta, slave: demo, times: 200}
"""


def processes(group):
    """The existing processes of a group."""
    listed = subprocess.run(["ps", "-eo", "pgid=,stat=,pid="], capture_output=True, text=True, check=True).stdout
    return [line for line in listed.splitlines() if line.split()[0] == str(group) and "Z" not in line.split()[1]]


class Rewinds:
    def __init__(self, program, folder):
        self.program, self.folder, self.failures = program, folder, []

    def fail(self, what):
        self.failures.append(what)

    def window(self, scenario, code, around="100us", options=()):
        wave, log = self.folder / "rewound.vcd", self.folder / "rewound.log"
        plain = self.folder / "plain.log"
        usual = runs.call(self.program, scenario, "--log", plain, *options)
        done = subprocess.run([self.program, "run", scenario, "--no-progress", "--wave", wave, "--rewind-on", code, around, "--log", log, *options],
                              cwd=runs.PROJECT, capture_output=True, text=True, check=False)
        told = re.search(r"^rewound .* at ([\d.]+) ns at", done.stdout, re.MULTILINE)
        if done.returncode != usual.returncode or not told:
            return self.fail(f"{scenario}: exit {done.returncode}, {usual.returncode} without --rewind-on: {done.stdout[-200:]} {done.stderr}")
        if not filecmp.cmp(log, plain, shallow=False):
            self.fail(f"{scenario}: another log")
        at = round(float(told.group(1)) * runs.TICKS_PER_NS)
        span = round(float(around.removesuffix("us")) * 1000 * runs.TICKS_PER_NS)
        unbroken = self.folder / "unbroken.vcd"
        first, last = (f"{tick / runs.TICKS_PER_NS:.4f}ns" for tick in (max(at - span, 0), at + span))
        runs.call(self.program, scenario, "--wave", unbroken, "--wave-from", first, "--wave-to", last, *options)
        if not filecmp.cmp(wave, unbroken, shallow=False):
            self.fail(f"{scenario}: another wave round {code}")
        return None

    def nothing_happens(self):
        wave = self.folder / "none.vcd"
        done = runs.call(self.program, "scenarios/two_slaves.yaml", "--wave", wave, "--rewind-on", "violation", "100us")
        if done.returncode != 0 or wave.exists():
            self.fail(f"nothing happens: exit {done.returncode}, {done.stderr}")

    def no_room(self, late):
        done = runs.call(self.program, "scenarios/violations.yaml", "--wave", self.folder / "full.vcd", "--rewind-on", "violation", "5000us",
                         "--log", self.folder / "full.log", limit=65536)
        left = [path.name for path in self.folder.iterdir() if path.name.startswith("full")]
        if done.returncode != 2 or left or len(done.stderr.splitlines()) != 1:
            self.fail(f"full disk: exit {done.returncode}, {left}, {done.stderr}")
        for arguments in (("--engine", "rtl"), ("--view", "tlm"), ("--wave-on", "violation")):
            done = runs.call(self.program, late, "--wave", self.folder / "x.vcd", "--rewind-on", "violation", "100us", *arguments)
            if done.returncode != 2 or len(done.stderr.splitlines()) != 1:
                self.fail(f"{arguments}: exit {done.returncode}, {done.stderr}")

    def killed(self, late, with_signal, status):
        """No copy of the process outlives it, whatever its end."""
        run = subprocess.Popen([self.program, "run", late, "--no-progress", "--quiet", "--wave", self.folder / "k.vcd", "--rewind-on", "BUS_COLLISION", "100us"],
                               cwd=self.folder, start_new_session=True)
        while len(processes(run.pid)) < 2 and run.poll() is None:
            time.sleep(0.01)
        if run.poll() is not None:
            return self.fail("there was no snapshot")
        run.send_signal(with_signal)
        if run.wait() != status:
            self.fail(f"{with_signal.name}: exit {run.returncode}")
        deadline = time.monotonic() + 300
        while processes(run.pid) and time.monotonic() < deadline:
            time.sleep(0.01)
        if left := processes(run.pid):
            self.fail(f"{with_signal.name}: {left} are left")
        return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--firmware")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        late = folder / "late.yaml"
        late.write_text(LATE, encoding="utf-8")
        rewinds = Rewinds(arguments.program, folder)
        rewinds.window("scenarios/violations.yaml", "violation")
        rewinds.window("scenarios/violations.yaml", "OWNERSHIP_BOTH_OWN", "300us", ("--engine", "step"))
        rewinds.window(str(late), "violation")
        if arguments.firmware:
            rewinds.window("scenarios/arm_board_12m.yaml", "CFG_TO_USER", "200us")
        rewinds.nothing_happens()
        rewinds.no_room(late)
        rewinds.killed(late, signal.SIGKILL, -signal.SIGKILL)
        rewinds.killed(late, signal.SIGTERM, 130)
        return runs.report(rewinds.failures)


if __name__ == "__main__":
    raise SystemExit(main())
