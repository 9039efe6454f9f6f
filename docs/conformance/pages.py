"""Writes docs/conformance.md, docs/test_plan.md and a table of docs/architecture.md from the data and the results of a run."""
import re

import check
import mutation
from data import BadData, letters

ORIGIN = "<!-- Generated from docs/conformance/*.yaml by docs/conformance/generate.py (./run generate). Do not edit. -->\n"

CONFORMANCE = """# Conformance, clause by clause

Each line is one statement of the two documents about this chip. It names the ruling of [chip.md](../docs/chip.md) or
[chip_rsu.md](../docs/chip_rsu.md) that interprets it, its first file in the model and in the reference RTL, the tests that assert it, after the program that has them. Then come their results in the last recorded run. The
documents are Chinese; the lines are our words, and the documents take precedence.

*Clause*: section, table (T) or figure (F) of the document, and after the dash the statement; in tables the cell, bit or row. Clauses of the
manual begin with M and the chapter. *Last run*: the number of tests passed, of how many; a suite counts with each of its tests. A clause that cannot have
a test gives its reason instead. If no file of the RTL is named, the clause concerns the user or the master; the model's file is then that of the driver,
the checks or the bus. *Mutants*: of those of the model that alter what the row says, how many its own tests find ([below](#mutants)).

The data are in `docs/conformance/`; [CONTRIBUTING.md](../CONTRIBUTING.md) explains how to add a clause, a ruling or a run's results.
"""


def files(root, kind, names):
    paths = [check.find(root, kind, name) for name in names]
    return ", ".join(f"[{path.split('/')[-1]}](../{path})" for path in paths if path) or "-"


def tests(known, found):
    """Each after its program, which is named once where several follow each other."""
    text, last = [], None
    for test in found:
        program = known.program(test.name)
        text.append((f"{program}: " if program != last else "") + f"`{test.name}`" + (f" ({test.note})" if test.note else ""))
        last = program
    return ", ".join(text)


def cell(text):
    return text.replace("|", "\\|").replace("\n", " ")


def row(*cells):
    return "| " + " | ".join(cell(each) for each in cells) + " |\n"


def anchored(name):
    return f'<a id="{name.lower()}"></a>{name}'


def head(*cells):
    return row(*cells) + "|" + "---|" * len(cells) + "\n"


def shown(result):
    if result is None:
        return "not run"
    words = f"{result.passed} of {result.total}"
    return words + ("".join(f", FAILED {name}" for name in result.failed))


# ---------------------------------------------------------------------------------------------------------- conformance
def mutants(root, name):
    found, total = mutation.counts(root).get(name, (0, 0))
    return f"{found} of {total}" if total else "-"


def clause_row(root, known, clause, run):
    if clause.tests:
        asserted, last = tests(known, clause.tests), shown(run.of(clause.tests))
    else:
        asserted, last = (f"*none: {clause.reason}*" if clause.reason else "**NO TEST**"), "-"
    return row(anchored(clause.name), clause.says, ", ".join(clause.rulings) or "-", files(root, "model", clause.model),
               files(root, "rtl", clause.rtl), asserted, last, mutants(root, clause.name))


def part_text(root, known, part, run):
    lines = [f"\n### {part.title}\n\n", head("clause", "what it says", "ruling", "model", "RTL", "tests", "last run", "mutants")]
    return "".join(lines + [clause_row(root, known, clause, run) for clause in part.clauses])


def counts(owners, run):
    """Numbers: total, with tests, with a reason, with neither; of those with tests: all passed, one failed, not run."""
    tested = [owner for owner in owners if owner.tests]
    found = [run.of(owner.tests) for owner in tested]
    good = sum(result is not None and result.passed == result.total for result in found)
    bad = sum(result is not None and result.passed < result.total for result in found)
    reasoned = sum(bool(getattr(owner, "reason", "")) for owner in owners)
    return [len(owners), len(tested), reasoned, len(owners) - len(tested) - reasoned, good, bad, len(tested) - good - bad]


def summary(data, run):
    text = "\n## Summary\n\n"
    text += head("", "number", "with tests", "with a reason", "with neither", "all tests passed", "a test failed", "not run")
    for name, owners in [*[(document.title, document.clauses) for document in data.documents], ("Rulings", data.rulings.values())]:
        text += row(name, *map(str, counts(owners, run)))
    if run.commit:
        text += f"\nResults are those of the run of commit {run.commit}, {run.date}: {run.passed} of all {run.total} tests passed."
        newer, named = len(run.newer(data.test_names)), len(data.test_names)
        return text + f" Rulings and clauses name {named} tests; {newer or 'none'} {'are' if newer > 1 else 'is'} newer than this run (*not run*).\n"
    return text + "\nNo run has been recorded yet (`./run conformance --record`).\n"


def missing(data):
    """Clauses without a test, listed as such."""
    text = "\n## Clauses without a test\n\n"
    bare = check.untested(data)
    reasoned = [clause for document in data.documents for clause in document.clauses if clause.reason]
    text += "Neither a test nor a reason: " + (", ".join(clause.name for clause in bare) or "none") + ".\n\n"
    text += "With a reason:\n\n" + head("clause", "reason")
    return text + "".join(row(clause.name, clause.reason) for clause in reasoned)


MUTANTS = """
## Mutants

`./run mutants` alters the model: each mutant changes the number or the condition that its rows state (`tests/planted/mutants.yaml`). It runs the tests that a row
names, and no others. A mutant is found when an EXPECT or ASSERT in the source of such a test fails. A crash, a time limit, a failure of the bench and a difference between two executions of the chip do not count.

"""


def mutant_section(root, known, data):
    found, alive = mutation.recorded(root), mutation.survivors(root)
    whole = sum(not rows for _, rows in found.values())
    pairs = sum(total for _, total in mutation.counts(root).values())
    text = MUTANTS + f"{whole} of {len(found)} mutants are found by each of their rows; {pairs - len(alive)} of {pairs} times a row finds one.\n\n"
    if alive:
        text += "Not found:\n\n" + head("row", "mutant") + "".join(row(name, f"`{mutant}`") for name, mutant in alive) + "\n"
    text += "Rows without a mutant:\n\n" + head("why", "rows")
    return text + "".join(row(reason, ", ".join(names)) for reason, names in mutation.reasons(root, data, known, mutation.counts(root)).items())


def rulings(root, known, data, run):
    cited = {name: [] for name in data.rulings}
    for document in data.documents:
        for clause in document.clauses:
            for name in clause.rulings:
                cited.get(name, []).append(clause.name)
    text = "\n## The rulings\n\n[chip.md](../docs/chip.md) has their texts; R, SP and UA are in [chip_rsu.md](../docs/chip_rsu.md). If no clause is named, these two documents have none; its mark there says what it rests on.\n\n"
    text += head("ruling", "clauses", "model", "RTL", "tests", "last run", "mutants")
    for ruling in data.rulings.values():
        text += row(ruling.name, ", ".join(cited[ruling.name]) or "-", files(root, "model", ruling.model),
                    files(root, "rtl", ruling.rtl), tests(known, ruling.tests), shown(run.of(ruling.tests)),
                    mutants(root, ruling.name))
    return text


def conformance(root, known, data, run):
    text = ORIGIN + CONFORMANCE + summary(data, run) + missing(data) + mutant_section(root, known, data)
    for document in data.documents:
        text += f"\n## {document.title}\n\n{document.text.strip()}\n"
        text += "".join(part_text(root, known, part, run) for part in document.parts)
    return text + rulings(root, known, data, run)


# ------------------------------------------------------------------------------------------------------------ test plan
def plan_section(known, data, section):
    text = f"\n## {section.title}\n" if section.title else ""
    if section.text:
        text += "\n" + section.text.strip() + "\n"
    if section.rulings:
        text += "\n" + head("ruling", "tests")
        text += "".join(row(each.name, tests(known, each.tests)) for each in data.rulings.values() if letters(each.name) == section.rulings)
    if section.rows:
        text += "\n" + head(*section.head)
        text += "".join(row(*[tests(known, each) if isinstance(each, list) else each for each in cells]) for cells in section.rows)
    return text


def test_plan(known, data):
    return ORIGIN + "# Test plan\n" + "".join(plan_section(known, data, section) for section in data.plan)


# --------------------------------------------------------------------------------------------------------- architecture
INDEX = re.compile(r"(<!-- clauses -->\n).*?(<!-- /clauses -->)", re.S)


def index(root, data):
    text = head("clause", "what", "ruling", "model", "RTL")
    return text + "".join(row(entry.place or "-", entry.title, ", ".join(entry.rulings) or "-", files(root, "model", entry.model),
                              files(root, "rtl", entry.rtl)) for entry in data.index)


def architecture(root, data):
    """The page with its table; the rest of it is written by hand."""
    name = "docs/architecture.md"
    page = (root / name).read_text(encoding="utf-8") if (root / name).exists() else ""
    if not INDEX.search(page):
        raise BadData(f"{name}:1: the table between <!-- clauses --> and <!-- /clauses --> is missing")
    return INDEX.sub(lambda found: found.group(1) + index(root, data) + found.group(2), page)
