"""Breaks a small project on purpose, to see that check_docs.py finds each kind of fault and nothing else."""
import unittest

import check_docs
import small_project

RIGHT = {
    "README.md": "# Top\n"
                 "See [the chip](docs/chip.md#its-rulings), `model/core.cpp`, `core.cpp` and [far](https://a.org).\n"
                 "```\n[no](link.md) in code\n```\n"
                 "<!-- from examples/one.cpp -->\n```cpp\nint main() {}\n```\n"
                 "`apt-get install ./dsdpv1_*.deb && dsdpv1-sim demo`, `pip install ./dsdpv1-*.whl && python -m dsdpv1 demo`, `./run demo`\n"
                 "<!-- trust: x -->\n<!-- /trust -->\n<!-- bare: x -->\n<!-- /bare -->\n",
    "docs/README.md": "# Documents\n| [chip.md](chip.md) | the chip |\n| [chip_rsu.md](chip_rsu.md) | the chip |\n| [install.md](install.md) | packages |\n| [tutorials/one.md](tutorials/one.md) | first |\n"
                      "".join(f"| [{name}.md]({name}.md) | figures |\n" for name in ("conformance", "trust", "performance", "calibrate")),
    "docs/tutorials/one.md": "# One\n",
    "docs/conformance.md": "| The DSDPV1 datasheet V1.1 | 404 | 387 | 17 |\n| The user software manual | 115 | 108 | 7 |\n| Rulings | 136 | 136 | 0 |\n3096 of all 3097 tests passed\n575 of 579 mutants are found by each of their rows\n",
    "docs/calibrate.md": "# A real chip\n",
    "docs/trust.md": "Of the SystemC modules: 97 of 97 found.\nOf the driver: 28 of 29 found.\n2026-11-25: 1 010 cycles, 101.0 % of the goal. No difference.\n",
    "docs/performance.md": "| `demo` | 4.93 | at least 3 x |\n| `core_vs_rtl` | 769 | at least 200 |\n22 of 28 goals are met.\n",
    "docs/install.md": "# Install\n<!-- packages: x -->\n| `./run` | groups |\n|---|---|\n| `demo`, `sim` | tools |\n"
                       "\n| group | packages | what they are |\n|---|---|---|\n| tools | cmake g++ | to build |\n<!-- /packages -->\n",
    "docs/trust/bare.tsv": "# head\n2026-01-02\tc\tdeb\t31\t18.3\t28\t1\t0\t2\t0.1\n2026-01-02\tc\twheel\t30\t14.1\t35\t36\t6\t2\t0.2\n"
                           "2026-01-02\tc\tsource\t173\t137.0\t60\t210\t400\t2\t0.3\n",
    "packages.txt": "# all\n\n# to build\n[tools]\ncmake\ng++\n",
    "run": "#!/bin/sh\nprintf 'demo\\ttools\\nsim\\ttools\\n'\n",
    "docs/chip.md": "# Chip\n## Its rulings\n- **P1**<a id=\"p1\"></a> [silent] a\n- **V1**<a id=\"v1\"></a> [documented in part] b\n",
    "docs/chip_rsu.md": "- **UA1**<a id=\"ua1\"></a> [firmware] a\n",
    "model/core.cpp": "// docs/chip.md#its-rulings, P1; docs/tutorials/one.md; not mydocs/two.md\n",
    "examples/one.cpp": "// one\nint main() {}\n",
}


class Project(small_project.SmallProject):
    RIGHT = RIGHT

    def setUp(self):
        super().setUp()
        (self.root / "run").chmod(0o755)
        check_docs.update_trust(self.root)
        check_docs.update_bare(self.root)

    def faults(self):
        found = []
        for check in (check_docs.check_links, check_docs.check_files, check_docs.check_mentions, check_docs.check_table, check_docs.check_trust, check_docs.check_snippets,
                      check_docs.check_bare, check_docs.check_packages, check_docs.check_marks):
            found += check(self.root)
        return found

    def expect(self, fault):
        faults = self.faults()
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(fault, faults[0])

    def test_a_right_project_has_no_fault(self):
        self.assertEqual(self.faults(), [])

    def test_a_link_to_nowhere(self):
        self.change("README.md", "docs/chip.md#its-rulings", "docs/chips.md")
        self.expect("README.md:2: the link docs/chips.md leads nowhere")

    def test_a_page_that_a_source_names_and_is_not_there(self):
        self.change("model/core.cpp", "tutorials/one.md", "two.md")
        self.expect("model/core.cpp:1: there is no docs/two.md")

    def test_an_anchor_in_a_source_that_no_heading_has(self):
        self.change("model/core.cpp", "#its-rulings", "#rulings")
        self.expect("model/core.cpp:1: no heading of docs/chip.md has the anchor #rulings")

    def test_an_anchor_that_no_heading_has(self):
        self.change("README.md", "#its-rulings", "#rulings")
        self.expect("has the anchor #rulings")

    def test_an_anchor_that_the_text_sets_itself_is_one(self):
        self.change("README.md", "#its-rulings", "#p1")
        self.assertEqual(self.faults(), [])

    def test_a_file_that_is_not_there(self):
        self.change("README.md", "`model/core.cpp`", "`model/heart.cpp`")
        self.expect("README.md:2: there is no model/heart.cpp")

    def test_a_bare_name_that_no_file_has(self):
        self.change("README.md", "`core.cpp`", "`heart.cpp`")
        self.expect("there is no heart.cpp")

    def test_a_ruling_without_a_mark(self):
        self.change("docs/chip.md", "[silent] ", "")
        self.expect("docs/chip.md:3: P1 has no mark")

    def test_a_mark_that_the_page_does_not_explain(self):
        self.change("docs/chip.md", "[documented in part]", "[written]")
        self.expect("docs/chip.md:4: V1 has the mark [written]")

    def test_a_mark_of_the_sister_chips(self):
        self.change("docs/chip_rsu.md", "[firmware]", "[documented, against itself]")
        self.expect("docs/chip_rsu.md:1: UA1 has the mark [documented, against itself]")

    def test_a_ruling_without_its_anchor(self):
        self.change("docs/chip.md", '<a id="v1"></a>', "")
        self.expect("docs/chip.md:4: V1 has no anchor, expected v1")

    def test_a_ruling_with_the_anchor_of_another(self):
        self.change("docs/chip.md", '<a id="v1"></a>', '<a id="p1"></a>')
        self.expect("docs/chip.md:4: V1 has the anchor p1, expected v1")

    def test_a_group_with_another_package(self):
        self.change("packages.txt", "g++\n", "ninja\n")
        self.expect("docs/install.md:2: packages.txt and ./run deps --commands say otherwise")

    def test_a_command_with_another_group(self):
        (self.root / "run").write_text("#!/bin/sh\nprintf 'demo\\ttools\\nsim\\ttools d3\\n'\n", encoding="utf-8")
        self.expect("docs/install.md:2: packages.txt and ./run deps --commands say otherwise")

    def test_a_document_that_the_table_does_not_name(self):
        self.write("docs/new.md", "# New\n")
        self.expect("docs/README.md:1: the tables of documents have no row for docs/new.md")

    def test_a_tutorial_that_the_table_does_not_name(self):
        self.write("docs/tutorials/new.md", "# New\n")
        self.expect("have no row for docs/tutorials/new.md")

    def test_a_snippet_that_the_example_has_no_more(self):
        self.change("examples/one.cpp", "int main() {}", "int main() { return 0; }")
        self.expect("README.md:6: this is not in examples/one.cpp")

    def test_figures_of_docs_that_have_changed(self):
        for page, old, new in (("conformance", "387", "386"), ("conformance", "3096", "3095"), ("trust", "28 of", "27 of"), ("trust", "1 010", "1 011"),
                               ("performance", "769", "7")):
            with self.subTest(page + old):
                self.change(f"docs/{page}.md", old, new)
                self.expect("README.md:11: the figures of docs/ are others")
                self.change(f"docs/{page}.md", new, old)

    def test_a_figure_that_a_page_has_no_more(self):
        self.change("docs/performance.md", "`demo`", "`other`")
        with self.assertRaisesRegex(SystemExit, "docs/performance.md:1: .* is there 0 times"):
            self.faults()

    def test_times_that_are_not_the_recorded_ones(self):
        self.assertIn("package 29 s, wheel 71 s. The first `./run demo` installs 2 packages (173 with dependencies,\n137.0 MB, 60 s) and compiles for 400 s of processor time",
                      (self.root / "README.md").read_text(encoding="utf-8"))
        for old, new in (("installs 2", "installs 3"), ("wheel 71", "wheel 17"), ("load of 0.1", "load of 0.0")):
            with self.subTest(new):
                self.change("README.md", old, new)
                self.expect("README.md:20: docs/trust/bare.tsv has other times")
                self.change("README.md", new, old)

    def test_a_command_that_is_not_the_measured_one(self):
        self.change("README.md", "install ./dsdpv1_*.deb", "install dsdpv1")
        self.expect("README.md:1: ./run release --record measures apt-get install ./dsdpv1_*.deb")


if __name__ == "__main__":
    unittest.main()
