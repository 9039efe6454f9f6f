"""Generated tables in pages of docs/, between two comments that name them."""
import difflib
import os
import sys


def marks(name):
    return "<!-- %s: written by a test, do not edit -->" % name, "<!-- /%s -->" % name


def read_table(path, name):
    """The text between the comments; empty when they are not there."""
    with open(path, encoding="UTF-8") as file:
        text = file.read()
    begin, end = marks(name)
    return text.split(begin)[1].split(end)[0].strip() if begin in text and end in text else ""


def replace_table(path, name, table):
    with open(path, encoding="UTF-8") as file:
        text = file.read()
    begin, end = marks(name)
    before, after = text.split(begin)[0], text.split(end)[1]
    with open(path, "w", encoding="UTF-8") as file:
        file.write(before + begin + "\n" + table + "\n" + end + after)


def compare(path, name, table, how):
    """Ends the program with `how` to write it when the page has another one."""
    there, page = read_table(path, name), "docs/" + os.path.basename(path)
    if there != table:
        sys.stdout.writelines(line + "\n" for line in difflib.unified_diff(there.splitlines(), table.splitlines(), page, "done", lineterm=""))
        sys.exit(page + " is stale: " + how + ", and read the difference")
