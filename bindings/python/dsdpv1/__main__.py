# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""python -m dsdpv1 demo: power-on to data exchange at 12 Mbit/s, from the data of this package."""
import argparse
import json
import pathlib
import sys
import typing

from . import Error, run

_SCENARIO = pathlib.Path(__file__).parent / "demo" / "power_on_12m.yaml"


class _Parser(argparse.ArgumentParser):
    """The error in one line."""

    def error(self, message: str) -> typing.NoReturn:
        self.exit(2, f"{self.prog}: {message}\n")


def _demo(out: pathlib.Path) -> int:
    """As `dsdpv1-sim demo`: the files of the same names, the same tables."""
    out.mkdir(parents=True, exist_ok=True)
    wave, log, result = (out / f"{_SCENARIO.stem}{ending}" for ending in (".vcd", ".log", ".json"))
    done = run(_SCENARIO, wave=wave, log=log)
    result.write_text(json.dumps(done.data, indent=2) + "\n", encoding="utf-8")
    print(f"{done.report}\nWaves   {wave.absolute()}\nLog     {log.absolute()}\nResult  {result.absolute()}")
    return done.exit_code


def main() -> int:
    """Returns the exit code: that of the run, 2 for what is wrong with the call."""
    parser = _Parser(prog="python -m dsdpv1", description="The DSDPV1, a PROFIBUS-DP slave ASIC, cycle by cycle. `import dsdpv1` has the rest.")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")
    demo = commands.add_parser("demo", help="power-on to data exchange at 12 Mbit/s: a table, a wave, a log")
    demo.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out"),
                      help="folder for wave, log and result, which replace those of an earlier demo (default: out)")
    given = parser.parse_args()
    if given.command is None:
        parser.print_help(sys.stderr)
        return 2
    try:
        return _demo(given.out)
    except OSError as error:
        print(f"{parser.prog} demo: {error.filename}: {error.strerror}, expected a folder that can be written: --out FOLDER", file=sys.stderr)
    except Error as error:
        print(error, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
