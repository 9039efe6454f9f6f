"""Properties outside the code: the list of symbols, the library's dependencies, and that each header compiles alone.

    library_test.py SOURCES LIBRARY CC CXX [unittest arguments]
"""
import pathlib
import re
import subprocess
import sys
import unittest

ROOT, LIBRARY, CC, CXX = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3], sys.argv[4]
HEADERS = sorted((ROOT / "include/dsdpv1").glob("*.h"))
WARNINGS = ["-Wall", "-Wextra", "-pedantic", "-Wconversion", "-Wshadow", "-Werror", "-fsyntax-only"]


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def declared():
    return {name for header in HEADERS for name in re.findall(r"^DPSIM_API\b[^;(]*?(\w+)\(", header.read_text(), re.M)}


class Symbols(unittest.TestCase):
    def test_the_list_has_what_the_headers_declare(self):
        listed = re.findall(r"^    (\w+);$", (ROOT / "capi/symbols.map").read_text(), re.M)
        self.assertEqual(listed, sorted(declared()))

    def test_the_library_exports_the_list_and_nothing_else(self):
        lines = output("nm", "-D", "--defined-only", LIBRARY).split("\n")
        exported = {line.split()[-1] for line in lines if line and line.split()[-2] != "A"}
        self.assertEqual(exported, {name + "@@DSDPV1_0" for name in declared()})

    def test_each_function_is_declared_with_the_prefix(self):
        self.assertEqual([name for name in declared() if not name.startswith("dpsim_")], [])


class Needs(unittest.TestCase):
    dynamic = output("readelf", "-d", LIBRARY)

    def test_its_name_carries_the_number_of_the_abi(self):
        major = re.search(r"DPSIM_ABI_MAJOR (\d+)", (ROOT / "include/dsdpv1/types.h").read_text()).group(1)
        self.assertIn(f"Library soname: [libdsdpv1.so.{major}]", self.dynamic)

    def test_neither_board_nor_systemc_is_needed(self):
        needed = re.findall(r"Shared library: \[(.*?)\]", self.dynamic)
        self.assertTrue(needed)
        self.assertEqual([name for name in needed if re.search("libdw|systemc", name)], [])

    def test_its_text_is_position_independent(self):
        self.assertNotIn("TEXTREL", self.dynamic)


class Headers(unittest.TestCase):
    def test_each_stands_alone_in_c_and_in_cpp(self):
        for header in HEADERS:
            for compiler, language, standard in ((CC, "c", "c99"), (CC, "c", "c11"), (CXX, "c++", "c++17")):
                with self.subTest(header=header.name, standard=standard):
                    done = subprocess.run([compiler, "-x", language, f"-std={standard}", *WARNINGS, f"-I{ROOT}/include", "-"],
                                          input=f'#include "dsdpv1/{header.name}"\n', capture_output=True, text=True, check=False)
                    self.assertEqual(done.stderr + str(done.returncode), "0")

    def test_the_first_one_has_all_others(self):
        text = (ROOT / "include/dsdpv1/dsdpv1.h").read_text()
        for header in HEADERS:
            if header.name != "dsdpv1.h":
                self.assertIn(f'#include "dsdpv1/{header.name}"', text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
