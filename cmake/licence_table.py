"""The table of docs/licences.md: third-party components, their licences, and the programs that use them."""
import pathlib
import re

PAGE = "docs/licences.md"
TABLE = re.compile(r"<!-- licences -->\n(.*?)<!-- /licences -->", re.S)


class Row:
    """A dependency as shown on the page."""

    def __init__(self, line):
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        self.what, packages, self.licence, self.use, into = cells
        self.packages = re.findall(r"`([^`]+)`", packages)
        self.into = {word.strip("` ") for word in into.split(",")} - {"", "-"}


def rows_of(text):
    table = TABLE.search(text)
    return [Row(line) for line in table.group(1).splitlines()[2:] if line.startswith("|")] if table else []


def label_of(program):
    """The name on the page: all tests are "tests", other programs have their names, libraries no version."""
    return "tests" if program.startswith("tests/") else re.sub(r"\.so\..*", ".so", pathlib.PurePosixPath(program).name)
