"""Reads the YAML files of this folder: rulings, documents with their clauses, the test plan's other parts.

What is written badly is told with file and line (BadData). Whether it is true is check.py's business.
"""
import re
from dataclasses import dataclass, field

import yaml

FOLDER = "docs/conformance"
RULINGS = f"{FOLDER}/rulings.yaml"
DOCUMENTS = [f"{FOLDER}/datasheet.yaml", f"{FOLDER}/manual.yaml"]
PLAN = f"{FOLDER}/test_plan.yaml"


class BadData(Exception):
    """One line: file:line: what is wrong, what is allowed."""


@dataclass
class Test:
    """A suite of GoogleTest, one test of it, a test of ctest or a scenario, and what it shows of this matter."""

    name: str
    note: str = ""


@dataclass
class Ruling:
    name: str
    where: str
    tests: list
    model: list
    rtl: list


@dataclass
class Clause:
    name: str  # the place in the document, then "-" and what of it
    says: str
    where: str
    rulings: list
    tests: list
    model: list
    rtl: list
    reason: str


@dataclass
class Part:
    title: str
    clauses: list


@dataclass
class Document:
    title: str
    text: str
    where: str
    places: list  # each of these needs a clause
    parts: list

    @property
    def clauses(self):
        return [clause for part in self.parts for clause in part.clauses]


@dataclass
class Section:
    """Of the test plan: text, then the rulings that begin with a letter, or rows."""

    title: str
    text: str
    where: str
    rulings: str
    head: list
    rows: list  # of cells; a cell is text or a list of tests


@dataclass
class Data:
    rulings: dict
    documents: list
    plan: list
    texts: list = field(default_factory=list)  # (text, where): in which backquotes may name tests, too


# ------------------------------------------------------------------------------------------------------- YAML with lines
class Map(dict):
    """A mapping that knows where it stands."""

    def __init__(self, where):
        super().__init__()
        self.where = where


def build(node, file):
    """Scalars stay the text that they are in the file: 4.10 is no number here."""
    if isinstance(node, yaml.ScalarNode):
        return node.value
    if isinstance(node, yaml.SequenceNode):
        return [build(item, file) for item in node.value]
    result = Map(f"{file}:{node.start_mark.line + 1}")
    for key, value in node.value:
        if key.value in result:
            raise BadData(f"{file}:{key.start_mark.line + 1}: {key.value} is there twice, allowed is once")
        result[key.value] = build(value, file)
    return result


def read(root, file):
    try:
        node = yaml.compose((root / file).read_text(encoding="utf-8"))
    except yaml.MarkedYAMLError as error:
        raise BadData(f"{file}:{error.problem_mark.line + 1}: {error.problem}") from error
    except OSError as error:
        raise BadData(f"{file}:1: {error.strerror}") from error
    if not isinstance(node, yaml.MappingNode):
        raise BadData(f"{file}:1: the file must be a mapping")
    return build(node, file)


def keys(entry, what, needed, optional=()):
    for key in entry:
        if key not in [*needed, *optional]:
            raise BadData(f"{entry.where}: {what} has no key {key}, allowed are {', '.join([*needed, *optional])}")
    for key in needed:
        if key not in entry:
            raise BadData(f"{entry.where}: {what} needs the key {key}")


def mapping(entry, where, what):
    if not isinstance(entry, Map):
        raise BadData(f"{where}: {what} must be a mapping, like {{key: value}}")
    return entry


def names(entry, key, where):
    """A list of words, or nothing."""
    value = entry.get(key, [])
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise BadData(f"{where}: {key} must be a list of names, like [one, two]")
    return value


def test(text, where):
    match = re.fullmatch(r"(\S+?)(?: \((.+)\))?", text, re.S)
    if match is None:
        raise BadData(f'{where}: "{text}" is no test; allowed is a name, and behind it a note in brackets')
    return Test(match.group(1), match.group(2) or "")


def tests(entry, where):
    return [test(text, where) for text in names(entry, "tests", where)]


# --------------------------------------------------------------------------------------------------------------- the files
def read_rulings(root):
    file = read(root, RULINGS)
    result = {}
    for name, entry in file.items():
        mapping(entry, file.where, f"ruling {name}")
        keys(entry, f"ruling {name}", ["tests", "model", "rtl"])
        where = entry.where
        result[name] = Ruling(name, where, tests(entry, where), names(entry, "model", where), names(entry, "rtl", where))
    return result


def inherited(entry, key, rulings, part):
    """What a clause does not say itself its rulings say, else its part."""
    if key in entry:
        return names(entry, key, entry.where)
    result = []
    for name in names(entry, "ruled", entry.where):
        result += [item for item in getattr(rulings.get(name), key, []) if item not in result]
    return result or names(part, key, part.where)


def read_clause(entry, rulings, part):
    keys(entry, "a clause", ["at", "says"], ["ruled", "tests", "model", "rtl", "reason"])
    where = entry.where
    if "tests" in entry and "reason" in entry:
        raise BadData(f"{where}: clause {entry['at']} has tests and a reason for having none, allowed is one of them")
    reason = entry.get("reason", "")
    if reason:
        found = []
    elif "tests" in entry:
        found = tests(entry, where)
    else:
        found = [item if isinstance(item, Test) else test(item, where) for item in inherited(entry, "tests", rulings, part)]
    return Clause(entry["at"], entry["says"], where, names(entry, "ruled", where), found,
                  inherited(entry, "model", rulings, part), inherited(entry, "rtl", rulings, part), reason)


def places(listed):
    """4.1, T1..T34: a range counts the number at the end."""
    for place in listed:
        match = re.fullmatch(r"(\S*?)(\d+)\.\.\1(\d+)", place)
        if match is None:
            yield place
        else:
            for number in range(int(match.group(2)), int(match.group(3)) + 1):
                yield f"{match.group(1)}{number}"


def read_document(root, name, rulings):
    file = read(root, name)
    keys(file, "a document", ["title", "text", "places", "parts"])
    parts = []
    for part in file["parts"]:
        mapping(part, file.where, "a part")
        keys(part, "a part", ["title", "clauses"], ["tests", "model", "rtl"])
        clauses = [read_clause(mapping(entry, part.where, "a clause"), rulings, part) for entry in part["clauses"]]
        parts.append(Part(part["title"], clauses))
    return Document(file["title"], file["text"], file.where, list(places(names(file, "places", file.where))), parts)


def read_cell(cell, where):
    return [test(text, where) for text in cell] if isinstance(cell, list) else cell


def read_plan(root):
    file = read(root, PLAN)
    keys(file, "the plan", ["sections"])
    result = []
    for entry in file["sections"]:
        keys(mapping(entry, file.where, "a section"), "a section", ["title"], ["text", "rulings", "head", "rows"])
        rows = [[read_cell(cell, entry.where) for cell in row] for row in entry.get("rows", [])]
        result.append(Section(entry["title"], entry.get("text", ""), entry.where, entry.get("rulings", ""),
                              entry.get("head", []), rows))
    return result


def load(root):
    rulings = read_rulings(root)
    documents = [read_document(root, name, rulings) for name in DOCUMENTS if (root / name).exists()]
    data = Data(rulings, documents, read_plan(root))
    for section in data.plan:
        data.texts += [(section.text, section.where)]
        data.texts += [(cell, section.where) for row in section.rows for cell in row if isinstance(cell, str)]
    return data
