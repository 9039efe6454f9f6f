#!/usr/bin/env python3
"""Compares two folders byte by byte: prints a line for each file that differs, tab-separated, and the number of equal files; exit 1 if any
differs.

  same_files.py ONE OTHER
"""
import filecmp
import pathlib
import sys


def files_of(folder):
    return {path.relative_to(folder) for path in folder.rglob("*") if path.is_file() or path.is_symlink()}


def differences(one, other):
    here, there = files_of(one), files_of(other)
    for file in sorted(here | there):
        if file not in here or file not in there:
            yield file, "only in " + str(one if file in here else other)
        elif not filecmp.cmp(one / file, other / file, shallow=False):
            yield file, "differs"


def main():
    one, other = map(pathlib.Path, sys.argv[1:3])
    found = list(differences(one, other))
    for file, what in found:
        print(f"{file}\t{what}")
    total = len(files_of(one) | files_of(other))
    print(f"{total - len(found)} of {total} files are the same")
    return 1 if found or not total else 0


if __name__ == "__main__":
    sys.exit(main())
