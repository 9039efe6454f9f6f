#!/usr/bin/env python3
"""Refusals of --save-at and --restore: one line, exit 2, and no file. And the files that a saved run no longer needs.

usage: refused_test.py DSDPV1_SIM [--firmware ELF]"""
import argparse
import pathlib
import shutil
import tempfile

import runs

SCENARIO = """name: Saved
baud: 12M
end: 3ms
slaves:
  - {name: demo, address: 5, gsd: a.gsd, modules: ["8 bytes in and out"], user_cpu: {cycle: 100us}}
masters:
  - {name: plc, address: 2, slaves: [{slave: demo}]}
"""


class Refusals:
    def __init__(self, program, folder):
        self.program, self.folder, self.failures = program, folder, []
        shutil.copy(runs.PROJECT / "scenarios" / "dsdpv1.gsd", folder / "a.gsd")
        module = next(line.split('"')[1] for line in (folder / "a.gsd").read_text(encoding="latin-1").splitlines() if line.startswith("Module ="))
        self.scenario = SCENARIO.replace("8 bytes in and out", module)
        (folder / "s.yaml").write_text(self.scenario, encoding="utf-8")
        self.run("s.yaml", "--save-at", "1ms", "a.run", status=0)
        self.saved = (folder / "a.run").read_bytes()

    def run(self, *arguments, status=2, line="", **more):
        done = runs.call(self.program, *arguments, folder=self.folder, **more)
        lines = done.stderr.splitlines()
        if done.returncode != status or (status == 2 and (len(lines) != 1 or line not in lines[0])):
            self.failures.append(f"{arguments}: exit {done.returncode}, {done.stderr or 'nothing said'}")

    def restore(self, content, **more):
        (self.folder / "b.run").write_bytes(content)
        self.run("--restore", "b.run", "--log", "rest.log", **more)
        if (self.folder / "rest.log").exists():
            self.failures.append("a refused run has left a log")

    def damaged(self):
        flipped = bytearray(self.saved)
        flipped[len(flipped) // 2] ^= 1
        self.restore(bytes(flipped), line="b.run: is damaged")
        self.restore(self.saved[:-1], line="b.run: is damaged")
        self.restore(b"", line="b.run: is no saved run")
        self.restore(self.scenario.encode(), line="b.run: is no saved run")
        self.restore(self.saved.replace(b"saved run 2 ", b"saved run 1 ", 1), line="b.run: is a saved run of another version")
        self.run("--restore", "none.run", line="none.run: no such file")

    def changed(self, name, text):
        path = self.folder / name
        before = path.read_bytes()
        path.write_bytes(before + text)
        self.restore(self.saved, line=f"{name}: has changed since b.run was saved")
        path.write_bytes(before)

    def another_run(self):
        """The file is intact, but its contents do not match the program's run."""
        digest = self.saved.index(b"digest")
        object_at = self.saved.index(b"\n") + 1
        content = bytearray(self.saved[object_at:])
        content[digest - object_at + len("digest") + 4] ^= 1  # a byte of the number after its key
        self.restore(b"DSDPV1 saved run 2 " + fingerprint(content) + b"\n" + bytes(content), line="b.run: the run up to 1ms is not the one that was saved")

    def command_lines(self):
        self.run("s.yaml", "--save-at", "4ms", "c.run", line="--save-at is 4ms, expected a time up to the end of the run, 3ms")
        self.run("s.yaml", "--save-at", "soon", "c.run", line="--save-at is soon, expected")
        self.run("s.yaml", "--save-at", "1ms", "s.yaml", line="would replace the scenario")
        self.run("--restore", "a.run", "--save-at", "2ms", "a.run", line="would replace the saved run")
        self.run("s.yaml", "--restore", "a.run", line="excludes")
        self.run("--restore", "a.run", "--set", "end=2ms", line="excludes")
        self.run(line="a scenario is missing (dsdpv1-sim run FILE.yaml, or --restore FILE)")

    def full_disk(self):
        self.run("s.yaml", "--save-at", "1ms", "d.run", "--log", "d.log", line="d.run: cannot be written", limit=4096)
        for name in ("d.run", "d.log"):
            if (self.folder / name).exists():
                self.failures.append(f"{name} is there, though it could not be written")

    def what_is_not_needed(self):
        """The saved run contains the scenario and its files; a run saved from a restored one is equivalent."""
        for name in ("s.yaml", "a.gsd"):
            (self.folder / name).unlink()
        self.run("--restore", "a.run", "--save-at", "2ms", "e.run", status=0)
        self.run("--restore", "e.run", status=0)

    def firmware(self, elf):
        shutil.copy(elf, self.folder / "f.elf")
        self.run(runs.PROJECT / "scenarios" / "arm_board_12m.yaml", "--set", "user_cpu.elf=f.elf", "--save-at", "1ms", "f.run", status=0)
        with (self.folder / "f.elf").open("ab") as file:
            file.write(b"x")
        self.run("--restore", "f.run", line="f.elf: has changed since f.run was saved")
        (self.folder / "f.elf").unlink()
        self.run("--restore", "f.run", status=0)


def fingerprint(content):
    """FNV-1a, 64 bits."""
    value = 0xCBF29CE484222325
    for byte in content:
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return f"{value:016x}".encode()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--firmware")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        refusals = Refusals(arguments.program, pathlib.Path(name))
        refusals.damaged()
        refusals.changed("s.yaml", b"\n")
        refusals.changed("a.gsd", b"\n")
        refusals.another_run()
        refusals.command_lines()
        refusals.full_disk()
        if arguments.firmware:
            refusals.firmware(arguments.firmware)
        refusals.what_is_not_needed()
        return runs.report(refusals.failures)


if __name__ == "__main__":
    raise SystemExit(main())
