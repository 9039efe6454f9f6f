"""Breaks a small project on purpose, to see that check_docs.py finds each kind of fault and nothing else."""
import unittest

import check_docs
import small_project

RIGHT = {
    "README.md": "# Top\n"
                 "See [the chip](docs/chip.md#its-rulings), `model/core.cpp`, `core.cpp` and [far](https://a.org).\n"
                 "```\n[no](link.md) in code\n```\n"
                 "<!-- from examples/one.cpp -->\n```cpp\nint main() {}\n```\n"
                 "<!-- demo: x -->\n```\nat 1.5 us\nin 0.5 s: 2.0 times faster than real time\n```\n<!-- /demo -->\n"
                 "| [docs/chip.md](docs/chip.md) | the chip |\n| [docs/install.md](docs/install.md) | packages |\n",
    "docs/install.md": "# Install\n<!-- packages: x -->\n| `./run` | groups |\n|---|---|\n| `demo`, `sim` | tools |\n"
                       "\n| group | packages | what they are |\n|---|---|---|\n| tools | cmake g++ | to build |\n<!-- /packages -->\n",
    "packages.txt": "# all\n\n# to build\n[tools]\ncmake\ng++\n",
    "run": "#!/bin/sh\nprintf 'demo\\ttools\\nsim\\ttools\\n'\n",
    "docs/chip.md": "# Chip\n## Its rulings\n- **P1** a\n- **V1** b\n",
    "model/core.cpp": "",
    "examples/one.cpp": "// one\nint main() {}\n",
    "sim": "#!/bin/sh\necho 'at 1.5 us'\necho 'in 0.7 s: 1.4 times slower than real time'\n",
}


class Project(small_project.SmallProject):
    RIGHT = RIGHT

    def setUp(self):
        super().setUp()
        for name in ("sim", "run"):
            (self.root / name).chmod(0o755)

    def faults(self):
        found = []
        for check in (check_docs.check_links, check_docs.check_files, check_docs.check_table, check_docs.check_snippets, check_docs.check_packages):
            found += check(self.root)
        return found + list(check_docs.check_readme(self.root, str(self.root / "sim")))

    def expect(self, fault):
        faults = self.faults()
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(fault, faults[0])

    def test_a_right_project_has_no_fault(self):
        self.assertEqual(self.faults(), [])

    def test_a_link_to_nowhere(self):
        self.change("README.md", "docs/chip.md#its-rulings", "docs/chips.md")
        self.expect("README.md:2: the link docs/chips.md leads nowhere")

    def test_an_anchor_that_no_heading_has(self):
        self.change("README.md", "#its-rulings", "#rulings")
        self.expect("has the anchor #rulings")

    def test_a_file_that_is_not_there(self):
        self.change("README.md", "`model/core.cpp`", "`model/heart.cpp`")
        self.expect("README.md:2: there is no model/heart.cpp")

    def test_a_bare_name_that_no_file_has(self):
        self.change("README.md", "`core.cpp`", "`heart.cpp`")
        self.expect("there is no heart.cpp")

    def test_a_group_with_another_package(self):
        self.change("packages.txt", "g++\n", "g++\nninja\n")
        self.expect("docs/install.md:2: packages.txt and ./run deps --commands say otherwise")

    def test_a_command_with_another_group(self):
        (self.root / "run").write_text("#!/bin/sh\nprintf 'demo\\ttools\\nsim\\ttools d3\\n'\n", encoding="utf-8")
        self.expect("docs/install.md:2: packages.txt and ./run deps --commands say otherwise")

    def test_a_document_that_the_table_does_not_name(self):
        self.write("docs/new.md", "# New\n")
        self.expect("README.md:1: the table of documents has no row for docs/new.md")

    def test_a_snippet_that_the_example_has_no_more(self):
        self.change("examples/one.cpp", "int main() {}", "int main() { return 0; }")
        self.expect("README.md:6: this is not in examples/one.cpp")

    def test_a_stale_figure(self):
        self.change("sim", "1.5 us", "1.6 us")
        (self.root / "sim").chmod(0o755)
        self.expect("the demo's line 1 is now: at 1.6 us")

    def test_a_line_too_many(self):
        self.change("README.md", "at 1.5 us\n", "at 1.5 us\nand more\n")
        self.expect("the demo's line 2 is now")


if __name__ == "__main__":
    unittest.main()
