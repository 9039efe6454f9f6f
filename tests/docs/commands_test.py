"""The faults that commands.py finds in a page, in a separate session for each."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import commands

TUTORIALS = sorted((commands.ROOT / "docs/tutorials").glob("*.md"))


def page(name):
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "tutorials").mkdir(), pathlib.Path(folder, "build").mkdir()
        path = pathlib.Path(folder, "tutorials/page.md")
        path.write_text(name, encoding="utf-8")
        return commands.session(path, path.parents[1] / "build")


class Commands(unittest.TestCase):
    def test_a_right_page(self):
        self.assertEqual(page("```sh\nA=7\necho first; echo second\n```\n```text\nfirst\n...\n```\nThen\n```sh\necho $A > file; cat file\n```\n```text\n7\n```\n"), "")

    def test_a_page_without_commands(self):
        self.assertIn("page.md:1: there is no block with commands", page("```\necho\n```\n"))

    def test_the_folder_is_empty_and_the_project_is_at_home(self):
        self.assertEqual(page("```sh\nls\nls ~/dsdpv1/README.md\n~/dsdpv1/run --version | cut -c -6\n```\n```text\n.../README.md\ndsdpv1\n```\n"), "")

    def test_the_parts_of_a_file(self):
        text = "```c\n// a.c: the first\nint a;\n```\nwords\n```yaml\n# b.yaml: another\n```\n```c\n// a.c: the second\nint b;\n```\n"
        self.assertEqual(commands.files(text), {"a.c": "// a.c: the first\nint a;\n\n// a.c: the second\nint b;\n", "b.yaml": "# b.yaml: another\n"})

    def test_the_files_of_a_page(self):
        self.assertEqual(page("```c\n/* a.c: first */\nint a;\n```\n```yaml\n# b.yaml: second\n```\n```c\nint c;\n```\n```sh\nls; tail -1 a.c\n```\n```text\na.c\nb.yaml\nint a;\n```\n"), "")

    def test_another_output(self):
        self.assertIn("page.md:2: echo 2\ndoes not print what the page shows", page("```sh\necho 2\n```\n```text\n1\n```\n"))

    def test_a_line_too_many(self):
        self.assertIn("does not print", page("```sh\necho 1; echo 2\n```\n```text\n1\n```\n"))

    def test_a_command_that_fails_in_the_middle(self):
        self.assertIn("page.md:2: false\ntrue\nends before its last command", page("```sh\nfalse\ntrue\n```\n"))

    def test_a_command_that_does_not_fail(self):
        self.assertIn("ends with 0, not 2", page("<!-- exit 2 -->\n```sh\ntrue\n```\n"))

    def test_what_runs_at_the_end_of_a_page_is_ended(self):
        self.assertEqual(page("```sh\nsleep 1000 &\necho $! > ~/../dsdpv1_page_sleep\n```\n"), "")
        left = pathlib.Path(tempfile.gettempdir(), "dsdpv1_page_sleep")
        self.assertNotEqual(subprocess.run(["kill", "-0", left.read_text(encoding="utf-8").strip()], capture_output=True, check=False).returncode, 0)
        left.unlink()


class Examples(unittest.TestCase):
    def test_a_module_that_is_missing_is_one_line(self):
        for name, page in (("python/pin_by_pin.py", "docs/python.md"), ("cocotb/run.py", "docs/cocotb.md")):
            with self.subTest(name):  # -S: without site-packages
                done = subprocess.run([sys.executable, "-I", "-S", commands.ROOT / "examples" / name], capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
                self.assertRegex(done.stderr, rf" has no .*numpy, dsdpv1.*, expected a Python with .*{page}")


class Guide(unittest.TestCase):
    def test_each_piece_of_code_is_a_file_that_is_compiled(self):
        text = (commands.ROOT / "docs/programmers_guide.md").read_text(encoding="utf-8")
        sources = commands.files(text)
        self.assertEqual(re.findall(r"^```(?:c|yaml)\n(?!(?:/\*|#) [\w.]+: ).*$", text, re.M), [])
        typed = " ".join([each.commands for each in commands.blocks(text)] + re.findall(r'^#include "(\w+\.h)"', "".join(sources.values()), re.M))
        self.assertEqual([name for name in sources if not re.search(rf"(?<!\w){re.escape(name)}(?!\w)", typed)], [])


class Tutorials(unittest.TestCase):
    def test_each_has_at_most_600_words(self):
        self.assertEqual([path.name for path in TUTORIALS if len(path.read_text(encoding="utf-8").split()) > 600], [])

    def test_each_is_typed_in_by_a_test(self):
        listed = (commands.ROOT / "tests/docs/CMakeLists.txt").read_text(encoding="utf-8")
        self.assertEqual([path.name for path in TUTORIALS if not re.search(rf"^ *dsdpv1_commands_of\(\w+ docs/tutorials/{path.stem}\)", listed, re.M)], [])
        self.assertTrue(TUTORIALS)


if __name__ == "__main__":
    unittest.main()
