"""The results that docs/trust.md is made of: tab-separated files beside this one, whose rows begin with their date. Python's standard library only."""
import datetime
import pathlib

HERE = pathlib.Path(__file__).resolve().parent


def read(name):
    """The rows of a file, without its comments."""
    lines = (HERE / name).read_text(encoding="utf-8").splitlines()
    return [line.split("\t") for line in lines if line and not line.startswith("#")]


def add(name, *cells):
    """One more row, of today."""
    with (HERE / name).open("a", encoding="utf-8") as file:
        file.write("\t".join(map(str, [datetime.date.today().isoformat(), *cells])) + "\n")
