"""The parts of each program, from build.ninja, ninja's notes of the headers, and the dynamic linker."""
import dataclasses
import os
import pathlib
import re
import subprocess

EDGE = re.compile(r"^build (?P<outputs>.*?)(?<!\$): (?P<rule>\S+)(?P<inputs>.*)$")
LINKERS = re.compile(r"^(C|CXX)_(EXECUTABLE|SHARED_LIBRARY|MODULE_LIBRARY)_LINKER")
LIBRARY_FOLDERS = ("/usr/lib", "/usr/local/lib")


@dataclasses.dataclass
class Edge:
    rule: str
    inputs: list  # explicit ones
    libraries: list = dataclasses.field(default_factory=list)  # words of LINK_LIBRARIES
    precompiled: list = dataclasses.field(default_factory=list)  # headers: of what is in them the object's notes say nothing


@dataclasses.dataclass
class Program:
    libraries: set  # paths of system libraries on the link line, and of their dependencies
    files: set  # sources and headers, absolute
    precompiled: set  # those of precompiled headers (preset edit): a part of them is in it, and nothing says which


def words_of(text):
    return [word.replace("$ ", " ").replace("$:", ":") for word in re.findall(r"(?:\$.|\S)+", text)]


def edges_of(text):
    """Maps the first output to its edge."""
    edges, last = {}, None
    for line in text.splitlines():
        match = EDGE.match(line)
        if match:
            explicit, *implicit = match["inputs"].split("|")
            last = Edge(match["rule"], words_of(explicit), precompiled=[word for word in words_of(" ".join(implicit[:1])) if word.endswith((".gch", ".pch"))])
            edges[words_of(match["outputs"].split("|")[0])[0]] = last
        elif line.startswith("  LINK_LIBRARIES =") and last:
            last.libraries = words_of(line.split("=", 1)[1])
    return edges


def linked(edges):
    """Programs and shared libraries."""
    return sorted(name for name, edge in edges.items() if LINKERS.match(edge.rule))


def objects_of(edges, name):
    """The objects of a program: its own and those of all its static libraries."""
    found, open_names, seen = set(), [name], set()
    while open_names:
        here = open_names.pop()
        if here in seen or here not in edges:
            continue
        seen.add(here)
        found.update(word for word in edges[here].inputs if word.endswith(".o"))
        open_names += [word for word in edges[here].inputs + edges[here].libraries if word.endswith(".a")]
    return found


def precompiled_of(edges, objects):
    return {header for name in objects if name in edges for header in edges[name].precompiled}


def system_libraries(edges, name):
    """Libraries of the link line, by path."""
    found = set()
    for word in edges[name].libraries:
        if word.startswith("/"):
            found.add(word)
        elif word.startswith("-l"):
            pattern = f"*/lib{word[2:]}.so"
            found.update(str(path) for folder in LIBRARY_FOLDERS for path in pathlib.Path(folder).glob(pattern))
    return found


def notes_of(text):
    """Maps each object to the files from which it was compiled."""
    notes, files = {}, []
    for line in text.splitlines():
        if line.startswith("    "):
            files.append(line.strip())
        elif ": #deps" in line:
            files = notes[line.split(": #deps")[0]] = []
    return notes


def needed(path):
    """The libraries that the dynamic linker would load with it, with their dependencies."""
    told = subprocess.run(["ldd", path], capture_output=True, text=True, check=False).stdout
    return set(re.findall(r"=> (/\S+)", told))


def absolute(folder, files):
    return {os.path.normpath(os.path.join(folder, file)) for file in files}


def is_current(folder, edges, name):
    """Linked after all of its objects and shared libraries, and these after theirs."""
    shared = {word for word in edges[name].libraries if word in edges and LINKERS.match(edges[word].rule)}
    files = [folder / each for each in (name, *objects_of(edges, name), *shared)]
    return all(each.exists() for each in files) and all(is_current(folder, edges, each) for each in shared) and max(each.stat().st_mtime_ns for each in files) == files[0].stat().st_mtime_ns


def not_built(folder):
    """The paths of programs and shared libraries that the build knows and that are missing or older than an object of theirs, as in preset edit."""
    edges = edges_of((folder / "build.ninja").read_text(encoding="utf-8"))
    return [name for name in linked(edges) if not is_current(folder, edges, name)]


def programs(folder):
    """Maps the path of each built program and shared library, relative to `folder`, to its contents."""
    edges = edges_of((folder / "build.ninja").read_text(encoding="utf-8"))
    notes = notes_of(subprocess.run(["ninja", "-C", folder, "-t", "deps"], capture_output=True, text=True, check=True).stdout)
    made = {}
    for name in linked(edges):
        if is_current(folder, edges, name):
            objects = objects_of(edges, name)
            files, precompiled = (set().union(*(notes.get(each, []) for each in some)) for some in (objects, precompiled_of(edges, objects)))
            libraries = system_libraries(edges, name) | needed(folder / name)
            made[name] = Program(set(map(os.path.realpath, libraries)), absolute(folder, files), absolute(folder, precompiled))
    return made
