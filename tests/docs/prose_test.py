"""Plants sentences in a small project, to see that prose.py counts them, names them with file and line, and nothing else."""
import contextlib
import io
import unittest
from unittest import mock

import prose
import small_project

PAGE, OTHER, CELLS = (f"docs/{name}.md" for name in ("page", "other", "cells"))  # check_docs.py mentions finds no page in this
LONG = "one two three four five six seven eight nine ten " * 4  # 40 words
RIGHT = {
    "README.md": "# What is this\n\nA chip answers a master. It does so in time.\n",
    PAGE: "Three words here.\n\n```\n" + LONG + "and nobody more\n```\n\n- an item of a list\n\n| a cell | `is no code` |\n|---|---|\n",
    "apps/sim.cpp": '// Prints the help.\nconst char* kHelp = "Runs a scenario" " and prints it";\n',
    "tool/tool.py": '"""Does one thing well."""\nx = 1  # the only line\n',
}
PLACES = {  # what is written there, with %s for the sentence, and the line at which the sentence begins
    OTHER: ("A page about it.\n\nThe first one.\n%s\n", 4, prose.PAGES_AND_HELP),
    CELLS: ("| a | b |\n|---|---|\n| 1 | %s |\n", 3, prose.PAGES_AND_HELP),
    "apps/help.cpp": ('void f();\nconst char* kHelp =\n    "%s";\n', 3, prose.PAGES_AND_HELP),
    "model/a.hpp": ("int x;\n// The first line.\n/// %s\nint y;\n", 3, prose.COMMENTS),
    "model/b.c": ("/* A head.\n * %s */\nint y;\n", 2, prose.COMMENTS),
    "rtl/c.sv": ("logic a;  // %s\n", 1, prose.COMMENTS),
    "tool/d.py": ("x = 1\n# %s\n", 2, prose.COMMENTS),
    "tool/e.py": ('def f():\n    """The first.\n\n    %s"""\n', 4, prose.COMMENTS),
}
SENTENCES = {
    "What stands here is read.": "What", "Whoever reads it stops.": "Whoever", "Of the three one is right.": "Of",
    "It is seen by nobody else.": "nobody", "It has a folder of its own.": "of its own", "Each change is told at once.": "is told",
    "The run goes on from there.": "goes on", "It is held against the model.": "held against", "One stands in the place of another.": "in the place of",
    "It starts by itself again.": "by itself", "The byte behind the length counts.": "behind", "All but for the last count.": "but for",
    "This is no valid byte.": "is no", "Prints a line; left out: none.": "left out:", "Wrong, allowed is one file.": "allowed is", "It is made anew each time.": "anew",
}


class Prose(small_project.SmallProject):
    RIGHT = RIGHT

    def run_it(self, **limits):
        """Exit code and lines, the limits being 0 but those that are named."""
        names = {prose.AVERAGE: "average", prose.LONGEST: "longest", prose.PAGES_AND_HELP: "pages", prose.COMMENTS: "comments"}
        table = {what: limits.get(name, {"average": 16, "longest": 40}.get(name, 0)) for what, name in names.items()}
        out = io.StringIO()
        with mock.patch.dict(prose.LIMITS, table), mock.patch("sys.argv", ["prose.py", "--root", str(self.root)]), contextlib.redirect_stdout(out):
            return prose.main(), out.getvalue().splitlines()

    def test_right_texts_have_no_excess(self):
        code, lines = self.run_it()
        self.assertEqual((code, len(lines)), (0, 4), lines)
        self.assertEqual(lines[1], "prose: 5 words of a sentence, at most 40")

    def test_each_phrase_is_found_in_each_place_with_its_line(self):
        for name, (text, line, limit) in PLACES.items():
            for sentence, phrase in SENTENCES.items():
                with self.subTest(f"{name}: {sentence}"):
                    self.write(name, text % sentence)
                    code, lines = self.run_it()
                    self.assertEqual((code, len(lines)), (1, 5), lines)
                    self.assertTrue(lines[0].startswith(f'{name}:{line}: "{phrase}", better: '), lines[0])
                    self.assertTrue(lines[0].endswith(": " + sentence), lines[0])
                    self.assertIn(f"prose: 1 {limit}, at most 0: too many", lines)
            (self.root / name).unlink()

    def test_as_many_phrases_as_the_limit_allows_are_kept(self):
        self.write(OTHER, "The byte behind it. The byte behind that.\n")
        self.assertEqual(self.run_it(pages=2)[0], 0)
        self.assertEqual(self.run_it(pages=1)[0], 1)

    def test_a_sentence_of_41_words_is_shown(self):
        self.write(OTHER, f"Before.\n\n{LONG.strip()}.\n")
        self.assertEqual(self.run_it(average=100)[0], 0)
        self.write(OTHER, f"Before.\n\n{LONG}more.\n")
        code, lines = self.run_it(average=100)
        self.assertEqual((code, lines[0]), (1, f"{OTHER}:3: 41 words: {LONG}more."))

    def test_neither_a_semicolon_nor_a_colon_ends_a_sentence(self):
        for mark in (";", ":", ","):
            self.write(OTHER, LONG.strip() + mark + "\nAnd more of it.\n")
            self.assertEqual(self.run_it(average=100)[1][-3], "prose: 44 words of a sentence, at most 40: too many")
        self.write(OTHER, LONG.strip() + ".\nAnd more of it.\n")
        self.assertEqual(self.run_it(average=100)[0], 0)

    def test_links_count_as_their_words_and_code_as_one(self):
        self.write(OTHER, LONG[:-4] + "[of](a.md#b) `x = y + z`.\n")
        self.assertEqual(self.run_it(average=100)[1][-3], "prose: 41 words of a sentence, at most 40: too many")

    def test_the_average_is_over_all_pages(self):
        self.write(OTHER, LONG.strip() + ".\n")
        code, lines = self.run_it(average=12)
        self.assertEqual((code, lines[0]), (0, "prose: 11.6 words a sentence, on average, at most 12"))
        code, lines = self.run_it(average=11)
        self.assertEqual((code, lines[0]), (1, f"{OTHER}:1: 40 words: {LONG.strip()}."))

    def test_a_question_and_what_is_right_are_kept(self):
        self.write(OTHER, "What is it? There is no other. It is no longer there. He whispers of a chip.\n")
        self.write("tool/f.py", 'x = "What is a text, seen by nobody"\n')
        self.write("model/a.hpp", 'const char* x = "// by nobody else";\n')
        self.assertEqual(self.run_it(), (0, mock.ANY))


if __name__ == "__main__":
    unittest.main()
