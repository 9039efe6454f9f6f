"""How Sphinx makes the site: ./run docs, docs/site/build.py."""
import os
import pathlib
import re

from docutils import nodes

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

breathe_projects = {name: str(BUILD / "doxygen" / name) for name in ("c_api", "driver", "driver_spc3")}
breathe_domain_by_extension = {"h": "c"}
breathe_show_define_initializer = True

autodoc_mock_imports = ["numpy"]
autodoc_member_order = "bysource"

html_theme = "furo"
html_title = f"dsdpv1 {version}"
html_copy_source = False

# Types of C and of other modules have no page here.
nitpick_ignore_regex = [("c:identifier", r"u?int\d+_t|size_t|bool|dsdpv1_link"), ("py:class", r"(enum|os|np|numpy|typing|pathlib)\..*|dsdpv1\.(_library\.Handle|user\.T|telegram\.Kind)|PinName")]


CODE = re.compile(r"\b[A-Z]{1,2}\d+\b")
RULINGS = {code: page for page in ("docs/chip", "docs/chip_rsu", "docs/spc3")
           for code in re.findall(r"^- \*\*([A-Z]{1,2}\d+)\*\*", (ROOT / f"{page}.md").read_text(encoding="utf-8"), re.M)}


def mark_examples(_app, _what, _name, _object, _options, lines):
    """Indented lines of a docstring are an example."""
    for at in range(len(lines) - 1, 1, -1):
        if re.match(r" +\S", lines[at]) and lines[at - 1] == "" and re.match(r"\S", lines[at - 2]):
            lines[at:at] = ["::", ""]


def links_in(text):
    """Rulings in brackets, as (H2) or (table 15, P5), and pages that are named: from, to, page, anchor."""
    for bracket in re.finditer(r"\([^()]*\)", text):
        for code in CODE.finditer(bracket.group()):
            if code.group() in RULINGS:
                yield bracket.start() + code.start(), bracket.start() + code.end(), RULINGS[code.group()], "#" + code.group().lower()
    for page in re.finditer(r"(?<![\w/])(docs/[\w/]+)\.md", text):
        if (ROOT / page.group()).exists():
            yield *page.span(), page.group(1), ""


def with_links(text, address):
    end = 0
    for begin, after, page, anchor in sorted(links_in(text)):
        yield nodes.Text(text[end:begin])
        yield nodes.reference("", text[begin:after], internal=True, refuri=address(page) + anchor)
        end = after
    yield nodes.Text(text[end:])


def link_words(app, doctree, docname):
    """Rulings and pages that are only named lead to where they stand."""
    for text in list(doctree.findall(nodes.Text)):
        if isinstance(text.parent, (nodes.paragraph, nodes.emphasis)) and any(links_in(text)):
            text.parent.replace(text, list(with_links(text.astext(), lambda page: app.builder.get_relative_uri(docname, page))))


def know_anchors(app, doctree):
    """Links may lead to what a page names by <a id>, not only to headings."""
    slugs = app.env.metadata[app.env.docname].setdefault("myst_slugs", {})
    for raw in doctree.findall(nodes.raw):
        for name in re.findall(r'<a id="([^"]+)">', raw.astext()):
            slugs.setdefault(name, (0, name, name))


def setup(app):
    app.connect("doctree-read", know_anchors)
    app.connect("doctree-resolved", link_words)
    app.connect("autodoc-process-docstring", mark_examples)
