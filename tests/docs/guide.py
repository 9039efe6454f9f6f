"""Blocks of docs/programmers_guide.md that runs write: what stands between <!-- NAME --> and <!-- /NAME -->."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/programmers_guide.md"


class Block:
    """`what` it is called when it is stale."""

    def __init__(self, name, what):
        self._what = what
        self._page = PAGE.read_text(encoding="utf-8")
        self._begin, self._end = re.search(rf"<!-- {name} -->\n(.*?)<!-- /{name} -->", self._page, re.S).span(1)

    @property
    def text(self):
        return self._page[self._begin:self._end]

    def write(self, text):
        PAGE.write_text(self._page[:self._begin] + text + self._page[self._end:], encoding="utf-8")

    def refuse(self, given):
        """Ends the program: `given` is what runs give."""
        sys.exit(f"docs/programmers_guide.md: the {self._what} (./run generate); {given}")
