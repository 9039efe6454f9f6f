"""Breaks a small project's walks on purpose, to see that walks.py finds each kind of fault and nothing else."""
import unittest

import small_project
import walks

WALK = """<!-- walk: {} -->
1. `low/a.hpp`: `Block` has `level`.
2. `low/a.cpp`: it is made here.
3. `high/b.cpp`: `level` is looked at, for `--look`.

2 rooms, 1 types.
<!-- /walk -->
"""
RIGHT = {
    "docs/architecture.md": "".join(WALK.format(name) for name in walks.NAMES),
    "low/a.hpp": "struct Block {\n  int level;\n};\n",
    "low/a.cpp": '#include "low/a.hpp"\n',
    "high/b.hpp": '#include "low/a.hpp"\n',
    "high/b.cpp": '// --look\nint seen(Level* block) { return block->level; }\n',
}


class Walks(small_project.SmallProject):
    RIGHT = RIGHT

    def change_walk(self, old, new):
        """In the first walk alone."""
        self.assertIn(old, RIGHT["docs/architecture.md"])
        self.write("docs/architecture.md", RIGHT["docs/architecture.md"].replace(old, new, 1))

    def expect(self, *faults):
        self.assertEqual(list(walks.check(self.root)), [f"docs/architecture.md:{fault}" for fault in faults])

    def test_right_walks_have_no_fault(self):
        self.expect()

    def test_a_file_that_is_gone(self):
        self.change_walk("`low/a.hpp`", "`low/c.hpp`")
        self.expect("2: there is no file low/c.hpp")

    def test_a_name_that_is_gone(self):
        self.change_walk("has `level`", "has `Block::height`")
        self.expect("2: low/a.hpp does not contain height")

    def test_a_part_of_a_word_is_no_name(self):
        self.change_walk("has `level`", "has `leve`")
        self.expect("2: low/a.hpp does not contain leve")

    def test_lines_that_are_not_connected(self):
        self.write("high/c.cpp", "// --look\nint other;\n")
        self.change_walk("`high/b.cpp`: `level`", "`high/c.cpp`: `other`")
        self.expect("4: high/c.cpp and low/a.cpp neither include each other nor share an identifier that is named")

    def test_a_header_connects(self):
        self.change_walk("`level` is looked at", "`seen` is called")
        self.expect()

    def test_a_walk_that_is_too_long(self):
        self.change_walk("1. `low/a.hpp`", "1. `low/a.cpp`\n" * 9 + "1. `low/a.hpp`")
        self.expect("12: the walk has 12 lines, expected 10")

    def test_wrong_counts(self):
        self.change_walk("2 rooms, 1 types.", "3 rooms, 1 types.")
        self.expect("4: below the walk must stand: 2 rooms, 1 types.")

    def test_a_walk_that_is_missing(self):
        self.change_walk("walk: a key", "walk: a lock")
        self.expect("1: the walk of a key is missing")


if __name__ == "__main__":
    unittest.main()
