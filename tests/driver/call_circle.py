#!/usr/bin/env python3
"""Finds circles of calls between the driver's files, with nm on their object files.

    call_circle.py NM OBJECT...

A file that needs a name calls the file that defines it; names that none of them defines (the C library's) do not count. Prints one
circle, a line per call, exit 1. Python's standard library only.
"""
import pathlib
import subprocess
import sys


def names(listing):
    """The names that a file defines and needs, from the output of `nm -g -P` for its object file."""
    rows = [line.split()[:2] for line in listing.splitlines()]
    return {name for name, kind in rows if kind.isupper() and kind != "U"}, {name for name, kind in rows if kind == "U"}


def calls(listings):
    """File to {file that it calls: the first name of those that it calls there}."""
    of = {file: names(listing) for file, listing in listings.items()}
    home = {name: file for file, (defined, _) in of.items() for name in defined}
    graph = {}
    for file, (_, needed) in sorted(of.items()):
        graph[file] = {}
        for name in sorted(needed & home.keys()):
            graph[file].setdefault(home[name], name)
    return graph


def circle(graph):
    """Files of which each calls the next and the last the first; empty without a circle."""
    done, path = set(), []

    def visit(file):
        if file in path:
            return path[path.index(file):]
        if file in done:
            return []
        done.add(file)
        path.append(file)
        for other in graph[file]:
            if found := visit(other):
                return found
        path.pop()
        return []

    for file in graph:
        if found := visit(file):
            return found
    return []


def check(listings):
    graph = calls(listings)
    if not any(graph.values()):
        yield "no file calls another: that is not the driver"
    found = circle(graph)
    for file, other in zip(found, found[1:] + found[:1]):
        yield f"{file}: calls {graph[file][other]} of {other}, which leads back here"


def main():
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    nm, *objects = sys.argv[1:]
    listings = {}
    for file in objects:
        listings[pathlib.Path(file).stem] = subprocess.run([nm, "-g", "-P", file], check=True, capture_output=True, text=True).stdout
    faults = list(check(listings))
    print("\n".join(faults) if faults else f"call_circle: none in {len(listings)} files")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
