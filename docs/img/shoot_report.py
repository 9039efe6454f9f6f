#!/usr/bin/env python3
"""Takes docs/img/report.png and docs/img/report_write.png: what a reader sees first of the demo's report, and one of its timing diagrams.

    docs/img/shoot_report.py DSDPV1_SIM      needs Chromium and its driver (./run deps browser)
"""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/report"))

from browser import browser  # noqa: E402


def main(program):
    with tempfile.TemporaryDirectory() as folder, browser(size=(1200, 900)) as page:
        report = pathlib.Path(folder, "report.html")
        subprocess.run([program, "run", "scenarios/power_on_12m.yaml", "-q", "--no-progress", "--report", report], cwd=ROOT, check=True)
        page.open(report)
        page.picture(ROOT / "docs/img/report.png")
        page.picture(ROOT / "docs/img/report_write.png", "figure.diagram[data-id=write] .chart")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve())
