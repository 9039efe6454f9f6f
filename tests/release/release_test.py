#!/usr/bin/env python3
"""The parts of ./run release and of its check, with made-up packages and a made-up debootstrap. What they make of a build is tried by ./run release --check."""
import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "cmake"), str(ROOT / "tests/release")]

import bare_system  # noqa: E402
import release  # noqa: E402


class InFolder(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)


class Files(InFolder):
    def test_sums_are_those_that_sha256sum_reads(self):
        for name in ("b.whl", "a.deb"):
            (self.folder / name).write_text(name, encoding="utf-8")
        release.write_sums(self.folder)
        check = ["sha256sum", "--check", "--strict", "SHA256SUMS"]
        self.assertEqual(subprocess.run(check, cwd=self.folder, capture_output=True, text=True, check=True).stdout, "a.deb: OK\nb.whl: OK\n")
        (self.folder / "b.whl").write_text("another", encoding="utf-8")
        self.assertNotEqual(subprocess.run(check, cwd=self.folder, capture_output=True, check=False).returncode, 0)

    def test_the_bill_is_about_programs_and_not_about_what_else_is_called_so(self):
        wheel = self.folder / "x-1-py3-none-any.whl"
        with zipfile.ZipFile(wheel, "w") as file:
            file.writestr("x/lib/libdsdpv1.so.0", b"\x7fELF program")
            file.writestr("x/doc/libdsdpv1.so.0", "a text")
            file.writestr("x/lib/libother.so.0", b"\x7fELF program")
        self.assertEqual([str(path.relative_to(self.folder / "in_whl")) for path in release.programs_in(wheel, self.folder)], ["x/lib/libdsdpv1.so.0"])

    def test_a_step_that_fails_is_told_with_its_last_lines(self):
        with self.assertRaises(release.Failed) as told:
            release.call("sh", "-c", "seq 100; exit 3")
        self.assertEqual(str(told.exception).splitlines(), ["sh failed:", *map(str, range(81, 101))])

    def test_a_library_of_no_package_is_not_bundled(self):
        (self.folder / "libz.so.1").touch()
        done = [sys.executable, "-B", str(ROOT / "bindings/python/licences.py"), str(self.folder)]
        subprocess.run(done, check=True)
        self.assertIn("Jean-loup Gailly", (self.folder / "licences/zlib1g.txt").read_text(encoding="utf-8"))
        (self.folder / "libmine.so.1").touch()
        self.assertIn("libmine.so.1 is of no Debian package", subprocess.run(done, capture_output=True, text=True, check=False).stderr)

    def test_the_version_is_the_projects(self):
        self.assertRegex(release.version(), r"^\d+\.\d+\.\d+$")


class NotTried(InFolder):
    """Where no bare system can be made one line says why, and the exit code is not that of a pass."""

    def main(self):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed), unittest.mock.patch.object(sys, "argv", ["bare_system.py", str(self.folder), str(self.folder / "work")]):
            status = bare_system.main()
        self.assertEqual((status, printed.getvalue().count("\n")), (77, 1), printed.getvalue())
        return printed.getvalue()

    def test_without_rights(self):
        with unittest.mock.patch.object(os, "geteuid", return_value=1000):
            self.assertIn("not tried: a bare Debian is made by root alone: sudo ./run release --check", self.main())

    def test_without_debootstrap(self):
        with unittest.mock.patch.object(os, "geteuid", return_value=0), unittest.mock.patch.object(bare_system.shutil, "which", return_value=None):
            self.assertIn("not tried: debootstrap is missing: ./run deps release", self.main())

    def test_where_debootstrap_cannot(self):
        tools = self.folder / "tools"
        tools.mkdir()
        (tools / "debootstrap").write_text("#!/bin/sh\necho I: Retrieving\necho E: no mirror\nexit 1\n", encoding="utf-8")
        (tools / "debootstrap").chmod(0o755)
        with unittest.mock.patch.object(os, "geteuid", return_value=0), unittest.mock.patch.dict(os.environ, {"PATH": f"{tools}:{os.environ['PATH']}"}):
            self.assertIn("not tried: debootstrap could not: E: no mirror", self.main())


class System:
    """In the place of one: says what it is asked to say."""

    def __init__(self, root, said=""):
        self.root, self._said, self.packages = root, said, 88

    def call(self, _command, status=0):
        del status
        self.packages += 3
        return self._said

    def installed(self):
        return self.packages


TABLE = "DP state WAIT_CFG to DATA_EXCH\n\nPASSED\nFiles: /out/w.fst, .log, .json\n"


class Checks(InFolder):
    def files(self, size=20000):
        (self.folder / "out").mkdir(exist_ok=True)
        for name in ("w.fst", "w.log", "w.json"):
            (self.folder / "out" / name).write_bytes(bytes(size))

    def test_the_table_the_verdict_and_the_files(self):
        self.files()
        bare_system.check_table(TABLE, System(self.folder), "out/")
        for less in ("DATA_EXCH", "PASSED"):
            with self.assertRaisesRegex(bare_system.Wrong, "the demo prints"):
                bare_system.check_table(TABLE.replace(less, "nothing"), System(self.folder), "out/")
        with self.assertRaises(bare_system.Wrong):
            bare_system.check_table(TABLE, System(self.folder), "root/out/")
        self.files(size=10)
        with self.assertRaisesRegex(bare_system.Wrong, "leaves no /out/w.fst"):
            bare_system.check_table(TABLE, System(self.folder), "out/")

    def test_what_packages_take_is_what_apt_says(self):
        watch = bare_system.Watch(System(self.folder, "Need to get 12.5 MB of archives.\nNeed to get 0 B/7,400 kB of archives.\nNeed to get 500 kB/2 MB of archives.\n"))
        watch.install("apt-get install x")
        self.assertEqual((watch.packages, round(watch.fetched, 3)), (3, 13.0))

    def test_a_record_replaces_the_rows_of_its_ways_alone(self):
        record = self.folder / "bare.tsv"
        record.write_text("# head\n2020-01-01\tc\tdeb\t1\t1.0\t1\t1\t1\t1\n2020-01-01\tc\tsource\t2\t2.0\t2\t2\t2\t2\n", encoding="utf-8")
        with unittest.mock.patch.object(bare_system, "RECORD", record):
            bare_system.record([("deb", bare_system.Watch(System(self.folder)))])
        rows = record.read_text(encoding="utf-8").splitlines()
        self.assertEqual([row.split("\t")[2] for row in rows[1:]], ["source", "deb"])
        self.assertEqual((rows[0], rows[1]), ("# head", "2020-01-01\tc\tsource\t2\t2.0\t2\t2\t2\t2"))


if __name__ == "__main__":
    unittest.main()
