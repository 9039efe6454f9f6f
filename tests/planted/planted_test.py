"""How faults are planted, in a project of three files; and invalid lists. Called with a C++ compiler."""
import dataclasses
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import faults
import lists
import mutants
import overlay
import suite
import switches

COMPILER = sys.argv.pop(1)
NINJA = """
rule cxx
  command = {compiler} -I{root} -O2 -MD -MT $out -MF $out.d -o $out -c $in
  depfile = $out.d
  deps = gcc
rule archive
  command = rm -f $out && ar qc $out $in && ranlib $out
rule link
  command = : && {compiler} -O2 $in -o $out  $libs && :
build together.o: cxx together.cpp
build main.o: cxx {root}/main.cpp
build lib/part.a: archive together.o
build tests/all/program: link main.o | lib/part.a
  libs = lib/part.a
build tests/all/deep/other: link {root}/other.cpp
"""


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


class Project(unittest.TestCase):
    """part.cpp and scale.hpp are compiled together with other files, as in the project's own build."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        write(self.root / "part/scale.hpp", "inline int scale() { return 3; }\n")
        write(self.root / "part/part.cpp", '#include "part/scale.hpp"\nint part() { return scale() + 1; }\n')
        write(self.root / "main.cpp", "int part();\nint main() { return part(); }\n")
        write(self.root / "other.cpp", "int main() { return 9; }\n")
        write(self.root / "build/together.cpp", f'#include "{self.root}/part/part.cpp"\n')
        write(self.root / "build/build.ninja", NINJA.format(compiler=COMPILER, root=self.root))
        (self.root / "tests/all/deep").mkdir(parents=True)
        subprocess.run(["ninja", "-C", self.root / "build", "--quiet"], check=True)
        self.build = overlay.Build(self.root / "build", self.root)

    def fault(self, **changes):
        fault = lists.Fault(list="driver", name="one", file="part/part.cpp", replace="+ 1", by="+ 2", what="wrong", where="driver.yaml:1")
        return dataclasses.replace(fault, **changes)

    def status_of(self, program):
        return subprocess.run([program], check=False).returncode

    def plant(self, fault):
        return overlay.Overlay(self.build, fault, self.root / "faults" / fault.name).link("tests/all/program")

    def test_a_source_that_is_compiled_together_with_others(self):
        self.assertEqual(self.status_of(self.plant(self.fault())), 5)

    def test_a_header(self):
        self.assertEqual(self.status_of(self.plant(self.fault(file="part/scale.hpp", replace="3", by="7"))), 8)

    def test_a_source_of_the_program_itself(self):
        self.assertEqual(self.status_of(self.plant(self.fault(file="main.cpp", replace="return part()", by="return part() + 40"))), 44)

    def test_sources_and_build_stay_as_they_are(self):
        before = {path: path.read_bytes() for path in self.root.rglob("*") if path.is_file()}
        self.plant(self.fault())
        self.assertEqual(before, {path: path.read_bytes() for path in before})
        self.assertEqual(self.status_of(self.root / "build/tests/all/program"), 4)

    def test_a_program_without_the_file_is_not_made(self):
        planted = overlay.Overlay(self.build, self.fault(), self.root / "faults/one")
        self.assertIsNone(planted.link(self.build.program("other")))

    def test_a_fault_that_does_not_compile_is_one_line(self):
        with self.assertRaisesRegex(overlay.Failed, r"^driver.yaml:1: one cannot be built: [^\n]+$"):
            self.plant(self.fault(by="+"))


class Lists(unittest.TestCase):
    RIGHT = "- {name: one, file: source.cpp, replace: 'a = 1', by: 'a = 2', what: a is wrong, rows: S3}\n"

    def read(self, text):
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            write(root / "source.cpp", "a = 1;\nb = 1;\n")
            write(root / "tests/planted/driver.yaml", "# a list\n" + text)
            return lists.read("driver", root, {"S3"})

    def test_a_right_one(self):
        fault = self.read(self.RIGHT)[0]
        self.assertEqual((fault.name, fault.by, fault.where), ("one", "a = 2", "tests/planted/driver.yaml:2"))

    def test_wrong_ones_are_one_line_with_file_and_line(self):
        for change, said in (
                (("a = 1", "a = 3"), "one: its text is not in source.cpp, expected once"),
                (("a = 1", "= 1"), "one: its text stands 2 times in source.cpp"),
                (("a = 2", "a = 1"), "one: nothing is changed"),
                (("source.cpp", "none.cpp"), "one: none.cpp is not there"),
                (("S3", "S4"), "one: there is no row S4"),
                (("by:", "buy:"), "unknown key buy"),
                ((", by: 'a = 2'", ""), "by is missing")):
            with self.assertRaisesRegex(lists.BadList, r"^tests/planted/driver.yaml:2: " + re.escape(said)):
                self.read(self.RIGHT.replace(*change))
        with self.assertRaisesRegex(lists.BadList, r"^tests/planted/driver.yaml:3: there is another one"):
            self.read(2 * self.RIGHT)

    def test_there_are_as_many_as_the_page_promises(self):
        counts = {name: len(lists.read(name)) for name in lists.NAMES}
        self.assertGreaterEqual(len(lists.read("mutants")), 300)
        self.assertGreaterEqual(counts["driver"], 20)
        self.assertGreaterEqual(counts["board"], 10)
        checks = "".join(path.read_text(encoding="utf-8") for path in lists.ROOT.glob("kinds/**/check_table.inc"))
        ids, names = set(re.findall(r'^X\(\w+, "(\w+)"', checks, re.M)), {fault.name for fault in lists.read("checks")}
        self.assertLessEqual(ids, names)
        self.assertEqual([name for name in names - ids if not any(name.startswith(f"{each}_") for each in ids)], [], "a second fault of a check")


class Output(unittest.TestCase):
    def test_the_first_case_that_failed(self):
        printed = "[ RUN      ] A.B/1\n[  FAILED  ] A.B/1, where GetParam() = 1 (2 ms)\n[  FAILED  ] A.C (1 ms)\n"
        self.assertEqual(faults.failed_test(printed), "A.B/1")

    def test_the_case_in_which_the_program_ended(self):
        self.assertEqual(faults.failed_test("[ RUN      ] A.B\n[       OK ] A.B (0 ms)\n[ RUN      ] A.C\nassertion"), "A.C")

    def test_cases_of_a_stage(self):
        cases = {"p": ["A.B", "D.E"]}
        self.assertEqual(suite.names_of(cases, suite.Stage("p", names="A.")), ["A.B"])


class Switches(unittest.TestCase):
    """All mutants of a source in one build: in a function, in a constant and what is made of it, in a table."""

    SOURCE = """#include <cstdio>
constexpr int kLimit = 3;  // { is no scope
constexpr int kTwice = kLimit * 2;
constexpr int twice(int value) { return value * 2; }
namespace {
struct Row {
  const char* name;
  int value;
};
constexpr Row kTable[] = {{"a", 1}, {"b", 2}};
}  // namespace
struct Counter {
  explicit Counter(int from) : at(from) {}
  bool over() const { return at > kLimit; }
  int at = 4;
};
int main() {
  int sum = 0;
  for (const auto& row : kTable) sum += row.value;
  std::printf("%d %d %d %d", sum, kTwice, twice(5), Counter(kLimit).over() ? 1 : 0);
}
"""
    MUTANTS = [("kLimit = 3", "kLimit = 4", "3 8 10 0"), ('"b", 2', '"b", 3', "4 6 10 0"), ("value * 2;", "value * 3;", "3 6 15 0"),
               ("at > kLimit;", "at >= kLimit;", "3 6 10 1"), ("at > kLimit; }", "true; }", "3 6 10 1"), ("at(from)", "at(from + 1)", "3 6 10 1")]

    def test_each_is_chosen_by_its_number(self):
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            write(root / "model/a.cpp", self.SOURCE)
            mutants = [lists.Fault("mutants", f"m{i}", "model/a.cpp", old, new, "wrong", "mutants.yaml:1") for i, (old, new, _) in enumerate(self.MUTANTS)]
            tree = switches.write_tree(root, mutants, root / "build/mutants")
            subprocess.run([COMPILER, "-std=c++17", "-w", "-include", tree / switches.HEADER, tree / "model/a.cpp", "-o", root / "a"], check=True)
            self.assertEqual((root / "model/a.cpp").read_text(encoding="utf-8"), self.SOURCE)
            for number, expected in enumerate(["3 6 10 0", *(printed for _, _, printed in self.MUTANTS)]):
                found = subprocess.run([root / "a"], env={"DSDPV1_MUTANT": str(number)}, capture_output=True, text=True, check=True).stdout
                self.assertEqual(found, expected, self.MUTANTS[number - 1] if number else "none")

    def test_what_cannot_be_switched_is_one_line(self):
        fault = lists.Fault("mutants", "m", "model/a.cpp", "kLimit = 3;", "kLimit = 3; int other;", "wrong", "mutants.yaml:1")
        with self.assertRaisesRegex(lists.BadList, r"^mutants.yaml:1: m: outside of a function"):
            switches.File("constexpr int kLimit = 3;\n", [(1, fault)]).switched()


class Mutants(unittest.TestCase):
    def test_only_an_assertion_of_a_test_counts(self):
        outcome = mutants.Outcome()
        running = outcome.read("[ RUN      ] A.Asserts\n/x/a_test.cpp:3: Failure\n[  FAILED  ] A.Asserts (1 ms)\n"
                               "[ RUN      ] A.Throws\nunknown file: Failure\n[  FAILED  ] A.Throws (1 ms)\n"
                               "[ RUN      ] R/A.Differs/1\n/x/twin_chip.cpp:9: Failure\n[  FAILED  ] R/A.Differs/1, where GetParam() = 1 (1 ms)\n"
                               "[ RUN      ] A.Right\n[       OK ] A.Right (0 ms)\n[ RUN      ] A.Skips\n[  SKIPPED ] A.Skips (0 ms)\n[ RUN      ] A.Ends\n")
        self.assertEqual(outcome.failed, ["A.Asserts"])
        self.assertEqual(outcome.others, {"A.Throws": "exception", "R/A.Differs/1": "twins differ"})
        self.assertEqual(list(outcome.passed), ["A.Right"])
        self.assertEqual(running, "A.Ends")
        self.assertIsNone(outcome.read("[ RUN      ] A.B\n[  FAILED  ] A.B (1 ms)\n[ RUN      ] A.C\n[  SKIPPED ] A.C (0 ms)\n"))
        self.assertNotIn("A.C", outcome.ended())

    def test_a_row_names_suites_and_tests_with_and_without_parameters(self):
        for case, name, found in (("A.B", "A", True), ("A.B", "A.B", True), ("R/A1.B/2", "A1.B", True), ("R/A1.B/Code2", "A1", True), ("A/0.B", "A.B", True),
                                  ("AB.C", "A", False), ("A.BC", "A.B", False)):
            self.assertEqual(mutants.matches(case, name), found, f"{case} {name}")



if __name__ == "__main__":
    unittest.main()
