#!/usr/bin/env python3
"""Doxygen's input filter: the comments of a header as Doxygen wants them, on standard output, line for line.

    comments.py HEADER

The first comment after the licence is the file's. A comment before a declaration is the declaration's, one after code on its line is the code's. Rulers
(---- errors ----) and comments above an empty line stay what they are. Lines that are indented are an example.
"""
import pathlib
import re
import sys

COMMENT = re.compile(r"/\*.*?\*/", re.S)
NO_DOCUMENTATION = re.compile(r"/\* ?(SPDX|NOLINT|-{2,})")


def opening(comment, before, after, file):
    if comment.startswith("/**"):
        return "/**"
    if NO_DOCUMENTATION.match(comment) or before.startswith(("#if", "#endif")):
        return "/*"
    if before:
        return "/**<"
    if file:
        return f"/** @file {file}"
    return "/**" if re.match(r"\n[ \t]*[^\s/]", after) else "/*"


def plain(comment):
    """I&M0 is not an entity; the indentation of an example's lines makes them one."""
    return re.sub(r"^( \*)(?=  )", r"\1      ", re.sub(r"(?<=\w)&(?=\w)", r"\&", comment), flags=re.M)


def documented(text, file):
    parts, end = [], 0
    for found in COMMENT.finditer(text):
        comment = found.group()
        begin = opening(comment, text[text.rfind("\n", 0, found.start()) + 1:found.start()].strip(), text[found.end():], file)
        file = file if comment.startswith("/* SPDX") else ""
        parts += [text[end:found.start()], begin, plain(comment[3 if comment.startswith("/**") else 2:])]
        end = found.end()
    return "".join(parts) + text[end:]


if __name__ == "__main__":
    header = pathlib.Path(sys.argv[1])
    print(documented(header.read_text(encoding="utf-8"), header.name), end="")
