#!/usr/bin/env python3
"""docs/licences.md compared with the contents of each program, the lists of packages, and REUSE.toml.

    check_licences.py BUILD_FOLDER [--root FOLDER]

One line per fault, exit 1 when there is any. dpkg assigns files to Debian's packages.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cmake"))

import ninja_build  # noqa: E402
from licence_table import PAGE, label_of, rows_of  # noqa: E402

LISTS = ("packages.txt", "requirements.txt", "requirements-test.txt", "requirements-lint.txt", "requirements-docs.txt", "requirements-cocotb.txt")
SEEN = ("linked", "compiled in")  # uses that the build shows; others are only said: embedded, loaded, run
STRICT = "GPL-2.0-only"
# Licences allowed in one program with GPL-2.0-only: https://www.gnu.org/licenses/license-list.html, and docs/licences.md on Artistic-2.0 and GCC's.
FITS_STRICT = {STRICT, "GPL-2.0-or-later", "LGPL-2.1-or-later", "GPL-2.0-only WITH Linux-syscall-note", "GPL-3.0-or-later WITH GCC-exception-3.1",
               "Artistic-2.0", "MIT", "BSD-2-Clause", "BSD-3-Clause", "ISC", "Zlib", "BSL-1.0", "bzip2-1.0.6", "LicenseRef-Public-Domain"}
ALONE = ("bindings", "driver", "examples", "include", "registers", "rtl_ref", "share")
ALONE_SUFFIXES = (".c", ".h", ".ld", ".cpp", ".sv", ".svh", ".rdl", ".lua", ".py", ".sh", ".cmake")
NEVER_ALONE = ("dsdpv1_regs.hpp", "spc3_regs.hpp")
# REUSE-IgnoreStart
HEAD_LINE = r"(?:/\*|//|#|--) SPDX-"
# REUSE-IgnoreEnd


def fits(licence, allowed=frozenset(FITS_STRICT)):
    """True if one of the alternatives of an SPDX expression has only allowed licences."""
    return any(all(term.strip() in allowed for term in one.split(" AND ")) for one in licence.split(" OR "))


def listed_packages(root):
    """Maps each package to its list."""
    found = {}
    for name in LISTS:
        for line in (root / name).read_text(encoding="utf-8").splitlines():
            word = line.split("#")[0].strip().split("==")[0]
            if word and not word.startswith("["):  # the head of a group
                found[word] = name
    return found


def versions(text):
    """Maps each package, with PyPI's normalised name, to its version; from a list or its lock."""
    return {re.sub(r"[-_.]+", "-", name).lower(): version for name, version in re.findall(r"^([\w.-]+)==([^\s\\]+)", text, re.M)}


def faults_of_locks(root):
    """The packages in the lists and their locks. The tests' packages are installed in addition, so their lock may repeat some."""
    known = {}
    for name in LISTS[1:]:
        lock = name.replace(".txt", ".lock")
        listed, locked = (versions((root / file).read_text(encoding="utf-8")) for file in (name, lock))
        known |= listed
        for package in sorted(listed.keys() | locked.keys()):
            if known.get(package) != locked.get(package):
                yield f"{lock}: has {package} {locked.get(package, 'not')}, {name} {known.get(package, 'not')}"


class Debian:
    """Maps files and packages to source packages: a library, its headers and its runtime share one."""

    def __init__(self, files, packages):
        self._package_of = dict(self._owners(files))
        self._source_of = self._sources(set(self._package_of.values()) | set(packages))

    @staticmethod
    def _owners(files):
        wanted = {name: file for file in files for name in (file, file.removeprefix("/usr"))}  # /lib is /usr/lib
        told = subprocess.run(["dpkg", "-S", *sorted(wanted)], capture_output=True, text=True, check=False).stdout if wanted else ""
        for line in told.splitlines():
            packages, _, file = line.rpartition(": ")
            if file in wanted:
                yield wanted[file], packages.split(",")[0].split(":")[0]

    @staticmethod
    def _sources(packages):
        form = "${Package} ${source:Package}\n"
        told = subprocess.run(["dpkg-query", "-W", "-f", form, *sorted(packages)], capture_output=True, text=True, check=False).stdout
        return dict(line.split() for line in told.splitlines())

    def source(self, package):
        return self._source_of.get(package, package)

    def source_of_file(self, file):
        """None: belongs to no package."""
        package = self._package_of.get(file)
        return package and self.source(package)


def foreign(program, root):
    return outside(program.files | program.libraries, root)


def outside(files, root):
    return {file for file in files if not file.startswith(f"{root}/")}


def faults_of_program(name, found, rows, source):
    """Compares its packages with the rows, and with each other. `found`: their sources; `source`: of a package of the page."""
    label, mine = label_of(name), []
    for each in sorted(found):
        fitting = [row for row in rows if each in map(source, row.packages)]
        mine += [row for row in fitting if label in row.into]
        if not any(label in row.into for row in fitting):
            yield f"{PAGE}:1: {name} contains {each}, which the table does not list for {label}"
    mine += [row for row in rows if label in row.into and row.use not in SEEN and label != "tests"]
    if any(row.licence == STRICT for row in mine):
        for row in mine:
            if not fits(row.licence):
                yield f"{name} contains {row.what}, {row.licence}, which cannot be in one program with {STRICT}"


def stale_rows(found, rows, source):
    """Entries of the page for programs without that component. `found`: label to sources of packages."""
    for row in rows:
        for label in sorted(row.into):
            if label in found and row.use in SEEN and not found[label] & set(map(source, row.packages)):
                yield f"{PAGE}:1: {label} contains nothing of {row.what}, but the table says so"


def faults_of_lists(listed, found, rows, source):
    """Compares the installed packages with the rows."""
    named = {package for row in rows for package in row.packages}
    for package, where in listed.items():
        if package not in named:
            yield f"{where}: {package} has no row in {PAGE}"
    for package in sorted(named):
        if package not in listed and source(package) not in found:
            yield f"{PAGE}:1: {package} is in none of {', '.join(LISTS)}, and in no program"


def pattern_of(path):
    """A path of REUSE.toml as a regular expression."""
    parts = re.split(r"(\*\*|\*)", path)
    return re.compile("".join({"**": ".*", "*": "[^/]*"}.get(part) or re.escape(part) for part in parts))


class Reuse:
    """The licences of the project's own files: the last matching rule applies."""

    def __init__(self, text):
        self._rules = []
        for rule in tomllib.loads(text)["annotations"]:
            paths = [rule["path"]] if isinstance(rule["path"], str) else rule["path"]
            self._rules += [(pattern_of(path), rule["SPDX-License-Identifier"]) for path in paths]

    def licence(self, file):
        return next((licence for pattern, licence in reversed(self._rules) if pattern.fullmatch(file)), "no licence")

    def licences(self):
        return {term for _, licence in self._rules for term in re.split(" OR | AND ", licence)}


def faults_of_own(name, files, reuse):
    """The project's own files in a program with a GPL-2.0-only part."""
    for file in sorted(files):
        if not fits(reuse.licence(file)):
            yield f"REUSE.toml: {file} is {reuse.licence(file)}, but is in {name}, which is {STRICT}"


def faults_of_texts(root, reuse):
    """The texts of the licences; LICENSE is where people and programs look first."""
    texts = root / "LICENSES"
    for licence in sorted(reuse.licences()):
        if not (texts / f"{licence}.txt").is_file():
            yield f"LICENSES/{licence}.txt: is missing, but REUSE.toml names it"
    if (root / "LICENSE").read_bytes() != (texts / "Apache-2.0.txt").read_bytes():
        yield "LICENSE: is not the text of LICENSES/Apache-2.0.txt"


def copied_alone(root):
    """Files that users copy one by one into their projects, without REUSE.toml; not those of the C++ libraries."""
    for folder in ALONE:
        yield from (file for file in sorted((root / folder).rglob("*")) if file.suffix in ALONE_SUFFIXES and file.name not in NEVER_ALONE)


def faults_of_heads(root, reuse):
    """The licence in their first lines is that of REUSE.toml."""
    for file in copied_alone(root):
        name, head = str(file.relative_to(root)), file.read_text(encoding="utf-8").split("\n")[:3]
        said = [found[1] for line in head if (found := re.fullmatch(HEAD_LINE + r"License-Identifier: ([^*]*?)( \*/)?", line))]
        if said != [reuse.licence(name)]:
            yield f"{name}:1: says {said[0] if said else 'no licence'} itself, REUSE.toml {reuse.licence(name)}"
        if not any(re.match(HEAD_LINE + "FileCopyrightText: ", line) for line in head):
            yield f"{name}:1: does not say whose it is"


def own_files(program, root, build):
    return {str(pathlib.PurePosixPath(file).relative_to(root)) for file in program.files
            if file.startswith(f"{root}/") and not file.startswith(f"{build}/")}


def check(root, build):
    rows = rows_of((root / PAGE).read_text(encoding="utf-8"))
    programs, listed = ninja_build.programs(build), listed_packages(root)
    reuse = Reuse((root / "REUSE.toml").read_text(encoding="utf-8"))
    debian = Debian({file for each in programs.values() for file in foreign(each, root) | outside(each.precompiled, root)}, {package for row in rows for package in row.packages})
    strict = {debian.source(package) for row in rows if row.licence == STRICT for package in row.packages}
    found, possible = {}, {}
    for name, program in programs.items():
        sources = {debian.source_of_file(file) for file in foreign(program, root)} - {None}
        found.setdefault(label_of(name), set()).update(sources)
        possible.setdefault(label_of(name), set()).update(sources, map(debian.source_of_file, outside(program.precompiled, root)))
        yield from faults_of_program(name, sources, rows, debian.source)
        if sources & strict:
            yield from faults_of_own(name, own_files(program, root, build), reuse)
    unknown = {label_of(name) for name in ninja_build.not_built(build)}
    yield from stale_rows({label: sources for label, sources in possible.items() if label not in unknown}, rows, debian.source)
    excused = {debian.source(package) for row in rows if row.into & unknown for package in row.packages}
    yield from faults_of_lists(listed, excused.union(*found.values()), rows, debian.source)
    yield from faults_of_texts(root, reuse)
    yield from faults_of_heads(root, reuse)
    yield from faults_of_locks(root)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    arguments = parser.parse_args()
    faults = list(check(arguments.root, arguments.build.resolve()))
    print("\n".join(faults) if faults else "licences: right")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
