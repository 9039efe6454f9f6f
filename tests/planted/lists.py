"""The lists of faults: read, and compared with the sources that they change."""
import dataclasses
import pathlib
import re

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = pathlib.Path(__file__).resolve().parent
NAMES = ("model", "systemc", "driver", "checks", "board")
RULING_PAGES = ("docs/chip.md", "docs/chip_rsu.md")
KEYS = {"name", "block", "file", "replace", "by", "what", "rule"}
NEEDED = {"name", "file", "replace", "by", "what"}


class BadList(Exception):
    """One line: file, line, error, allowed values."""


@dataclasses.dataclass(frozen=True)
class Fault:
    list: str
    name: str
    file: str     # the source, relative to the project's folder
    replace: str  # occurs in it once
    by: str
    what: str     # the resulting error
    where: str    # file and line of the list
    block: str = ""
    rule: str = ""

    def planted(self, root=ROOT):
        """The source with the fault."""
        return (root / self.file).read_text(encoding="utf-8").replace(self.replace, self.by, 1)


def control(fault):
    """No fault, built the same way: a test that fails with it would fail without a fault."""
    return dataclasses.replace(fault, name=f"none_{fault.list}", by=fault.replace + " ", what="nothing", where=f"tests/planted/{fault.list}.yaml")


def rulings(root):
    return {name for page in RULING_PAGES for name in re.findall(r"^- \*\*([A-Z]{1,2}[0-9]+)\*\*", (root / page).read_text(encoding="utf-8"), re.M)}


def entry_of(node, where):
    if not isinstance(node, yaml.MappingNode):
        raise BadList(f"{where}: this is no fault, expected the keys {', '.join(sorted(KEYS))}")
    entry = {key.value: value.value for key, value in node.value}
    unknown, missing = sorted(set(entry) - KEYS), sorted(NEEDED - set(entry))
    if unknown:
        raise BadList(f"{where}: unknown key {unknown[0]}, expected {', '.join(sorted(KEYS))}")
    if missing:
        raise BadList(f"{where}: {missing[0]} is missing")
    return entry


def check(fault, root, known_rulings):
    source = root / fault.file
    if not source.is_file():
        raise BadList(f"{fault.where}: {fault.name}: {fault.file} is not there")
    count = source.read_text(encoding="utf-8").count(fault.replace) if fault.replace else 0
    if count != 1:
        found = "is not" if count == 0 else f"stands {count} times"
        raise BadList(f"{fault.where}: {fault.name}: its text {found} in {fault.file}, expected once")
    if fault.planted(root) == source.read_text(encoding="utf-8"):
        raise BadList(f"{fault.where}: {fault.name}: nothing is changed")
    unknown = [name for name in re.findall(r"[A-Z]+[0-9]+", fault.rule) if name not in known_rulings]
    if unknown:
        raise BadList(f"{fault.where}: {fault.name}: there is no ruling {unknown[0]}, expected those of {' and '.join(RULING_PAGES)}")


def read(name, root=ROOT):
    """The faults of one list, in its order. BadList when one no longer fits its source."""
    path = root / "tests" / "planted" / f"{name}.yaml"
    shown = path.relative_to(root)
    try:
        top = yaml.compose(path.read_text(encoding="utf-8"), Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        raise BadList(f"{shown}:{error.problem_mark.line + 1}: {error.problem}") from None
    faults, known_rulings = [], rulings(root)
    for node in top.value:
        where = f"{shown}:{node.start_mark.line + 1}"
        fault = Fault(list=name, where=where, **entry_of(node, where))
        check(fault, root, known_rulings)
        if fault.name in {other.name for other in faults}:
            raise BadList(f"{where}: there is another {fault.name}, expected one of a name")
        faults.append(fault)
    return faults
