"""Checks that the data of this folder are true and complete: one line a fault."""
import re

import data as source
from known_tests import KnownTests, named_in

# The pages with rulings, and the letters with which theirs begin.
PAGES = {"docs/chip.md": "P H D S V U", "docs/chip_rsu.md": "R SP UA"}
ROOTS = {"model": ["", "model/"], "rtl": ["", "rtl_ref/"]}


def find(root, kind, name):
    """The path of a file of the model or the RTL, which may be named from there."""
    for room in ROOTS[kind]:
        if (root / room / name).is_file():
            return room + name
    return None


def check_files(root, kind, owner, what):
    for name in getattr(owner, kind):
        if find(root, kind, name) is None:
            yield f"{owner.where}: {what}: there is no file {name} in {' or '.join(room or './' for room in ROOTS[kind])}"


def check_suites(known):
    for name, programs in sorted(known.shared().items()):
        yield f"tests/: suite {name} is in {' and '.join(programs)}; rename one, so that a row can name it"


def check_tests(known, found, where, what):
    for test in found:
        if not known.has(test.name):
            yield f"{where}: {what}: there is no test {test.name}"


def ruled_in(root, page):
    letters = "|".join(PAGES[page].split())
    return re.findall(rf"^- \*\*((?:{letters})\d+)\*\*", (root / page).read_text(encoding="utf-8"), re.M)


def page_of(name):
    """The page on which a ruling is to be looked for."""
    return next((page for page, letters in PAGES.items() if source.letters(name) in letters.split()), next(iter(PAGES)))


def check_rulings(root, data, known):
    ruled = {name: page for page in PAGES for name in ruled_in(root, page)}
    for name, page in ruled.items():
        if name not in data.rulings:
            yield (f"{source.RULINGS}:1: ruling {name} of {page} is missing; add a line like "
                   f"{name}: {{tests: [Suite.Test], model: [profibus/fdl.cpp], rtl: [profibus/fdl.sv]}}")
    for ruling in data.rulings.values():
        what = f"ruling {ruling.name}"
        if ruling.name not in ruled:
            yield f"{ruling.where}: {page_of(ruling.name)} has no ruling {ruling.name}"
        if not ruling.tests:
            yield f"{ruling.where}: {what} names no test"
        yield from check_tests(known, ruling.tests, ruling.where, what)
        for kind in ROOTS:
            yield from check_files(root, kind, ruling, what)


def check_places(document):
    """Each place of the document has a clause, and each clause a place."""
    for place in document.places:
        if not any(source.covers(clause, place) for clause in document.clauses):
            yield f"{document.where}: {document.title} has {place}, but no clause is called {place} or {place}-..."
    for clause in document.clauses:
        if not any(source.covers(clause, place) for place in document.places):
            yield f"{clause.where}: clause {clause.name} is at none of the places of {document.title}"


def untested(data):
    """Clauses that have neither a test nor a reason for having none."""
    return [clause for document in data.documents for clause in document.clauses if not clause.tests and not clause.reason]


def check_clauses(root, data, known):
    seen = set()
    for clause in [clause for document in data.documents for clause in document.clauses]:
        what = f"clause {clause.name}"
        if clause.name in seen:
            yield f"{clause.where}: {what} is there twice, expected once"
        seen.add(clause.name)
        for name in clause.rulings:
            if name not in data.rulings:
                yield f"{clause.where}: {what}: there is no ruling {name} in {source.RULINGS}"
        yield from check_tests(known, clause.tests, clause.where, what)
        for kind in ROOTS:
            yield from check_files(root, kind, clause, what)
        if clause.tests and not clause.model:
            yield f"{clause.where}: {what} has tests but no file; name one with model: [...], or a ruling"
    for clause in untested(data):
        yield (f"{clause.where}: clause {clause.name} has no test; give it tests: [...], or ruled: [...] to have those of "
               "its ruling, or reason: why there can be none")


def check_index(data):
    for entry in data.index:
        what = f"row {entry.title}"
        for name in entry.rulings:
            if name not in data.rulings:
                yield f"{entry.where}: {what}: there is no ruling {name} in {source.RULINGS}"
        if not entry.model:
            yield f"{entry.where}: {what}: neither its rulings nor its clauses name a file of the model"


def check_plan(data, known):
    for section in data.plan:
        for row in section.rows:
            if len(row) != len(section.head):
                yield f"{section.where}: a row of {section.title} has {len(row)} cells, its head has {len(section.head)}"
            for cell in row:
                if isinstance(cell, list):
                    yield from check_tests(known, cell, section.where, section.title)
    planned = [section.rulings for section in data.plan]
    for letters in sorted({source.letters(name) for name in data.rulings}):
        if planned.count(letters) != 1:
            yield f"{source.PLAN}:1: the rulings {letters}... stand in {planned.count(letters)} sections, expected one"
    for text, where in data.texts:
        for name in named_in(text):
            if not known.has(name):
                yield f"{where}: there is no test {name}"


def check(root, data):
    known = KnownTests(root)
    yield from check_suites(known)
    yield from check_rulings(root, data, known)
    for document in data.documents:
        yield from check_places(document)
    yield from check_clauses(root, data, known)
    yield from check_index(data)
    yield from check_plan(data, known)
