"""How Sphinx makes the site: ./run docs, docs/site/build.py."""
import os
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["DSDPV1_DOCS"])

project = "dsdpv1"
copyright = "the dsdpv1 authors"  # pylint: disable=redefined-builtin
version = release = re.search(r"^project\(dsdpv1 VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M).group(1)
root_doc = "README"
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx_copybutton"]
source_suffix = {".md": "markdown"}
default_role = "code"
highlight_language = "none"

myst_heading_anchors = 6

breathe_projects = {name: str(BUILD / "doxygen" / name) for name in ("c_api", "driver")}
breathe_domain_by_extension = {"h": "c"}
breathe_show_define_initializer = True

autodoc_mock_imports = ["numpy"]
autodoc_member_order = "bysource"

html_theme = "furo"
html_title = f"dsdpv1 {version}"
html_copy_source = False

# Types of C and of other modules have no page here.
nitpick_ignore_regex = [("c:identifier", r"u?int\d+_t|size_t|bool|dsdpv1_link"), ("py:class", r"(enum|os|numpy|typing|pathlib)\..*|dsdpv1\.(_library\.Handle|user\.T|telegram\.Kind)")]


def mark_examples(_app, _what, _name, _object, _options, lines):
    """Indented lines of a docstring are an example."""
    for at in range(len(lines) - 1, 1, -1):
        if re.match(r" +\S", lines[at]) and lines[at - 1] == "" and re.match(r"\S", lines[at - 2]):
            lines[at:at] = ["::", ""]


def setup(app):
    app.connect("autodoc-process-docstring", mark_examples)
