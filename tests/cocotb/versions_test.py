"""Which versions of cocotb the import of cocotbext.profibus accepts, with stand-ins that have nothing but a version."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path


def imported(version):
    """What Python prints last when cocotbext.profibus is imported beside this version.

    An accepted one ends at the first module that the stand-in lacks."""
    with tempfile.TemporaryDirectory() as folder:
        package = Path(folder) / "cocotb"
        package.mkdir()
        (package / "__init__.py").write_text(f'__version__ = "{version}"\n', encoding="utf-8")
        code = f"import sys; sys.path.insert(0, {folder!r}); import cocotbext.profibus"
        return subprocess.run([sys.executable, "-W", "default", "-c", code], capture_output=True, text=True, check=False).stderr


class Versions(unittest.TestCase):
    def test_others_are_refused_in_one_line(self):
        for version in ("1.7.2", "3.0.0", "0.9", "3.0.0rc1"):
            self.assertEqual(imported(version).splitlines()[-1], f"ImportError: cocotbext.profibus: this is cocotb {version}, expected 1.9 or 2.x")

    def test_those_of_today_are_accepted(self):
        for version in ("1.9.2", "2.0.1", "2.1.0", "2.2.0.dev0+a.1"):
            told = imported(version)
            self.assertIn("cocotb.triggers", told)  # it went on
            self.assertNotIn("this is cocotb", told)
            self.assertNotIn("deprecated", told)

    def test_1_8_is_deprecated(self):
        self.assertIn("DeprecationWarning: cocotbext.profibus: cocotb 1.8.1 is deprecated, use 1.9 or 2.x", imported("1.8.1"))


if __name__ == "__main__":
    unittest.main()
