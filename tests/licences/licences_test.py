"""Breaks a small project on purpose, to see that check_licences.py finds each kind of fault and nothing else."""
import os
import pathlib
import tempfile
import unittest

import check_licences
import ninja_build

PAGE = """<!-- licences -->
| what | packages | licence | use | into |
|---|---|---|---|---|
| Emulator | `libemu-dev` | GPL-2.0-only | linked | `board`, tests |
| Kernel | `libkernel-dev` | Apache-2.0 | linked | `sim`, tests |
| Words | `libwords-dev` | MIT | linked | `sim`, `board` |
| Page | `page` | Apache-2.0 OR ISC | embedded | `sim`, `board` |
| Tool | `tool`, `helper` | GPL-3.0-or-later | build | - |
<!-- /licences -->
"""
REUSE = """version = 1
[[annotations]]
path = "**"
SPDX-License-Identifier = "Apache-2.0"
[[annotations]]
path = ["src/**", "one/*.cpp"]
SPDX-License-Identifier = "Apache-2.0 OR MIT"
[[annotations]]
path = "src/kernel/**"
SPDX-License-Identifier = "Apache-2.0"
"""
SOURCES = {"libemu-dev": "emu", "libkernel-dev": "kernel", "libwords-dev": "words"}


def source(package):
    return SOURCES.get(package, package)


def rows(page=PAGE):
    return check_licences.rows_of(page)


class Programs(unittest.TestCase):
    def expect(self, name, found, *faults, page=PAGE):
        self.assertEqual(list(check_licences.faults_of_program(name, found, rows(page), source)), list(faults))

    def test_what_the_table_lists_is_right(self):
        self.expect("apps/sim", {"kernel", "words"})
        self.expect("apps/board", {"emu", "words"})
        self.expect("tests/a/kernel_test", {"kernel"})
        self.expect("tests/a/emu_test", {"emu"})

    def test_a_library_that_the_table_does_not_list_for_the_program(self):
        self.expect("apps/sim", {"kernel", "zip"}, "docs/licences.md:1: apps/sim contains zip, which the table does not list for sim")
        self.expect("tests/a/words_test", {"words"}, "docs/licences.md:1: tests/a/words_test contains words, which the table does not list for tests")

    def test_gpl_2_and_apache_in_one_program(self):
        together = "which cannot be in one program with GPL-2.0-only"
        self.expect("tests/a/both_test", {"emu", "kernel"}, f"tests/a/both_test contains Kernel, Apache-2.0, {together}")
        page = PAGE.replace("`sim`, tests", "`sim`, `board`, tests")
        self.expect("apps/board", {"emu", "kernel"}, f"apps/board contains Kernel, Apache-2.0, {together}", page=page)

    def test_gpl_2_with_something_embedded_that_does_not_fit(self):
        self.expect("apps/board", {"emu"}, "apps/board contains Page, Apache-2.0, which cannot be in one program with GPL-2.0-only",
                    page=PAGE.replace("Apache-2.0 OR ISC", "Apache-2.0"))

    def test_an_alternative_fits_when_all_of_it_does(self):
        for licence, right in (("MIT", True), ("Apache-2.0", False), ("Apache-2.0 OR MIT", True), ("MIT AND Apache-2.0", False), ("LGPL-3.0-only", False),
                               ("Apache-2.0 OR MIT AND ISC", True), ("Apache-2.0 OR MIT AND LGPL-3.0-only", False), ("no licence", False)):
            self.assertEqual(check_licences.fits(licence), right, licence)

    def test_a_row_that_is_about_a_program_that_has_it_no_more(self):
        found = {"sim": {"kernel"}, "board": {"emu", "words"}}
        self.assertEqual(list(check_licences.stale_rows(found, rows(), source)), ["docs/licences.md:1: sim contains nothing of Words, but the table says so"])


class Lists(unittest.TestCase):
    LISTED = {"libemu-dev": "packages.txt", "libkernel-dev": "packages.txt", "page": "packages.txt", "tool": "packages.txt", "helper": "requirements.txt"}

    def expect(self, listed, *faults):
        self.assertEqual(list(check_licences.faults_of_lists(listed, {"emu", "kernel", "words"}, rows(), source)), list(faults))

    def test_what_is_installed_has_a_row(self):
        self.expect(self.LISTED)  # words come with another package, but are in a program

    def test_a_package_without_a_row(self):
        self.expect(self.LISTED | {"new": "requirements-test.txt"}, "requirements-test.txt: new has no row in docs/licences.md")

    def test_a_row_without_a_package(self):
        listed = {name: where for name, where in self.LISTED.items() if name != "helper"}
        self.expect(listed, "docs/licences.md:1: helper is in none of packages.txt, requirements.txt, requirements-test.txt, requirements-lint.txt, requirements-docs.txt, requirements-cocotb.txt, and in no program")


class Own(unittest.TestCase):
    def test_the_last_rule_that_fits_counts(self):
        reuse = check_licences.Reuse(REUSE)
        for file, licence in (("a.md", "Apache-2.0"), ("src/a/b.cpp", "Apache-2.0 OR MIT"), ("src/kernel/c.cpp", "Apache-2.0"),
                              ("one/a.cpp", "Apache-2.0 OR MIT"), ("one/two/a.cpp", "Apache-2.0")):
            self.assertEqual(reuse.licence(file), licence, file)
        self.assertEqual(reuse.licences(), {"Apache-2.0", "MIT"})

    def test_a_file_of_the_project_that_does_not_fit(self):
        faults = list(check_licences.faults_of_own("apps/board", {"src/a.cpp", "src/kernel/c.cpp"}, check_licences.Reuse(REUSE)))
        self.assertEqual(faults, ["REUSE.toml: src/kernel/c.cpp is Apache-2.0, but is in apps/board, which is GPL-2.0-only"])


class Texts(unittest.TestCase):
    def test_each_licence_has_its_text_and_the_project_the_usual_one(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "LICENSES").mkdir()
            for name in ("LICENSE", "LICENSES/Apache-2.0.txt", "LICENSES/MIT.txt"):
                (root / name).write_text("text", encoding="utf-8")
            reuse = check_licences.Reuse(REUSE)
            self.assertEqual(list(check_licences.faults_of_texts(root, reuse)), [])
            (root / "LICENSES/MIT.txt").unlink()
            (root / "LICENSE").write_text("another", encoding="utf-8")
            self.assertEqual(list(check_licences.faults_of_texts(root, reuse)), ["LICENSES/MIT.txt: is missing, but REUSE.toml names it",
                                                                                 "LICENSE: is not the text of LICENSES/Apache-2.0.txt"])


class Heads(unittest.TestCase):
    def faults(self, text):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "driver").mkdir()
            (root / "driver" / "port.c").write_text(text, encoding="utf-8")
            return list(check_licences.faults_of_heads(root, check_licences.Reuse(REUSE)))

    # REUSE-IgnoreStart
    WHOSE, LICENCE = "/* SPDX-FileCopyrightText: 2026 us */\n", "/* SPDX-License-Identifier: Apache-2.0 */\n"
    # REUSE-IgnoreEnd

    def test_a_file_that_says_what_reuse_toml_says_is_right(self):
        self.assertEqual(self.faults(self.WHOSE + self.LICENCE + "int a;\n"), [])
        self.assertEqual(self.faults("#!/bin/sh\n" + (self.WHOSE + self.LICENCE).replace("/*", "#").replace(" */", "")), [])

    def test_a_file_that_says_nothing_or_something_else(self):
        self.assertEqual(self.faults("int a;\n"), ["driver/port.c:1: says no licence itself, REUSE.toml Apache-2.0",
                                                   "driver/port.c:1: does not say whose it is"])
        self.assertEqual(self.faults(self.WHOSE + self.LICENCE.replace("Apache-2.0", "MIT")),
                         ["driver/port.c:1: says MIT itself, REUSE.toml Apache-2.0"])

    def test_one_that_says_it_further_down_only(self):
        self.assertEqual(len(self.faults("/*\n * Words.\n */\n" + self.WHOSE + self.LICENCE)), 2)


NINJA = """rule CXX_EXECUTABLE_LINKER__sim_Release
build obj/a.o: CXX_COMPILER__sim_Release /src/a.cpp || order
build obj/b.o: CXX_COMPILER__low_Release /src/b$ c.cpp | all.hxx all.hxx.gch || order.gch
build low.a: CXX_STATIC_LIBRARY_LINKER__low_Release obj/b.o
build high.a: CXX_STATIC_LIBRARY_LINKER__high_Release obj/h.o || low.a
build apps/sim: CXX_EXECUTABLE_LINKER__sim_Release obj/a.o | low.a /usr/lib/libx.so || low.a
  FLAGS = -O2
  LINK_LIBRARIES = low.a  /usr/lib/libx.so  -lno_such_library
build libd.so: CXX_SHARED_LIBRARY_LINKER__d_Release obj/b.o
build all: phony apps/sim
"""
NOTES = """obj/a.o: #deps 2, deps mtime 1 (VALID)
    /src/a.cpp
    ../src/a.hpp

obj/b.o: #deps 1, deps mtime 1 (VALID)
    /src/b c.cpp
"""


class Ninja(unittest.TestCase):
    def setUp(self):
        self.edges = ninja_build.edges_of(NINJA)

    def test_programs_and_shared_libraries(self):
        self.assertEqual(ninja_build.linked(self.edges), ["apps/sim", "libd.so"])

    def test_objects_of_a_program_are_also_those_of_its_libraries(self):
        self.assertEqual(ninja_build.objects_of(self.edges, "apps/sim"), {"obj/a.o", "obj/b.o"})

    def test_system_libraries_stand_on_the_link_line(self):
        self.assertEqual(ninja_build.system_libraries(self.edges, "apps/sim"), {"/usr/lib/libx.so"})

    def test_an_object_is_made_from_sources_and_headers(self):
        notes = ninja_build.notes_of(NOTES)
        self.assertEqual(notes, {"obj/a.o": ["/src/a.cpp", "../src/a.hpp"], "obj/b.o": ["/src/b c.cpp"]})
        self.assertEqual(ninja_build.absolute("/src/build", notes["obj/a.o"]), {"/src/a.cpp", "/src/src/a.hpp"})

    def test_programs_that_are_not_built_are_known(self):
        with tempfile.TemporaryDirectory() as folder:
            build = pathlib.Path(folder)
            (build / "build.ninja").write_text(NINJA, encoding="utf-8")
            (build / "obj").mkdir()
            (build / "obj/b.o").touch()
            (build / "libd.so").touch()
            self.assertEqual(ninja_build.not_built(build), ["apps/sim"])
            os.utime(build / "libd.so", (1, 1))  # linked before its object was compiled again
            self.assertEqual(ninja_build.not_built(build), ["apps/sim", "libd.so"])

    def test_an_object_may_have_what_a_precompiled_header_has(self):
        self.assertEqual(ninja_build.precompiled_of(self.edges, {"obj/a.o", "obj/b.o", "obj/c.o"}), {"all.hxx.gch"})

    def test_the_linker_says_what_a_program_needs(self):
        self.assertTrue(any("/libc.so" in path for path in ninja_build.needed("/bin/sh")))


class Packages(unittest.TestCase):
    def test_lists_are_read_without_remarks_and_versions(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in (("packages.txt", "# all\n[libraries]\nlibx-dev\n\n"), ("requirements.txt", "A==1.0\n"), ("requirements-test.txt", "b==2  # x\n"),
                               ("requirements-lint.txt", ""), ("requirements-docs.txt", "h==1\n"), ("requirements-cocotb.txt", "")):
                (root / name).write_text(text, encoding="utf-8")
            self.assertEqual(check_licences.listed_packages(root), {"libx-dev": "packages.txt", "A": "requirements.txt", "b": "requirements-test.txt", "h": "requirements-docs.txt"})

    def test_a_lock_that_is_not_of_its_list(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in (("requirements.txt", "A_b.c==1.0  # x\nd==2\n"), ("requirements.lock", "a-b-c==1.0 \\\n    --hash=sha256:00\nd==3 \\\ne==1\n"),
                               ("requirements-test.txt", "f==5\n"), ("requirements-test.lock", "a-b-c==1.0\nd==4\nf==5\n"),
                               ("requirements-lint.txt", "g==6\n"), ("requirements-lint.lock", "g==6\n"),
                               ("requirements-docs.txt", "h==7\n"), ("requirements-docs.lock", "d==2\nh==7\n"),
                               ("requirements-cocotb.txt", ""), ("requirements-cocotb.lock", "")):
                (root / name).write_text(text, encoding="utf-8")
            self.assertEqual(list(check_licences.faults_of_locks(root)),
                             ["requirements.lock: has d 3, requirements.txt 2", "requirements.lock: has e 1, requirements.txt not",
                              "requirements-test.lock: has d 4, requirements-test.txt 2"])

    def test_headers_and_libraries_of_one_source_belong_together(self):
        debian = check_licences.Debian({"/usr/include/zlib.h", "/no/such/file"}, {"zlib1g-dev", "no-such-package"})
        self.assertEqual(debian.source_of_file("/usr/include/zlib.h"), debian.source("zlib1g-dev"))
        self.assertIsNone(debian.source_of_file("/no/such/file"))
        self.assertEqual(debian.source("no-such-package"), "no-such-package")


if __name__ == "__main__":
    unittest.main()
