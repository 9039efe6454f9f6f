#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The licence texts of what a wheel holds of others: the copyright files of the Debian packages that its libraries are from, and of those whose headers are
compiled into libdsdpv1 (docs/licences.md).

    licences.py LIBRARIES      the texts go into LIBRARIES/licences, as PACKAGE.txt
"""
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake"))

import licence_table  # noqa: E402

TEXTS = pathlib.Path("/usr/share/doc")
OWN = "libdsdpv1.so"


def package_of(library):
    told = subprocess.run(["dpkg-query", "-S", f"*-linux-gnu/{library}"], capture_output=True, text=True, check=False)
    if told.returncode != 0:
        sys.exit(f"{library} is of no Debian package, so its licence is not known, expected libraries of the packages of packages.txt")
    return told.stdout.split(":")[0]


def compiled_in():
    rows = licence_table.rows_of((ROOT / licence_table.PAGE).read_text(encoding="utf-8"))
    packages = [name for row in rows if row.use == "compiled in" and OWN in row.into for name in row.packages]
    return [name for name in packages if (TEXTS / name / "copyright").exists()]  # Verilator's only where there is one


def main(libraries):
    bundled = [package_of(path.name) for path in libraries.glob("*.so*") if not path.name.startswith(OWN)]
    (libraries / "licences").mkdir(exist_ok=True)
    for package in {*bundled, *compiled_in()}:
        shutil.copyfile(TEXTS / package / "copyright", libraries / "licences" / f"{package}.txt")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
