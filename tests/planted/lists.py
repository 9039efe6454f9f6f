"""The lists of faults: read, and compared with the sources that they change."""
import dataclasses
import pathlib
import sys

import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "conformance"))
import data  # noqa: E402
import mutation  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = pathlib.Path(__file__).resolve().parent
NAMES = ("systemc", "driver", "checks", "board")
KEYS = {"name", "block", "file", "replace", "by", "what", "rows", "test"}
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
    rows: str = ""  # of docs/conformance.md, separated by commas
    test: str = ""  # of GoogleTest, that has to find it; without: those of the rows

    @property
    def row_names(self):
        return self.rows.split(", ") if self.rows else []

    def planted(self, root=ROOT):
        """The source with the fault."""
        return (root / self.file).read_text(encoding="utf-8").replace(self.replace, self.by, 1)


def control(fault):
    """No fault, built the same way: a test that fails with it would fail without a fault."""
    return dataclasses.replace(fault, name=f"none_{fault.list}", by=fault.replace + " ", what="nothing", where=f"tests/planted/{fault.list}.yaml")


def conformance(root):
    """The rows of docs/conformance.md."""
    return mutation.owners(data.load(root))


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


def check(fault, root, known_rows):
    source = root / fault.file
    if not source.is_file():
        raise BadList(f"{fault.where}: {fault.name}: {fault.file} is not there")
    count = source.read_text(encoding="utf-8").count(fault.replace) if fault.replace else 0
    if count != 1:
        found = "is not" if count == 0 else f"stands {count} times"
        raise BadList(f"{fault.where}: {fault.name}: its text {found} in {fault.file}, expected once")
    if fault.planted(root) == source.read_text(encoding="utf-8"):
        raise BadList(f"{fault.where}: {fault.name}: nothing is changed")
    unknown = [name for name in fault.row_names if name not in known_rows]
    if unknown:
        raise BadList(f"{fault.where}: {fault.name}: there is no row {unknown[0]}, expected those of docs/conformance.md")


def read(name, root=ROOT, known_rows=None):
    """The faults of one list, in its order. BadList when one no longer fits its source."""
    path = root / "tests" / "planted" / f"{name}.yaml"
    shown = path.relative_to(root)
    try:
        top = yaml.compose(path.read_text(encoding="utf-8"), Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        raise BadList(f"{shown}:{error.problem_mark.line + 1}: {error.problem}") from None
    faults, known_rows = [], known_rows if known_rows is not None else conformance(root)
    for node in top.value:
        where = f"{shown}:{node.start_mark.line + 1}"
        fault = Fault(list=name, where=where, **entry_of(node, where))
        check(fault, root, known_rows)
        if fault.name in {other.name for other in faults}:
            raise BadList(f"{where}: there is another {fault.name}, expected one of a name")
        faults.append(fault)
    return faults
