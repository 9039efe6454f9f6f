"""Compares the outputs on a page with those of dsdpv1-sim: for a page's test, `docs_example.py SIM [--write]`."""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def check(page, mark, prepare, command=()):
    """Each block of the page after <!-- mark: ARGUMENTS --> has to be what `SIM command ARGUMENTS` prints in a folder that
    prepare(sim, folder) has filled; --write makes it so."""
    sim, write = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:] == ["--write"]
    path = ROOT / page
    block = re.compile(r"(<!-- %s: ([^\n]*) -->\n```\n)(.*?)(```)" % mark, re.S)
    with tempfile.TemporaryDirectory(prefix=f"dsdpv1_{mark}_page_") as name:
        folder = pathlib.Path(name)
        prepare(sim, folder)

        def real(shown):
            done = subprocess.run([sim, *command, *shown.group(2).split()], cwd=folder, capture_output=True, text=True, check=False)
            return shown.group(1) + done.stdout + done.stderr + shown.group(4)

        text = path.read_text(encoding="utf-8")
        right = block.sub(real, text)
    if write:
        path.write_text(right, encoding="utf-8")
    elif right != text:
        sys.exit(f"{page} shows something else than\n{right}")
