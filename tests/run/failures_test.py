#!/usr/bin/env python3
"""./run test ends with its longest tests, the names of the failed ones and their output; with made-up reports."""
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.sax.saxutils import escape

CMAKE = Path(__file__).resolve().parents[2] / "cmake"
PASSED, FAILED, SKIPPED = '', '<failure message=""/>', '<skipped message="SKIP_RETURN_CODE=77"/>'


def lines(first, last):
    return "".join(f"line {number}\n" for number in range(first, last + 1))


def case(name, result=FAILED, said=""):
    return f'<testcase name="{name}" time="2.5">{result}<system-out>{escape(said)}</system-out></testcase>'


def told(script="failures", **reports):
    """A script's output for these presets."""
    with tempfile.TemporaryDirectory(prefix="dsdpv1_failures_") as name:
        folders = [Path(name, preset) for preset in (*reports, "without_a_report")]
        for folder in folders:
            folder.mkdir()
        for folder, cases in zip(folders, reports.values()):
            folder.joinpath("tests.xml").write_text(f"<testsuite>{''.join(cases)}</testsuite>", encoding="utf-8")
        return subprocess.run([sys.executable, CMAKE / f"{script}.py", *folders], capture_output=True, text=True, check=True).stdout


def expect(name, got, wanted):
    if got != wanted:
        sys.exit(f"{name}: wanted\n{wanted}\ngot\n{got}")


expect("all passed", told(default=[case("A.Good", PASSED, "error")], debug=[]), "")

both = told(default=[case("A.Good", PASSED), case("A.Bad", said="1 < 2 & 3\n")], debug=[case("A.Skipped", SKIPPED)])
expect("names of every preset", both, """
--- A.Bad (default, 2 s) failed
1 < 2 & 3

--- A.Skipped (debug, 2 s) skipped: SKIP_RETURN_CODE=77

Did not pass:
  A.Bad (default, 2 s) failed
  A.Skipped (debug, 2 s) skipped: SKIP_RETURN_CODE=77
""")

failure = "a.cpp:1: Failure\n" + lines(1, 30)
for what, said, shown in (("the last lines", lines(1, 100), lines(86, 100)),
                          ("from the failure on", lines(1, 60) + failure, failure),
                          ("of much, the end", "Failure\n" * 99, "Failure\n" * 60),
                          ("long lines, their beginning", "x" * 1000, "x" * 300 + "\n")):
    name = "A (default, 2 s) failed"
    expect(what, told(default=[case("A", said=said)]), f"\n--- {name}\n{shown}\nDid not pass:\n  {name}\n")

many = told(default=[case(f"Many.{number}", said="said\n") for number in range(25)])
expect("outputs of many", many.count("said"), 10)
expect("names of many", [many.count(f"  Many.{number} ") for number in range(25)], [1] * 25)
print("0 failures")

expect("the longest of all presets", told("longest", default=[case("A.Short").replace("2.5", "0.1"), case("A.Long")], debug=[case("A.Longer").replace("2.5", "62")]),
       "\nLongest tests:\n  62.0 s  debug  A.Longer\n   2.5 s  default  A.Long\n   0.1 s  default  A.Short\n\n")
expect("25 of them", told("longest", default=[case(f"Many.{number}") for number in range(30)]).count("Many."), 25)
