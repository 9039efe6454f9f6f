"""Breaks a small project on purpose, to see that arrows.py finds each kind of fault and nothing else."""
import unittest

import arrows
import small_project

PAGE = """<!-- arrows -->
| room | includes |
|---|---|
| `low` | |
| `low/wire` | `low` |
| `high` | `low/*` |
<!-- /arrows -->
"""
RIGHT = {
    "docs/architecture.md": PAGE,
    "low/a.hpp": "#pragma once\n",
    "low/wire/b.hpp": '#include "low/a.hpp"\n',
    "high/c.cpp": '#include <vector>\n\n#include "low/wire/b.hpp"\n#include "high/d.hpp"\n#include "generated.h"\n',
    "high/d.hpp": "#pragma once\n",
    "tests/e.cpp": '#include "high/d.hpp"\n',
}


class Rooms(small_project.SmallProject):
    RIGHT = RIGHT

    def expect(self, *faults):
        self.assertEqual(list(arrows.check(self.root)), list(faults))

    def test_a_right_project_has_no_fault(self):
        self.expect()

    def test_an_arrow_that_is_not_in_the_table(self):
        self.write("low/wire/b.hpp", '#include "low/a.hpp"\n#include "high/d.hpp"\n')
        self.expect("low/wire/b.hpp:2: low/wire includes high, which docs/architecture.md does not allow")

    def test_an_arrow_upwards(self):
        self.write("docs/architecture.md", PAGE.replace("| `low` | |", "| `low` | `high` |"))
        self.write("low/a.hpp", '#include "high/d.hpp"\n')
        self.expect("low/a.hpp:1: low includes high, which stands below it in docs/architecture.md")

    def test_folders_with_one_row_are_one_room(self):
        self.write("docs/architecture.md", PAGE.replace("| `high` |", "| `high/*` |"))
        self.write("high/part/f.hpp", '#include "high/d.hpp"\n')
        self.write("high/d.hpp", '#include "high/part/f.hpp"\n')
        self.expect()
        self.write("low/a.hpp", '#include "high/part/f.hpp"\n')
        self.expect("low/a.hpp:1: low includes high/part, which docs/architecture.md does not allow")
        self.write("docs/architecture.md", PAGE.replace("| `high` |", "| `high/*` |").replace("| `low` | |", "| `low` | `high/part` |"))
        self.expect("low/a.hpp:1: low includes high/part, which stands below it in docs/architecture.md")

    def test_an_arrow_that_is_no_more(self):
        self.write("low/wire/b.hpp", "")
        self.expect("docs/architecture.md:1: low/wire includes nothing of low any more")

    def test_a_room_without_a_row(self):
        self.write("new/f.c", "")
        self.expect("docs/architecture.md:1: the table of arrows has no row for new")

    def test_a_row_without_a_room(self):
        self.write("docs/architecture.md", PAGE.replace("| `low` | |", "| `low` | |\n| `gone` | |"))
        self.expect("docs/architecture.md:1: there is no room gone")


if __name__ == "__main__":
    unittest.main()
