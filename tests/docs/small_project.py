"""A small project in a separate folder, which tests break on purpose."""
import pathlib
import tempfile
import unittest


class SmallProject(unittest.TestCase):
    RIGHT = {}  # text by name of the file

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name, text in self.RIGHT.items():
            self.write(name, text)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def text(self, name):
        return (self.root / name).read_text(encoding="utf-8")

    def change(self, name, old, new):
        text = self.text(name)
        self.assertIn(old, text)
        self.write(name, text.replace(old, new))
