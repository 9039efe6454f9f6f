"""The output of docs/site/ for headers and pages, before Doxygen and Sphinx; ./run nightly makes the whole site."""
import pathlib
import sys
import unittest

import small_project

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs/site"))

import build  # noqa: E402
import comments  # noqa: E402

HEADER = """/* SPDX-License-Identifier: MIT */
#ifndef ONE_H
/*
 * The driver, for I&M0 too.
 *
 *   open(&chip);
 *     nested(&chip);
 */
/* NOLINTBEGIN(all): C */
#include <stddef.h>

/* ---- errors ---- */

/* About nothing in particular. */

/*
 * Opens it.
 */
int open(void); /* 0: done */
/** Closes it. */
int close(void);
#endif /* ONE_H */
"""

SEEN = """/* SPDX-License-Identifier: MIT */
#ifndef ONE_H
/** @file one.h
 * The driver, for I\\&M0 too.
 *
 *         open(&chip);
 *           nested(&chip);
 */
/* NOLINTBEGIN(all): C */
#include <stddef.h>

/* ---- errors ---- */

/* About nothing in particular. */

/**
 * Opens it.
 */
int open(void); /**< 0: done */
/** Closes it. */
int close(void);
#endif /* ONE_H */
"""


class Comments(unittest.TestCase):
    def test_each_is_its_declarations_or_stays_what_it_is(self):
        self.assertEqual(comments.documented(HEADER, "one.h"), SEEN)


class Pages(small_project.SmallProject):
    RIGHT = {"README.md": "# Top\n[all](docs/README.md)\n",
             "docs/README.md": "# Documents\n\n## Tutorials\n\n| [One](tutorials/one.md) | first |\n\n## Reference\n\n| [Two](two.md) | second |\n",
             "docs/tutorials/one.md": "# One\n[core](../../model/core.cpp), [two](../two.md#a)\n", "docs/two.md": "# Two\n![one](img/one.svg)\n",
             "docs/img/one.svg": "<svg/>", "model/core.cpp": "int core;\n"}

    def setUp(self):
        super().setUp()
        self.was, build.ROOT = build.ROOT, self.root
        self.addCleanup(setattr, build, "ROOT", self.was)
        build.copy_pages(self.root / "site", list(build.lists_of_pages()))
        build.show_files(self.root / "site")

    def test_lists_are_those_of_the_readme_in_its_order(self):
        text = self.text("site/README.md")
        self.assertLess(text.index(":caption: Tutorials\n:hidden:\n\n/docs/tutorials/one\n"), text.index(":caption: Reference\n:hidden:\n\n/docs/two\n"))

    def test_pages_stand_where_they_stood(self):
        self.assertEqual(self.text("site/docs/tutorials/one.md"), self.RIGHT["docs/tutorials/one.md"])
        self.assertEqual(self.text("site/docs/img/one.svg"), "<svg/>")

    def test_a_linked_source_is_a_page(self):
        self.assertIn("``````text\nint core;\n``````", self.text("site/model/core.cpp.md"))
        self.assertFalse((self.root / "site/docs/two.md.md").exists())


if __name__ == "__main__":
    unittest.main()
