#!/usr/bin/env python3
"""./run test with a made-up CMake and ctest: its end, by Ctrl-C or by a kill, also ends the build of the preset debug, which runs beside the
tests. It succeeds if all tests pass, and fails if one fails.

    test_command_test.py ROOT
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

WAITING = """#!/bin/sh
case "$(basename "$0") $*" in
  "cmake --build"*/build/debug*) what=building ;;
  ctest*) what=tests ;;
  *) exit 0 ;;
esac
echo $$ >"{folder}/$what.new" && mv "{folder}/$what.new" "{folder}/$what"
exec sleep 300
"""

# Writes the requested report.
ENDING = """#!/bin/sh
for last; do :; done
case "$last" in
  *.xml) printf '<testsuite\\n\\ttests="2"\\n\\tfailures="{failures}"\\n\\tskipped="0"\\n>' >"$last" ;;
esac
"""


def project(root, folder, tools):
    """A folder in which ./run has nothing to install or configure, and the steps after the tests print nothing."""
    for name in ("run", "packages.txt", "requirements.lock", "requirements-test.lock"):
        shutil.copy(root / name, folder / name)
    (folder / ".venv/bin").mkdir(parents=True)
    (folder / ".venv/bin/python").symlink_to(sys.executable)
    for name in ("requirements.lock", "requirements-test.lock"):
        shutil.copy(root / name, folder / ".venv" / name)
    (folder / "CMakePresets.json").write_text("{}", encoding="utf-8")
    for preset in ("default", "debug"):
        (folder / "build" / preset).mkdir(parents=True)
        (folder / "build" / preset / "build.ninja").touch()
    for after in ("docs/conformance/generate.py", "cmake/failures.py", "cmake/longest.py"):
        (folder / after).parent.mkdir(parents=True, exist_ok=True)
        (folder / after).touch()
    (folder / "tools").mkdir()
    for name in ("cmake", "ctest"):
        tool = folder / "tools" / name
        tool.write_text(tools, encoding="utf-8")
        tool.chmod(0o755)


def environment(folder):
    return {**os.environ, "PATH": f"{folder}/tools:{os.environ['PATH']}"}


def until(condition, what):
    end = time.monotonic() + 300
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.02)


def goes_on(process):
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return pathlib.Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] != "Z"


def ends_with(root, end):
    """Calls `end` with the process."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        project(root, folder, WAITING.format(folder=folder))
        run = subprocess.Popen([folder / "run", "test"], env=environment(folder), start_new_session=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        started = [folder / "building", folder / "tests"]
        try:
            until(lambda: all(path.exists() for path in started), "./run test has not begun")
            build = int(started[0].read_text(encoding="utf-8"))
            end(run.pid)
            assert run.wait(120) != 0
            until(lambda: not goes_on(build), "the build of the preset debug goes on")
        finally:
            run.kill()
            for path in started:
                if path.exists() and goes_on(int(path.read_text(encoding="utf-8"))):
                    os.kill(int(path.read_text(encoding="utf-8")), signal.SIGKILL)


def tests_that_end(root, failures):
    """The output of ./run test and its exit code, with these numbers of failing tests per preset."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        project(root, folder, ENDING.format(failures=failures))
        run = subprocess.run([folder / "run", "test"], env=environment(folder), capture_output=True, text=True, timeout=300, check=False)
        return run.returncode, run.stdout, run.stderr


def main(root):
    assert tests_that_end(root, 0) == (0, "4 passed, 0 failed\n", ""), tests_that_end(root, 0)
    assert tests_that_end(root, 1) == (1, "2 passed, 2 failed\n", ""), tests_that_end(root, 1)
    ends_with(root, lambda process: os.killpg(process, signal.SIGINT))
    ends_with(root, lambda process: os.kill(process, signal.SIGTERM))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
