#!/usr/bin/env python3
"""The groups of packages.txt compared with their use: the files from which dsdpv1-sim is compiled and linked, and those found by a configuration
without tests, are in the groups of `./run demo`; those found with tests are in those of `./run test` and `./run nightly`. dpkg assigns files to
packages.

    packages_test.py ROOT PACKAGES DSDPV1_SIM FOLDER      FOLDER: for a configuration without tests
"""
import os
import pathlib
import re
import subprocess
import sys

ROOT, PACKAGES, SIM, FOLDER = (pathlib.Path(word).resolve() for word in sys.argv[1:5])
BUILD = SIM.parents[1]
sys.path.insert(0, str(ROOT / "tests/licences"))

import ninja_build  # noqa: E402

UNASKED = {"DSDPV1_ARM_GCC", "DSDPV1_CCACHE", "DSDPV1_MOLD", "SHELLCHECK"}  # used where they are there


def output(*command):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout


def names_of_groups():
    groups = {}
    for line in PACKAGES.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            names = groups[line.strip("[]")] = set()
        elif line and line[0] != "#":
            names.add(line)
    return groups


class Installed:
    """The packages of this machine and their dependencies."""

    def __init__(self):
        self._needs, self._providers, self.base = {}, {}, set()
        form = "${db:Status-Status}\t${Package}\t${Essential}${Priority}\t${Provides}\t${Pre-Depends}, ${Depends}\n"
        for line in output("dpkg-query", "-W", "-f", form).splitlines():
            status, name, priority, provides, needs = line.split("\t")
            if status != "installed":
                continue
            self._needs[name] = [[re.sub(r"[\s:(].*", "", word.strip()) for word in each.split("|")] for each in needs.split(",") if each.strip()]
            for each in [name, *filter(None, (re.sub(r"[\s(].*", "", word.strip()) for word in provides.split(",")))]:
                self._providers.setdefault(each, []).append(name)
            if priority.startswith("yes") or priority.endswith("required"):
                self.base.add(name)

    def with_dependencies(self, names):
        found, open_names = set(), [*names, *self.base]
        while open_names:
            name = open_names.pop()
            if name not in found and name in self._needs:
                found.add(name)
                open_names += [next((mine for word in words for mine in sorted(self._providers.get(word, ()), key=lambda each: each != word)), "") for words in self._needs[name]]
        return found


def owners(files):
    """Maps each file to the packages that contain it; a file without one is not Debian's."""
    wanted = {}
    for file in files:
        real = os.path.realpath(file)
        for name in (real, real.removeprefix("/usr")):  # /lib is /usr/lib
            wanted.setdefault(name, set()).add(file)
    told = subprocess.run(["dpkg", "-S", *sorted(wanted)], capture_output=True, text=True, check=False).stdout
    found = {}
    for packages, name in re.findall(r"^(?!diversion )(.*): (/.*)$", told, re.M):
        for file in wanted.get(name, ()):
            found.setdefault(file, set()).update(word.split(":")[0] for word in packages.split(", "))
    return found


def cached(build):
    """The files that CMake has searched and found: maps each file to the name of its variable."""
    entries = re.findall(r"^([^#/\n][^:\n]*):(?:FILEPATH|PATH|INTERNAL)=(/usr/.+)$", (build / "CMakeCache.txt").read_text(encoding="utf-8"), re.M)
    return {file: name for name, file in entries if name not in UNASKED and os.path.exists(file)}


def strangers(files, known):
    """A line for each package that none of the groups of its files installs; `files`: maps each file to its purpose."""
    found = {", ".join(sorted(each)): files[file] for file, each in sorted(owners(files).items()) if not each & known}
    return [f"{package}, for {what}" for package, what in found.items()]


def main():
    groups, installed = names_of_groups(), Installed()
    needs = dict(line.split("\t") for line in output(ROOT / "run", "deps", "--commands").splitlines())

    def brought(*commands, less=""):
        return installed.with_dependencies({name for command in commands for group in needs[command].split() if group != less for name in groups[group]})

    output("cmake", "--preset", "default", "--fresh", "-S", ROOT, "-B", FOLDER, "-DBUILD_TESTING=OFF")
    program = ninja_build.programs(BUILD)[str(SIM.relative_to(BUILD))]
    parts = {file: "dsdpv1-sim" for file in program.files | program.libraries if not file.startswith(f"{ROOT}/")} | cached(FOLDER)
    faults = [f"./run demo does not install {each}" for each in strangers(parts, brought("demo"))]
    faults += [f"neither ./run test nor ./run nightly installs {each}" for each in strangers(cached(BUILD), brought("test", "nightly"))]
    for group in needs["demo"].split():
        if not strangers(parts, brought("demo", less=group)):
            faults.append(f"./run demo needs nothing of the group {group}, or this test does not notice")
    print("\n".join(faults) or "packages: right")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
