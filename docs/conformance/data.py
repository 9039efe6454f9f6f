"""Reads the YAML files of this folder: rulings, documents with their clauses, the test plan's other parts.

Bad syntax is reported with file and line (BadData). check.py checks whether it is true.
"""
import re
from dataclasses import dataclass, field

import yaml

FOLDER = "docs/conformance"
RULINGS = f"{FOLDER}/rulings.yaml"
DOCUMENTS = [f"{FOLDER}/datasheet.yaml", f"{FOLDER}/manual.yaml"]
PLAN = f"{FOLDER}/test_plan.yaml"
INDEX = f"{FOLDER}/index.yaml"


class BadData(Exception):
    """One line: file:line: what is wrong, what is allowed."""


@dataclass(frozen=True)
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
    """A section of the test plan: text, then the rulings that begin with these letters, or rows."""

    title: str
    text: str
    where: str
    rulings: str
    head: list
    rows: list  # of cells; a cell is text or a list of tests


@dataclass
class Entry:
    """A row of the index: what a reader looks for, and where it is carried out."""

    title: str
    place: str  # of a document, empty: the documents are silent
    where: str
    rulings: list
    model: list
    rtl: list


@dataclass
class Data:
    rulings: dict
    documents: list
    plan: list
    index: list
    texts: list = field(default_factory=list)  # (text, where): in which backquotes may name tests, too

    @property
    def test_names(self):
        """All that rulings and clauses name."""
        clauses = [clause for document in self.documents for clause in document.clauses]
        return sorted({test.name for owner in [*self.rulings.values(), *clauses] for test in owner.tests})


# ------------------------------------------------------------------------------------------------------- YAML with lines
class Map(dict):
    """A mapping that knows where it and its keys stand."""

    def __init__(self, where):
        super().__init__()
        self.where = where
        self.where_is = {}


def build(node, file):
    """Scalars stay the text that they are in the file: 4.10 is not a number here."""
    if isinstance(node, yaml.ScalarNode):
        return node.value
    if isinstance(node, yaml.SequenceNode):
        return [build(item, file) for item in node.value]
    result = Map(f"{file}:{node.start_mark.line + 1}")
    for key, value in node.value:
        result.where_is[key.value] = f"{file}:{key.start_mark.line + 1}"
        if key.value in result:
            raise BadData(f"{result.where_is[key.value]}: {key.value} is there twice, expected once")
        result[key.value] = build(value, file)
    return result


def read(root, file, kind=yaml.MappingNode, what="a mapping"):
    try:
        node = yaml.compose((root / file).read_text(encoding="utf-8"))
    except yaml.MarkedYAMLError as error:
        raise BadData(f"{file}:{error.problem_mark.line + 1}: {error.problem}") from error
    except OSError as error:
        raise BadData(f"{file}:1: {error.strerror}") from error
    if not isinstance(node, kind):
        raise BadData(f"{file}:1: the file must be {what}")
    return build(node, file)


def keys(entry, what, needed, optional=()):
    for key in entry:
        if key not in [*needed, *optional]:
            raise BadData(f"{entry.where}: {what} has no key {key}, expected {', '.join([*needed, *optional])}")
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
        raise BadData(f'{where}: "{text}" is no test; expected a name, and behind it a note in brackets')
    return Test(match.group(1), match.group(2) or "")


def tests(entry, where):
    return [test(text, where) for text in names(entry, "tests", where)]


# --------------------------------------------------------------------------------------------------------------- the files
def read_rulings(root):
    file = read(root, RULINGS)
    result = {}
    for name, entry in file.items():
        where = file.where_is[name]
        mapping(entry, where, f"ruling {name}")
        keys(entry, f"ruling {name}", ["tests", "model", "rtl"])
        result[name] = Ruling(name, where, tests(entry, where), names(entry, "model", where), names(entry, "rtl", where))
    return result


def letters(ruling):
    """With which its name begins: P of P1, SP of SP1."""
    return ruling.rstrip("0123456789")


def joined(lists):
    return list(dict.fromkeys(item for each in lists for item in each))


def covers(clause, place):
    """True if a clause is at a place: at 5.1 are 5.1 and 5.1-3."""
    return clause.name == place or clause.name.startswith(place + "-")


class Sources:
    """Where a clause has what it does not say itself from: the clauses that it repeats, else its rulings, else its part."""

    def __init__(self, entry, rulings, earlier, part):
        self.part = part
        self.repeated = [clause for place in names(entry, "same_as", entry.where) for clause in at(earlier, place, entry.where)]
        self.rulings = [rulings[name] for name in names(entry, "ruled", entry.where) if name in rulings]

    def of(self, entry, key):
        if key in entry:
            return tests(entry, entry.where) if key == "tests" else names(entry, key, entry.where)
        found = joined(getattr(owner, key) for owner in self.repeated or self.rulings)
        return found or (tests(self.part, self.part.where) if key == "tests" else names(self.part, key, self.part.where))


def at(clauses, place, where, of="an earlier document"):
    found = [clause for clause in clauses if covers(clause, place)]
    if not found:
        raise BadData(f"{where}: no clause of {of} is at {place}")
    return found


def read_clause(entry, rulings, earlier, part):
    keys(entry, "a clause", ["at", "says"], ["ruled", "same_as", "tests", "model", "rtl", "reason"])
    sources = Sources(entry, rulings, earlier, part)
    reason = entry.get("reason", "")
    if reason and "tests" in entry:
        raise BadData(f"{entry.where}: clause {entry['at']} has tests and a reason for having none, expected one of them")
    ruled = joined([names(entry, "ruled", entry.where), *[clause.rulings for clause in sources.repeated]])
    found = [] if reason else sources.of(entry, "tests")
    if not reason and not found and sources.repeated:
        reason = "; ".join(dict.fromkeys(clause.reason for clause in sources.repeated if clause.reason))
    return Clause(entry["at"], entry["says"], entry.where, ruled, found, sources.of(entry, "model"), sources.of(entry, "rtl"), reason)


def places(listed):
    """4.1, T1..T34: a range counts the number at the end."""
    for place in listed:
        match = re.fullmatch(r"(\S*?)(\d+)\.\.\1(\d+)", place)
        if match is None:
            yield place
        else:
            for number in range(int(match.group(2)), int(match.group(3)) + 1):
                yield f"{match.group(1)}{number}"


def read_document(root, name, rulings, earlier):
    file = read(root, name)
    keys(file, "a document", ["title", "text", "places", "parts"])
    parts = []
    for part in file["parts"]:
        mapping(part, file.where, "a part")
        keys(part, "a part", ["title", "clauses"], ["tests", "model", "rtl"])
        clauses = [read_clause(mapping(entry, part.where, "a clause"), rulings, earlier, part) for entry in part["clauses"]]
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


def read_entry(entry, rulings, documents):
    keys(entry, "a row", [], ["at", "find", "ruled"])
    place = entry.get("at", "")
    parts = [part for document in documents for part in document.parts if place and part.title.startswith(place + " ")]
    title = entry.get("find", parts[0].title[len(place) + 1:] if parts else "")
    if not title:
        raise BadData(f"{entry.where}: a row needs the key find, unless a part's title begins with its place")
    clauses = at([clause for document in documents for clause in document.clauses], place, entry.where, "a document") if place else []
    if not place and "ruled" not in entry:
        raise BadData(f"{entry.where}: a row needs the key at or ruled")
    owners = [rulings[name] for name in names(entry, "ruled", entry.where) if name in rulings] or clauses
    model, rtl = (joined(getattr(owner, kind) for owner in owners) for kind in ("model", "rtl"))
    return Entry(title, place, entry.where, names(entry, "ruled", entry.where), model, rtl)


def read_index(root, rulings, documents):
    file = read(root, INDEX, yaml.SequenceNode, "a list")
    return [read_entry(mapping(entry, f"{INDEX}:1", "a row"), rulings, documents) for entry in file]


def load(root):
    rulings = read_rulings(root)
    documents = []
    for name in DOCUMENTS:
        earlier = [clause for document in documents for clause in document.clauses]
        documents.append(read_document(root, name, rulings, earlier))
    data = Data(rulings, documents, read_plan(root), read_index(root, rulings, documents))
    for section in data.plan:
        data.texts += [(section.text, section.where)]
        data.texts += [(cell, section.where) for row in section.rows for cell in row if isinstance(cell, str)]
    return data
