"""Breaks a small project's clauses on purpose, to see that docs/conformance/generate.py finds each kind of fault and nothing else."""
import contextlib
import io
import pathlib
import sys
import unittest
import unittest.mock

import small_project

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs/conformance"))
import check  # noqa: E402
import data  # noqa: E402
import generate  # noqa: E402

RIGHT = {
    "docs/chip.md": "- **P1** a\n- **V1** b\n",
    "docs/chip_rsu.md": "- **SP1** c\n",
    "docs/conformance/rulings.yaml": "P1:\n  tests: [Core.Works (when on), Install.Core]\n  model: [core.cpp]\n  rtl: [core.sv]\n"
                                     "V1: {tests: [Core], model: [model/core.cpp], rtl: []}\n"
                                     "SP1: {tests: [Core.Works], model: [model/core.cpp], rtl: []}\n",
    "docs/conformance/datasheet.yaml": "title: Sheet\ntext: Its text.\nplaces: ['1', T1..T2]\nparts:\n- title: All\n  clauses:\n"
                                       "  - {at: 1, says: a number, ruled: [P1]}\n"
                                       "  - {at: T1-A, says: 'one|two', tests: [scenarios/one.yaml], model: [core.cpp]}\n"
                                       "  - {at: T2, says: a size, reason: not modelled}\n",
    "docs/conformance/manual.yaml": "title: Manual\ntext: Its text.\nplaces: [M1]\nparts:\n- title: M1 Words\n  model: [core.cpp]\n"
                                    "  clauses:\n  - {at: M1-1, says: the same, same_as: [T1]}\n",
    "docs/conformance/test_plan.yaml": "sections:\n- title: Pins\n  text: See `Core`.\n  rulings: P\n- title: V\n  rulings: V\n- title: SP\n  rulings: SP\n"
                                       "- title: Around\n  head: [part, tests]\n  rows:\n  - [all, [Core.Works]]\n",
    "docs/conformance/index.yaml": "- {at: 1, find: a number, ruled: [P1]}\n- {at: T1, find: a letter}\n- {find: silence, ruled: [V1]}\n- {at: M1}\n",
    "docs/architecture.md": "By hand.\n<!-- clauses -->\n<!-- /clauses -->\nBy hand.\n",
    "model/core.cpp": "",
    "rtl_ref/core.sv": "",
    "scenarios/one.yaml": "",
    "tests/core_test.cpp": "TEST_F(Core, Works) {\n",
    "tests/CMakeLists.txt": "set(more more_test.cpp)\ndsdpv1_test(core_test core_test.cpp ${more})\nfunction(try name)\n  add_test(NAME Install.${name}\n)\nendfunction()\ntry(Core x)\n",
    "build/tests.commit": "1a2b3c4\n",
    "build/tests.xml": '<testsuite><testcase name="Core.Works" status="run"/><testcase name="Install.Core" status="run"/>'
                       '<testcase name="All/Scenarios.Pass/one  # GetParam() = &quot;one.x&quot;" status="run"/>'
                       '<testcase name="Core.Else" status="run"/></testsuite>',
}
SHEET = "docs/conformance/datasheet.yaml"
RULINGS = "docs/conformance/rulings.yaml"


class Conformance(small_project.SmallProject):
    RIGHT = RIGHT

    def generate(self, *arguments):
        """Exit status, and all that is printed."""
        output = io.StringIO()
        with unittest.mock.patch("sys.argv", ["generate.py", "--root", str(self.root), *map(str, arguments)]), \
                contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            status = generate.main()
        return status, output.getvalue()

    def expect(self, *faults):
        """These faults alone, and the command ends with 1."""
        found = list(check.check(self.root, data.load(self.root)))
        self.assertEqual(len(found), len(faults), found)
        for fault, line in zip(faults, found):
            self.assertIn(fault, line)
        self.assertEqual(self.generate()[0], 1 if faults else 0)

    def expect_bad(self, line):
        """One line, exit 2, nothing written."""
        self.assertEqual(self.generate(), (2, line + "\n"))
        self.assertFalse((self.root / "docs/conformance.md").exists())

    # ------------------------------------------------------------------------------------------------------ the pages
    def test_a_right_project_has_no_fault(self):
        self.expect()
        self.assertEqual(self.generate("--check"), (0, "conformance: right\n"))
        page = self.text("docs/conformance.md")
        self.assertIn("| <a id=\"1\"></a>1 | a number | P1 | [core.cpp](../model/core.cpp) | [core.sv](../rtl_ref/core.sv) | "
                      "core_test: `Core.Works` (when on), ctest: `Install.Core` | not run |", page)
        self.assertIn("| <a id=\"t1-a\"></a>T1-A | one\\|two | - | [core.cpp](../model/core.cpp) | - | ctest: `scenarios/one.yaml` | not run |", page)
        self.assertIn("| T2 | not modelled |", page)
        self.assertIn("| <a id=\"m1-1\"></a>M1-1 | the same | - | [core.cpp](../model/core.cpp) | - | ctest: `scenarios/one.yaml` | not run |", page)
        self.assertIn("| P1 | core_test: `Core.Works` (when on), ctest: `Install.Core` |", self.text("docs/test_plan.md"))
        self.assertIn("| all | core_test: `Core.Works` |", self.text("docs/test_plan.md"))

    def test_a_page_that_is_stale_or_missing(self):
        self.generate()
        self.change("docs/conformance.md", "a number", "a word")
        (self.root / "docs/test_plan.md").unlink()
        status, output = self.generate("--check")
        self.assertEqual(status, 1)
        self.assertEqual(output, "docs/conformance.md:1: stale; ./run generate writes it again\n"
                                 "docs/test_plan.md:1: stale; ./run generate writes it again\n")

    def test_the_table_of_the_architecture(self):
        self.expect()
        core, rtl = "[core.cpp](../model/core.cpp)", "[core.sv](../rtl_ref/core.sv)"
        self.assertEqual(self.text("docs/architecture.md"), "By hand.\n<!-- clauses -->\n| clause | what | ruling | model | RTL |\n|---|---|---|---|---|\n"
                         f"| 1 | a number | P1 | {core} | {rtl} |\n| T1 | a letter | - | {core} | - |\n| - | silence | V1 | {core} | - |\n"
                         f"| M1 | Words | - | {core} | - |\n<!-- /clauses -->\nBy hand.\n")
        self.change("docs/architecture.md", "a letter", "a word")
        self.assertEqual(self.generate("--check"), (1, "docs/architecture.md:1: stale; ./run generate writes it again\n"))

    def test_a_row_of_that_table_with_a_ruling_that_does_not_exist(self):
        self.change("docs/conformance/index.yaml", "[V1]", "[V1, V9]")
        self.expect(f"docs/conformance/index.yaml:3: row silence: there is no ruling V9 in {RULINGS}")

    def test_a_row_of_that_table_without_a_file(self):
        self.change("docs/conformance/index.yaml", "{at: T1,", "{at: T2,")
        self.expect("docs/conformance/index.yaml:2: row a letter: neither its rulings nor its clauses name a file of the model")

    # --------------------------------------------------------------------------------------------------------- clauses
    def test_a_clause_without_a_test_is_found_and_listed(self):
        self.change(SHEET, "ruled: [P1]", "model: [core.cpp]")
        self.expect(f"{SHEET}:7: clause 1 has no test; give it tests: [...]")
        page = self.text("docs/conformance.md")
        self.assertIn("Neither a test nor a reason: 1.\n", page)
        self.assertIn("| <a id=\"1\"></a>1 | a number | - | [core.cpp](../model/core.cpp) | - | **NO TEST** | - |", page)

    def test_a_test_needs_its_suite_and_a_file_that_is_no_scenario_is_none(self):
        for name in ("Works", "model/core.cpp"):
            self.change(SHEET, "[scenarios/one.yaml]", f"[{name}]")
            self.expect(f"{SHEET}:8: clause T1-A: there is no test {name}", f"M1-1: there is no test {name}")
            self.change(SHEET, f"[{name}]", "[scenarios/one.yaml]")

    def test_a_suite_in_two_programs(self):
        self.write("tests/more_test.cpp", "TEST(Core, Else) {\n")
        self.expect()
        self.change("tests/CMakeLists.txt", "function(try", "dsdpv1_test(other_test more_test.cpp)\nfunction(try")
        self.expect("tests/: suite Core is in core_test and other_test; rename one")

    def test_a_repeated_clause_without_a_test(self):
        self.change(SHEET, "tests: [scenarios/one.yaml]", "tests: []")
        self.expect(f"{SHEET}:8: clause T1-A has no test", "manual.yaml:8: clause M1-1 has no test")

    def test_a_reason_holds_for_the_clause_that_repeats(self):
        self.change("docs/conformance/manual.yaml", "[T1]", "[T2]")
        self.expect()
        self.assertIn("| M1-1 | not modelled |", self.text("docs/conformance.md"))

    def test_a_test_of_a_clause_that_does_not_exist(self):
        self.change(SHEET, "ruled: [P1]", "ruled: [P1], tests: [Core.Runs]")
        self.expect(f"{SHEET}:7: clause 1: there is no test Core.Runs")

    def test_a_scenario_that_does_not_exist(self):
        (self.root / "scenarios/one.yaml").unlink()
        self.expect(f"{SHEET}:8: clause T1-A: there is no test scenarios/one.yaml", "M1-1: there is no test scenarios/one.yaml")

    def test_a_ruling_of_a_clause_that_does_not_exist(self):
        self.change(SHEET, "ruled: [P1]", "ruled: [P1, P7]")
        self.expect(f"{SHEET}:7: clause 1: there is no ruling P7 in {RULINGS}")

    def test_a_file_of_a_clause_that_does_not_exist(self):
        self.change(SHEET, "ruled: [P1]", "ruled: [P1], rtl: [heart.sv]")
        self.expect(f"{SHEET}:7: clause 1: there is no file heart.sv in ./ or rtl_ref/")

    def test_a_clause_without_a_file_of_the_model(self):
        self.change(SHEET, "tests: [scenarios/one.yaml], model: [core.cpp]", "tests: [scenarios/one.yaml]")
        self.change("docs/conformance/index.yaml", "- {at: T1, find: a letter}\n", "")
        self.expect(f"{SHEET}:8: clause T1-A has tests but no file")

    def test_a_place_without_a_clause(self):
        self.change(SHEET, "T1..T2", "T1..T3")
        self.expect(f"{SHEET}:1: Sheet has T3, but no clause is called T3 or T3-...")

    def test_a_clause_at_no_place(self):
        self.change(SHEET, "at: T2", "at: T21")
        self.expect("Sheet has T2, but no clause", f"{SHEET}:9: clause T21 is at none of the places of Sheet")

    def test_a_clause_that_is_there_twice(self):
        self.change(SHEET, "at: T2,", "at: 1,")
        self.change(SHEET, "T1..T2", "T1")
        self.expect(f"{SHEET}:9: clause 1 is there twice")

    # --------------------------------------------------------------------------------------------------------- rulings
    def test_a_ruling_that_is_missing(self):
        self.change("docs/chip.md", "- **V1**", "- **P2** new\n- **V1**")
        self.expect(f"{RULINGS}:1: ruling P2 of docs/chip.md is missing; add a line like P2: {{tests: ")

    def test_a_ruling_that_is_gone(self):
        self.change("docs/chip.md", "- **V1** b\n", "")
        self.expect(f"{RULINGS}:5: docs/chip.md has no ruling V1")

    def test_a_ruling_of_the_other_page(self):
        self.change("docs/chip_rsu.md", "- **SP1** c\n", "- **UA2** c\n")
        self.expect(f"{RULINGS}:1: ruling UA2 of docs/chip_rsu.md is missing; add a line like UA2: {{tests: ",
                    f"{RULINGS}:6: docs/chip_rsu.md has no ruling SP1")

    def test_a_ruling_without_a_test(self):
        self.change(RULINGS, "[Core]", "[]")
        self.expect(f"{RULINGS}:5: ruling V1 names no test")

    def test_a_test_of_a_ruling_that_is_gone(self):
        self.change("tests/CMakeLists.txt", "try(Core", "try(Driver")
        self.change(SHEET, "ruled: [P1]", "ruled: [V1]")
        self.expect(f"{RULINGS}:1: ruling P1: there is no test Install.Core")

    def test_a_file_of_a_ruling_that_is_gone(self):
        self.change(RULINGS, "[core.sv]", "[soul.sv]")
        self.change(SHEET, "ruled: [P1]", "ruled: [V1]")
        self.expect(f"{RULINGS}:1: ruling P1: there is no file soul.sv")

    # ------------------------------------------------------------------------------------------------------- test plan
    def test_rulings_that_the_plan_lacks(self):
        self.change("docs/conformance/test_plan.yaml", "  rulings: V\n", "  text: none\n")
        self.expect("test_plan.yaml:1: the rulings V... stand in 0 sections")

    def test_a_test_in_the_plans_text_that_does_not_exist(self):
        self.change("docs/conformance/test_plan.yaml", "`Core`", "`Heart`")
        self.expect("test_plan.yaml:2: there is no test Heart")

    def test_a_row_of_the_plan_with_a_test_that_does_not_exist(self):
        self.change("docs/conformance/test_plan.yaml", "[Core.Works]", "[Core.Rests]")
        self.expect("Around: there is no test Core.Rests")

    def test_a_row_of_the_plan_with_too_many_cells(self):
        self.change("docs/conformance/test_plan.yaml", "[all, ", "[all, more, ")
        self.expect("a row of Around has 3 cells, its head has 2")

    # -------------------------------------------------------------------------------------------------------- bad data
    def test_a_key_that_does_not_exist(self):
        self.change(SHEET, "ruled:", "rules:")
        self.expect_bad(f"{SHEET}:7: a clause has no key rules, expected at, says, ruled, same_as, tests, model, rtl, reason")

    def test_a_key_that_is_missing(self):
        self.change(RULINGS, ", rtl: []", "")
        self.expect_bad(f"{RULINGS}:5: ruling V1 needs the key rtl")

    def test_a_ruling_with_two_entries(self):
        self.change(RULINGS, "V1:", "P1:")
        self.expect_bad(f"{RULINGS}:5: P1 is there twice, expected once")

    def test_tests_and_a_reason(self):
        self.change(SHEET, "reason: not modelled", "reason: not modelled, tests: [Core]")
        self.expect_bad(f"{SHEET}:9: clause T2 has tests and a reason for having none, expected one of them")

    def test_a_word_where_a_list_must_be(self):
        self.change(SHEET, "[P1]", "P1")
        self.expect_bad(f"{SHEET}:7: ruled must be a list of names, like [one, two]")

    def test_a_repeated_place_that_no_earlier_clause_has(self):
        self.change("docs/conformance/manual.yaml", "[T1]", "[T9]")
        self.expect_bad("docs/conformance/manual.yaml:8: no clause of an earlier document is at T9")

    def test_a_row_of_the_table_at_no_place(self):
        self.change("docs/conformance/index.yaml", "{at: T1,", "{at: T9,")
        self.expect_bad("docs/conformance/index.yaml:2: no clause of a document is at T9")

    def test_a_row_of_the_table_without_a_name(self):
        self.change("docs/conformance/index.yaml", ", find: a letter", "")
        self.expect_bad("docs/conformance/index.yaml:2: a row needs the key find, unless a part's title begins with its place")

    def test_a_page_without_the_table(self):
        self.change("docs/architecture.md", "<!-- clauses -->", "")
        self.assertEqual(self.generate(), (2, "docs/architecture.md:1: the table between <!-- clauses --> and <!-- /clauses --> is missing\n"))

    def test_what_is_no_yaml(self):
        self.change(SHEET, "{at: 1", "{at: 1: 2")
        self.assertEqual(self.generate()[0], 2)

    # --------------------------------------------------------------------------------------------------------- results
    def report(self):
        page = self.root / "build/page.md"
        return *self.generate("--report", page, "--run", self.root / "build/tests.xml"), page.read_text(encoding="utf-8")

    def test_the_results_of_a_run(self):
        status, output, page = self.report()
        self.assertEqual((status, output), (0, "conformance: 4 clauses: 3 passed, 0 failed, 0 not run, 1 cannot have a test, 0 have none: "
                                               f"{self.root}/build/page.md\n"))
        self.assertIn("`Install.Core` | 2 of 2 |", page)
        self.assertIn("`scenarios/one.yaml` | 1 of 1 |", page)
        self.assertIn("| V1 | - | [core.cpp](../model/core.cpp) | - | core_test: `Core` | 2 of 2 |", page)
        self.assertIn("run of commit 1a2b3c4,", page)
        self.assertIn("4 of all 4 tests passed", page)
        self.assertFalse((self.root / "docs/conformance.md").exists())

    def test_a_failed_test(self):
        self.change("build/tests.xml", 'name="Core.Works" status="run"', 'name="Core.Works" status="fail"')
        status, output, page = self.report()
        self.assertEqual(status, 1)
        self.assertIn("conformance: Core.Works failed\n", output)
        self.assertIn("`Install.Core` | 1 of 2, FAILED Core.Works |", page)

    def test_a_test_that_was_not_run(self):
        self.change("build/tests.xml", "/one", "/two")
        status, output, page = self.report()
        self.assertEqual(status, 1)
        self.assertIn("named by rulings and clauses, but not run: scenarios/one.yaml\n", output)
        self.assertIn("ctest: `scenarios/one.yaml` | not run |", page)

    def test_a_recorded_run_is_shown_until_the_next_is_recorded(self):
        self.assertEqual(self.generate("--record", "--run", self.root / "build/tests.xml")[0], 0)
        recorded = self.text("docs/conformance.md")
        self.assertIn("`Install.Core` | 2 of 2 |", recorded)
        self.assertIn("run of commit 1a2b3c4,", recorded)
        self.change("build/tests.xml", 'name="Core.Works" status="run"', 'name="Core.Works" status="fail"')
        self.assertEqual(self.generate("--check")[0], 0)
        self.generate()
        self.assertEqual(self.text("docs/conformance.md"), recorded)
        self.generate("--record", "--run", self.root / "build/tests.xml")
        self.assertIn("FAILED Core.Works", self.text("docs/conformance.md"))

    def test_tests_that_are_newer_than_the_recorded_run(self):
        self.generate()
        self.assertIn("4 of the 4 tests that rulings and clauses name are newer than this run, as Core; ./run test, then", self.generate("--released")[1])
        self.generate("--record", "--run", self.root / "build/tests.xml")
        self.assertIn("Rulings and clauses name 4 tests; none is newer than this run (*not run*).", self.text("docs/conformance.md"))
        self.assertEqual(self.generate("--released"), (0, "conformance: right\n"))
        self.write("tests/core_test.cpp", "TEST_F(Core, Works) {\nTEST_F(Core, Rests) {\n")
        self.change(SHEET, "ruled: [P1]", "ruled: [P1], tests: [Core.Rests]")
        self.generate()
        self.assertIn("Rulings and clauses name 5 tests; 1 is newer than this run (*not run*).", self.text("docs/conformance.md"))
        self.assertEqual(self.generate("--check")[0], 0)
        self.assertEqual(self.generate("--released"), (1, "docs/conformance/last_run.txt:1: 1 of the 5 tests that rulings and clauses name are newer than "
                                                          "this run, as Core.Rests; ./run test, then ./run conformance --record\n"))

    def test_a_run_of_which_nobody_knows_the_commit(self):
        (self.root / "build/tests.commit").unlink()
        status, output = self.generate("--record", "--run", self.root / "build/tests.xml")
        self.assertEqual((status, output), (2, f"{self.root}/build/tests.commit:1: there is no such file; ./run test makes it\n"))


if __name__ == "__main__":
    unittest.main()
