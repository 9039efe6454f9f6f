"""What ./run mutants found: for each row of rulings and clauses how many of its mutants its tests find, and why it has none."""
import functools

from data import BadData, names, read

RECORD = "docs/trust/mutants.tsv"
REASONS = "docs/conformance/unmutated.yaml"
PROGRAMS = ("core_blocks", "conformance_rsu_test", "conformance_test")  # the tests that meet mutants of the model
NO_TEST = "no test"
OTHER_TESTS = f"no test in {', '.join(PROGRAMS[:-1])} or {PROGRAMS[-1]}, which have the model's mutants: code of the driver, the checks, the bus or the SystemC modules, or a table"


def owners(data):
    """All rows."""
    return {**data.rulings, **{clause.name: clause for document in data.documents for clause in document.clauses}}


def rows_of(cell):
    return cell.split(", ") if cell != "-" else []


@functools.lru_cache
def recorded(root):
    """{mutant: (rows that find it, rows that do not)}"""
    path = root / RECORD
    lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    cells = [line.split("\t") for line in lines if line and not line.startswith("#")]
    return {name: (rows_of(found), rows_of(alive)) for name, found, alive in cells}


@functools.lru_cache
def counts(root):
    """{row: (its mutants that it finds, all of them)}"""
    result = {}
    for found, alive in recorded(root).values():
        for row in [*found, *alive]:
            good, total = result.get(row, (0, 0))
            result[row] = (good + (row in found), total + 1)
    return result


def survivors(root):
    """(row, mutant)"""
    return [(row, mutant) for mutant, (_, alive) in recorded(root).items() for row in alive]


def reasons(root, data, known, has):
    """{reason: the rows without a mutant that have it}, of all but those that have one; a row without either is in none."""
    result = {}
    file = read(root, REASONS) if (root / REASONS).is_file() else {}
    by_hand = {row: reason for reason in file for row in names(file, reason, file.where)}
    for row in by_hand:
        if row not in owners(data):
            raise BadData(f"{REASONS}:1: there is no row {row}")
    for name, owner in owners(data).items():
        if name not in has:
            reason = by_hand.get(name) or derived(known, owner)
            if reason:
                result.setdefault(reason, []).append(name)
    return result


def derived(known, owner):
    if not owner.tests:
        return NO_TEST
    return "" if {known.program(test.name) for test in owner.tests} & set(PROGRAMS) else OTHER_TESTS
