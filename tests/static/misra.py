"""The C drivers under the required and mandatory rules of MISRA C:2012 that cppcheck's addon knows: misra_deviations.txt explains each report.

The numbers of the rules and their categories are facts of the standard; its texts may not be copied, so none is here.
"""
import dataclasses
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEVIATIONS = pathlib.Path(__file__).with_name("misra_deviations.txt")
# Rules of the addon of cppcheck 2.10 that are advisory; all others are required or mandatory.
ADVISORY = {"1.2", "2.3", "2.4", "2.5", "2.6", "2.7", "4.2", "5.9", "8.7", "8.9", "8.11", "8.13", "10.5", "11.4", "11.5", "12.1", "12.3", "12.4", "13.3",
            "13.4", "15.1", "15.4", "15.5", "17.5", "17.8", "18.4", "18.5", "19.2", "20.1", "20.5", "20.10", "21.12"}
REPORT = re.compile(r"^\[(?P<file>[^]:]+):(?P<line>\d+)\].*\[misra-c2012-(?P<rule>[\d.]+)\]$", re.M)


@dataclasses.dataclass(frozen=True)
class Report:
    rule: str
    file: str
    line: int
    text: str  # of the source


@dataclasses.dataclass
class Deviation:
    rule: str
    file: str  # or *
    part: str  # of the source line, or *
    why: str
    places: int = 0

    def fits(self, report):
        return self.rule == report.rule and self.file in ("*", report.file) and (self.part == "*" or self.part in report.text)


def reports_in(said, root=ROOT):
    found = set()
    for each in REPORT.finditer(said):
        text = (root / each["file"]).read_text(encoding="utf-8").split("\n")[int(each["line"]) - 1]
        found.add(Report(each["rule"], each["file"], int(each["line"]), text.strip()))
    return sorted(found, key=lambda report: (report.file, report.line, report.rule))


def deviations(text):
    """Rule | file | part of the line | reason; * is any."""
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        if line and not line.startswith("#"):
            fields = [field.strip() for field in line.split(" | ")]
            if len(fields) != 4:
                raise ValueError(f"{DEVIATIONS.name}:{number}: has {len(fields)} fields, expected rule | file | part of the line | why")
            found.append(Deviation(*fields))
    return found


def judge(reports, explained):
    """Lines about unexplained reports, and about explanations without a report; counts the places of each deviation."""
    for report in reports:
        if report.rule in ADVISORY:
            continue
        first = next((each for each in explained if each.fits(report)), None)
        if first:
            first.places += 1
        else:
            yield f"{report.file}:{report.line}: rule {report.rule} of MISRA C:2012, and {DEVIATIONS.name} does not say why: {report.text}"
    for each in explained:
        if not each.places:
            yield f"{DEVIATIONS.name}: rule {each.rule} for {each.file}, {each.part} explains nothing (any more)"


def addon():
    """Debian's path; cppcheck itself finds it without help."""
    return next(pathlib.Path("/usr/lib").glob("*/cppcheck/addons/misra.py"))


def told(folder, *words):
    result = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    return result.stdout + result.stderr


def cppcheck():
    """The addon's reports on the drivers, for an int of 32 bits: on each file, and on all together. Only a call by cppcheck itself checks all
    together, but passes on only one of several reports about a line."""
    options = ("cppcheck", "--std=c99", "--platform=unix32", "--quiet", "-I.")
    with tempfile.TemporaryDirectory() as folder:
        for part in ("driver", "registers"):
            shutil.copytree(ROOT / part, pathlib.Path(folder, part), ignore=shutil.ignore_patterns("*.py", "systemc"))
        sources = [source.relative_to(ROOT).as_posix() for folder in ("driver", "driver/spc3", "driver/xgate") for source in sorted((ROOT / folder).glob("*.c"))]
        told(folder, *options, "--dump", *sources)
        alone = told(folder, sys.executable, str(addon()), "--no-summary", *(f"{source}.dump" for source in sources))
        return alone + told(folder, *options, "--addon=misra", "--enable=style", "--template=[{file}:{line}] [{id}]", *sources)


def check():
    """Reports, deviations with their places, and faults."""
    reports = reports_in(cppcheck())
    explained = deviations(DEVIATIONS.read_text(encoding="utf-8"))
    faults = list(judge(reports, explained))
    if not any(report.rule in ADVISORY for report in reports):
        faults.append("cppcheck reports nothing at all: that is not the driver, or not the addon")
    return reports, explained, faults
