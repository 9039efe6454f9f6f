#!/usr/bin/env python3
"""The worked example of docs/cosim.md is run: what the document shows is what dsdpv1-sim prints.

    docs_example.py SIM
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHOWN = re.compile(r"<!-- own_rtl: (\d) -->\n```\n(.*?)```", re.S)
PARAMETERS = {"1": "", "2": "parameters: {RESET_VALUE: 1}\n"}


def printed(sim, parameters):
    with tempfile.TemporaryDirectory() as folder:
        pins = pathlib.Path(folder, "pins.yaml")
        pins.write_text((ROOT / "examples/own_rtl/pins.yaml").read_text(encoding="utf-8") + parameters, encoding="utf-8")
        command = [sim, "cosim", "--rtl", ROOT / "examples/own_rtl", "--top", "board_chip", "--pins", pins, "--build",
                   pathlib.Path(folder, "build"), ROOT / "scenarios/two_slaves.yaml"]
        return subprocess.run(command, cwd=folder, text=True, capture_output=True, check=False).stdout


def main():
    shown = dict(SHOWN.findall((ROOT / "docs/cosim.md").read_text(encoding="utf-8")))
    status = 0 if shown.keys() == PARAMETERS.keys() else 1
    for number, text in shown.items():
        real = printed(sys.argv[1], PARAMETERS[number])
        if real != text:
            print(f"docs/cosim.md, own_rtl {number} shows\n{text}but it is\n{real}")
            status = 1
    return status


sys.exit(main())
