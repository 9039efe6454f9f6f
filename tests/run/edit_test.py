"""./run edit with a changed file of a made-up project: the tests that it selects, and those that it does not."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cmake"))

import edit  # noqa: E402

FILES = {
    "bus/line.hpp": "",
    "bus/line.cpp": '#include "bus/line.hpp"\n',
    "bus/far.hpp": "",
    "bus/far.cpp": '#include "bus/far.hpp"\n',
    "bus/near.hpp": '#include "bus/far.hpp"\n',
    "apps/serve_command.cpp": '#include "apps/serve_command.hpp"\n',
    "apps/serve_command.hpp": "",
    "apps/lonely.cpp": "",
    "tests/bus/line_test.cpp": '#include "bus/line.hpp"\nTEST(Line, IsQuiet) {}\nTEST_P(Rates, All) {}\n',
    "tests/bus/bench.hpp": '#include "bus/near.hpp"\n',
    "tests/bus/near_test.cpp": '#include "tests/bus/bench.hpp"\nTEST_F(Near, Is) {}\n',
    "io/names.hpp": "",
    "tests/io/names_test.cpp": '#include "io/names.hpp"\nTEST(Names, AreNames) {}\n',
    "tests/serve/names_test.cpp": '#include "io/names.hpp"\nTEST(Far, Away) {}\n',
    "tests/serve/port_test.cpp": "TEST(Port, Opens) {}\n",
}
LINE = {"Line.*", "*/Line.*", "Line/*.*", "Rates.*", "*/Rates.*", "Rates/*.*"}


class Concerns(unittest.TestCase):
    def setUp(self):
        sources = edit.Sources(edit.collections.defaultdict(set), {})
        for name, text in FILES.items():
            sources.add(name, text)
        programs = {name: {f"program_{pathlib.Path(name).stem}"} for name in FILES if name.startswith("tests/")}
        self.concern = edit.Concern(sources, programs)

    def of(self, file, **named):
        added = self.concern.add(file, lambda each: set(named.get("ctest", ())))
        return added, dict(self.concern.filters), self.concern.ctest

    def test_a_source_of_tests_its_own_suites(self):
        self.assertEqual(self.of("tests/bus/line_test.cpp"), (True, {"program_line_test": LINE}, set()))

    def test_a_source_those_that_include_its_header(self):
        self.assertEqual(self.of("bus/line.cpp"), (True, {"program_line_test": LINE}, set()))

    def test_of_those_the_ones_in_the_folder_of_its_room(self):
        self.assertEqual(self.of("io/names.hpp"), (True, {"program_names_test": {"Names.*", "*/Names.*", "Names/*.*"}}, set()))

    def test_where_nobody_does_those_that_include_what_includes_it(self):
        self.assertEqual(self.of("bus/far.cpp"), (True, {"program_near_test": {"Near.*", "*/Near.*", "Near/*.*"}}, set()))

    def test_where_there_are_none_those_of_the_folder_of_its_name(self):
        self.assertEqual(self.of("apps/serve_command.cpp"), (True, {"program_port_test": {"Port.*", "*/Port.*", "Port/*.*"}, "program_names_test": {"Far.*", "*/Far.*", "Far/*.*"}}, set()))

    def test_what_concerns_nothing_is_said(self):
        self.assertEqual(self.of("apps/lonely.cpp"), (False, {}, set()))
        self.assertEqual(self.of("unknown.txt"), (False, {}, set()))

    def test_a_script_the_tests_that_call_it(self):
        self.assertEqual(self.of("tests/bus/run_test.py", ctest=["Bus.Runs"]), (True, {}, {"Bus.Runs"}))

    def test_reference_rtl_its_lint(self):
        self.assertEqual(self.of("rtl_ref/dsdpv1/dsdpv1.sv"), (True, {}, {"Rtl.LintFindsNothing"}))

    def test_a_file_with_planted_faults_or_mutants_whether_their_lists_fit(self):
        self.assertEqual(edit.planted("model/profibus/uart_rx.cpp"), {"Mutants.FitTheSourcesAndTheRows"})
        self.assertEqual(edit.planted("kinds/dsdpv1/checks/refusals.cpp"), {"PlantedFaults.FitTheSources"})
        self.assertEqual(edit.planted("tests/planted/mutants.yaml"), {"Mutants.FitTheSourcesAndTheRows"})
        self.assertEqual(edit.planted("tests/planted/spc3_mutants.yaml"), {"Mutants.OfTheSpc3FitTheSourcesAndThePage"})
        self.assertEqual(edit.planted("bus/line.cpp"), set())
        self.assertEqual(self.of("tests/planted/driver.yaml"), (True, {}, {"PlantedFaults.FitTheSources"}))

    def test_a_file_of_the_model_the_tests_of_its_rulings(self):
        self.assertIn("UserReset", edit.ruled("model/dsdpv1/chip.cpp"))
        self.assertEqual(edit.ruled("bus/line.cpp"), set())
        self.assertEqual(edit.patterns("Services.InOrder"), {"Services.InOrder", "*/Services.InOrder*", "Services/*.InOrder"})


class Times(unittest.TestCase):
    TIMES = {"one": {"A.Short": 1, "A.Long": 6, "B.Other": 0.5}, "two": {"All/A.Rate/3": 2}}

    def test_the_shortest_of_those_that_concern_fit(self):
        filters = {"one": {"A.*"}, "two": {"*/A.*"}, "three": {"A.*"}}
        self.assertEqual(edit.too_long(filters, self.TIMES, 3), ({"one": {"A.Long"}}, 6))
        self.assertEqual(edit.too_long(filters, self.TIMES, 2), ({"one": {"A.Long"}, "two": {"All/A.Rate/3"}}, 8))
        self.assertEqual(edit.too_long(filters, self.TIMES, edit.math.inf), ({}, 0))


if __name__ == "__main__":
    unittest.main()
