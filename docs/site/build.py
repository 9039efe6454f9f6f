#!/usr/bin/env python3
"""The documents as a site with search: FOLDER/html. Warnings of Doxygen and Sphinx are errors.

    build.py FOLDER DSDPV1_SIM LIBDSDPV1 PYTHON_PACKAGES      with a python3 that has requirements-docs.lock

Its pages are those of docs/README.md, in that order, as they stand, with the files of the project that they link to; and a reference made from sources: the
help of all commands, the headers of include/ and driver/ by Doxygen, the module dsdpv1 as it is imported. Sphinx does the rest.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = ROOT / "docs/site"
ROW = re.compile(r"^\| \[[^\]]+\]\(([^)#]+)\) \|", re.M)
LINK = re.compile(r"\]\(([^)\s#]+)(?:#[^)\s]*)?\)")
MORE = {"Developers": ["../CONTRIBUTING.md", "../CHANGELOG.md"],
        "Reference": ["../reference/cli.md", "../reference/run.md", "../reference/c_api.md", "../reference/driver.md", "../reference/driver_spc3.md",
                      "../reference/python.md"]}
HEADERS = {"c_api": ("C API", "include/dsdpv1", "The functions, structs and constants of `libdsdpv1.so`, from its headers. What they are for: [C API](../docs/c_api.md)."),
           "driver": ("C driver", "driver", "The functions, structs and constants of the C driver, from its headers. How to use it: [programmer's guide](../docs/programmers_guide.md)."),
           "driver_spc3": ("C driver, SPC3 family", "driver/spc3",
                           "The same for APC3, SPC3 and VPC3+. How to use it: [programmer's guide](../docs/programmers_guide.md#the-spc3-family).")}
PYTHON = ["dsdpv1", "dsdpv1.user", "dsdpv1.registers"]


def lists_of_pages():
    """Headings of docs/README.md and the pages below each, by their paths in the project."""
    text = (ROOT / "docs/README.md").read_text(encoding="utf-8")
    for part in text.split("\n## ")[1:]:
        heading = part.partition("\n")[0]
        yield heading, [os.path.normpath(f"docs/{name}") for name in ROW.findall(part) + MORE.get(heading, [])]


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def toctree(caption, pages):
    return f"\n```{{toctree}}\n:caption: {caption}\n:hidden:\n\n" + "".join(f"/{page.removesuffix('.md')}\n" for page in pages) + "```\n"


def copy_pages(source, lists):
    """README.md is the first page and holds the lists; the pages stand where they stand in the project, so that their links lead there."""
    tocs = "".join(toctree(heading, pages) for heading, pages in lists)
    write(source / "README.md", (ROOT / "README.md").read_text(encoding="utf-8") + toctree("All pages", ["docs/README.md"]) + tocs)
    for page in ["docs/README.md", *(page for _, pages in lists for page in pages)]:
        if (ROOT / page).exists():
            write(source / page, (ROOT / page).read_text(encoding="utf-8"))
    shutil.copytree(ROOT / "docs/img", source / "docs/img")


def linked_files(source):
    """Files of the project that pages link to, except pages."""
    for page in sorted(source.rglob("*.md")):
        for target in LINK.findall(page.read_text(encoding="utf-8")):
            path = os.path.normpath(page.parent.relative_to(source) / target)
            if (ROOT / path).is_file() and not (source / path).exists():
                yield path


def show_files(source):
    """A page for each, which the search leaves out."""
    for path in sorted(set(linked_files(source))):
        text = (ROOT / path).read_text(encoding="utf-8")
        write(source / f"{path}.md", f"---\norphan: true\nnosearch: true\n---\n# {pathlib.Path(path).name}\n\n``````text\n{text}``````\n")


def output(*command, **options):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, env={**os.environ, "COLUMNS": "80"}, **options).stdout


def help_of_commands(source, program):
    whole = output(program, "--help")
    text = f"# Command line of dsdpv1-sim\n\nWhat each command is for, with examples: [the command line](../docs/command_line.md).\n\n```text\n{whole}```\n"
    names = re.findall(r"^  ([a-z][a-z-]+) {2,}[A-Z]", whole, re.M)
    if "run" not in names:
        sys.exit(f"{program} --help lists no commands as this program expects them")
    for name in names:
        text += f"\n## {name}\n\n```text\n{output(program, name, '--help')}```\n"
    write(source / "reference/cli.md", text)
    write(source / "reference/run.md", f"# Commands of ./run\n\n```text\n{output(ROOT / 'run', '--help')}```\n")


def without_dead_links(xml):
    """breathe has no place for #include lines, nor for macros in macros."""
    xml = re.sub(r" *<(includes|includedby) .*\n", "", xml)
    return re.sub(r"<initializer>.*?</initializer>", lambda found: re.sub(r"</?ref[^>]*>", "", found.group()), xml, flags=re.S)


def headers(source, folder):
    """Doxygen reads them, breathe shows what it has read."""
    for name, (title, room, words) in HEADERS.items():
        files = sorted(path.name for path in (ROOT / room).glob("*.h") if "internal" not in path.name)
        settings = (SITE / "Doxyfile").read_text(encoding="utf-8")
        settings += f"INPUT = {' '.join(f'{room}/{file}' for file in files)}\nXML_OUTPUT = {folder / 'doxygen' / name}\nINPUT_FILTER = \"python3 -B {SITE / 'comments.py'}\"\n"
        (folder / "doxygen").mkdir(parents=True, exist_ok=True)
        subprocess.run(["doxygen", "-"], check=True, text=True, input=settings, cwd=ROOT)
        for xml in (folder / "doxygen" / name).glob("*.xml"):
            write(xml, without_dead_links(xml.read_text(encoding="utf-8")))
        text = f"# {title}\n\n{words}\n"
        for file in files:
            text += f"\n## {file}\n\n```{{eval-rst}}\n.. doxygenfile:: {file}\n   :project: {name}\n```\n"
        write(source / f"reference/{name}.md", text)


def python_module(source, packages, copy):
    """For a copy of the package in which autodoc also reads comments on members."""
    shutil.copytree(packages / "dsdpv1", copy / "dsdpv1", ignore=shutil.ignore_patterns("__pycache__"))
    for path in (copy / "dsdpv1").glob("*.py"):
        write(path, re.sub(r"^( +\w+(?:: [^=#\n]+)?(?: = [^#\n]+)?)  # ", r"\1  #: ", path.read_text(encoding="utf-8"), flags=re.M))
    text = "# Python module\n\nThe module `dsdpv1` as it is imported. What it is for, with examples: [Python](../docs/python.md).\n"
    for name in PYTHON:
        text += f"\n## {name}\n\n```{{eval-rst}}\n.. automodule:: {name}\n   :members:\n   :undoc-members:\n```\n"
    write(source / "reference/python.md", text)


def main(folder, program, library, packages):
    folder = pathlib.Path(folder).resolve()
    source = folder / "source"
    for old in (source, folder / "doxygen", folder / "python", folder / "html"):
        shutil.rmtree(old, ignore_errors=True)
    copy_pages(source, list(lists_of_pages()))
    show_files(source)
    help_of_commands(source, pathlib.Path(program).resolve())
    headers(source, folder)
    python_module(source, pathlib.Path(packages), folder / "python")
    environment = {**os.environ, "DSDPV1_LIBRARY": str(pathlib.Path(library).resolve()), "PYTHONPATH": str(folder / "python"), "DSDPV1_DOCS": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
    status = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "-n", "--keep-going", "-j", "2", "-b", "html", "-c", SITE, "-d", folder / "doctrees", source, folder / "html"],
                            env=environment, check=False).returncode
    if status == 0:
        shutil.copy(folder / "html/README.html", folder / "html/index.html")
        print(folder / "html/index.html")
    return status


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
