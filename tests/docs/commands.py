#!/usr/bin/env python3
"""Types in what a page tells its reader to type, and compares what it shows.

    commands.py PAGE BUILD
    commands.py --files FOLDER PAGE

All ```sh blocks of the page are one session of bash: in an empty folder for docs/tutorials/, else in the project's folder. A block in another language whose first line
is a comment that begins with the name of a file is this file, several blocks are its parts; a page with files has an empty folder, too, with these files. --files writes them into FOLDER. Each block has to
end with 0, or with the N of <!-- exit N --> before it; the first command of a block that fails ends it. A ```text block that follows is what it
prints, "..." standing for anything. The project is in ~/dsdpv1: the sources, the real ./run, and BUILD as build/default; nothing is built or installed.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:^<!-- exit (\d+) -->\n)?^```sh\n(.*?)^```\n(?:\s*^```text\n(.*?)^```$)?", re.M | re.S)
FILE = re.compile(r"^```\w+\n((?:/\*|//|#) ([\w.]+): .*?)^```$", re.M | re.S)
NOT_SHARED = {"build", "out", "run", "packages.txt", ".git"}
# A block that takes longer hangs, regardless of the times on a page.
DEADLINE = 900


class Block:
    def __init__(self, page, found):
        self.line = page.count("\n", 0, found.start(2))
        self.status = int(found.group(1) or 0)
        self.commands = found.group(2)
        self.shown = found.group(3)

    def wrong(self, status, printed):
        """Words, or None."""
        if status != self.status:
            return f"ends with {status}, not {self.status}"
        return None if self.shown is None or shows(self.shown, printed) else f"does not print what the page shows:\n{self.shown}but"


def blocks(page):
    return [Block(page, found) for found in BLOCK.finditer(page)]


def files(page):
    """Text by name; several blocks of one file are its parts."""
    parts = {}
    for found in FILE.finditer(page):
        parts.setdefault(found.group(2), []).append(found.group(1))
    return {name: "\n".join(texts) for name, texts in parts.items()}


def write_files(page, folder):
    for name, text in files(page).items():
        (folder / name).write_text(text, encoding="utf-8")


def shows(shown, printed):
    """A line "..." is any lines, "..." in a line any characters of it."""
    pattern = ""
    for line in shown.splitlines():
        pattern += r"(?:.*\n)*" if line.strip() == "..." else re.escape(line.rstrip()).replace(re.escape("..."), ".*") + r"[ \t]*\n"
    return re.fullmatch(r"\s*" + pattern + r"\s*", printed) is not None


def script(all_blocks, results):
    """Each block leaves its output and, when it has come to its end, its status."""
    text = "set -m\ntrap 'kill $(jobs -p) 2>/dev/null; wait' EXIT\n"
    for number, block in enumerate(all_blocks):
        text += f"set {'+' if block.status else '-'}e\n{{\n{block.commands}}} >{results}/{number}.out 2>&1\necho $? >{results}/{number}.status\n"
    return text


def project(home, build):
    """~/dsdpv1, and a cmake that has nothing to do there."""
    tree, tools = home / "dsdpv1", home / "tools"
    (tree / "build/default").mkdir(parents=True)
    tools.mkdir()
    for each in ROOT.iterdir():
        if each.name not in NOT_SHARED:
            (tree / each.name).symlink_to(each)
    for each in build.iterdir():
        (tree / "build/default" / each.name).symlink_to(each)
    (tree / "build/default/build.ninja").unlink(missing_ok=True)
    (tree / "build/default/build.ninja").write_text("build dsdpv1_firmware: phony\n", encoding="utf-8")
    groups = re.findall(r"^\[\w+\]\n", (ROOT / "packages.txt").read_text(encoding="utf-8"), re.M)  # all there, and empty
    (tree / "packages.txt").write_text("".join(groups), encoding="utf-8")
    shutil.copy(ROOT / "run", tree / "run")
    cmake = tools / "cmake"
    cmake.write_text(f'#!/bin/sh\ncase "$*" in --preset* | "--build {tree}/build/default "*) exit 0 ;; esac\nexec {shutil.which("cmake")} "$@"\n', encoding="utf-8")
    cmake.chmod(0o755)
    return tree


def without_network(build):
    """Variables with which pip in a fresh venv finds what it needs in .venv, and the wheel takes the library of BUILD."""
    packages = next((ROOT / ".venv/lib").glob("python3*/site-packages"), None)
    if packages is None:
        return {}
    return {"PYTHONPATH": str(packages), "PIP_NO_INDEX": "1", "PIP_NO_BUILD_ISOLATION": "false", "PIP_DISABLE_PIP_VERSION_CHECK": "1",
            "SKBUILD_CMAKE_DEFINE": f"DSDPV1_BUILD={build}"}


def session(page, build):
    """Words, status and output of each block, up to the first that is wrong."""
    text = page.read_text(encoding="utf-8")
    all_blocks = blocks(text)
    with tempfile.TemporaryDirectory(prefix="dsdpv1_page_") as name:
        home = pathlib.Path(name)
        tree, work, results = project(home, build), home / "work", home / "results"
        work.mkdir(), results.mkdir()
        write_files(text, work)
        environment = {**os.environ, "HOME": name, "PATH": f"{home}/tools:/usr/bin:/bin:{os.environ['PATH']}", "NO_COLOR": "1", **without_network(build)}
        environment.setdefault("CCACHE_DIR", os.path.expanduser("~/.cache/ccache"))
        subprocess.run(["bash", "-c", script(all_blocks, results)], cwd=work if page.parent.name == "tutorials" or files(text) else tree, env=environment,
                       stdin=subprocess.DEVNULL, check=False, timeout=DEADLINE)
        for number, block in enumerate(all_blocks):
            printed = (results / f"{number}.out").read_text(encoding="utf-8")
            ended = results / f"{number}.status"
            wrong = block.wrong(int(ended.read_text(encoding="utf-8")), printed) if ended.exists() else "ends before its last command"
            if wrong:
                return f"{page}:{block.line + 1}: {block.commands.strip()}\n{wrong}\n{printed}"
    return "" if all_blocks else f"{page}:1: there is no block with commands (```sh)"


def main():
    if sys.argv[1] == "--files":
        write_files(pathlib.Path(sys.argv[3]).read_text(encoding="utf-8"), pathlib.Path(sys.argv[2]))
        return
    wrong = session(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
    if wrong:
        sys.exit(wrong)
    print("all commands do what the page says")


if __name__ == "__main__":
    main()
