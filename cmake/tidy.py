#!/usr/bin/env python3
"""Runs clang-tidy over source files and remembers the clean ones.

    tidy.py BUILD_FOLDER [-j N] FILE...

BUILD_FOLDER holds compile_commands.json and a finished Ninja build, from which the includes of each source are known. A file is checked
again if the file, one of the project's headers that it includes, its command, .clang-tidy or clang-tidy has changed. Each is checked
separately, even if CMake compiles several together or does not compile it. Exit 1 if there are findings.
"""
import argparse
import hashlib
import json
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CACHE = "tidy-clean"
CLANG_TIDY = ROOT / ".venv" / "bin" / "clang-tidy"  # ./run lint installs it
OF_GCC_ALONE = (" -fno-gnu-unique", " -ffat-lto-objects")  # clang does not know them


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def sources_of(entry):
    """The compiled file, or those included by a unity source of CMake."""
    file = Path(entry["file"])
    if not file.name.startswith("unity_"):
        return [file.resolve()]
    names = re.findall('^#include "(.*)"$', file.read_text(encoding="utf-8"), re.MULTILINE)
    return [Path(name).resolve() for name in names]


def for_clang(command):
    """Removes options unknown to clang, and precompiled headers: a file includes what it needs."""
    for option in OF_GCC_ALONE:
        command = command.replace(option, "")
    return re.sub(r" -Winvalid-pch -include \S*/cmake_pch\.hxx", "", command)


def read_commands(build):
    """Source -> its entry in the compile database, as if compiled alone; if it is compiled twice, the first."""
    commands = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        for source in sources_of(entry):
            command = for_clang(entry["command"].replace(entry["file"], str(source)))
            commands.setdefault(source, dict(entry, file=str(source), command=command))
    return commands


def object_of(entry):
    words = shlex.split(entry["command"])
    return words[words.index("-o") + 1]


def apart_options(source, build):
    """Entries for sources without a command of CMake: the ARM board's firmware, output of Verilator's make, projects of an installed package."""
    if source.suffix == ".c":
        return f"--target=thumbv7m-none-eabi -std=c99 -ffreestanding -isystem {ROOT}/examples/firmware/freestanding -I{ROOT}"
    top = "dsdpv1_rsu" if source.name.startswith("rsu_") else "dsdpv1"
    verilator = output_of("verilator", "--getenv", "VERILATOR_ROOT").strip()
    verilated = f"-isystem {build}/rtl/lib{top}_rtl_faults -isystem {verilator}/include -isystem {verilator}/include/vltstd"
    return f"-std=c++17 -I{ROOT} -I{build}/{CACHE} {verilated} -DDSDPV1_RTL_LAYOUT=1"


def apart_entry(source, build):
    compiler = "clang" if source.suffix == ".c" else "clang++"
    command = f"{compiler} {apart_options(source, build)} -c {source} -o {source.stem}.o"
    return {"directory": str(ROOT), "file": str(source), "command": command}


def apart_headers(entry):
    """As found by clang itself."""
    words = shlex.split(entry["command"])
    rule = output_of(*words[:words.index("-c")], "-MM", entry["file"])
    paths = {Path(word).resolve() for word in rule.replace("\\\n", " ").split()[1:]}
    return {path for path in paths if path.is_relative_to(ROOT)}


def read_dependencies(build):
    """Object -> the files of this project that it depends on."""
    dependencies, current = {}, []
    for line in output_of("ninja", "-C", str(build), "-t", "deps").splitlines():
        if line.startswith("    "):
            path = (build / line.strip()).resolve()
            if path.is_relative_to(ROOT) and not path.is_relative_to(build):
                current.append(path)
        elif ": #deps" in line:
            current = dependencies.setdefault(line.split(": #deps")[0], [])
    return dependencies


def settings_digest():
    digest = hashlib.sha256(output_of(CLANG_TIDY, "--version").encode())
    for pattern in (".clang-tidy", "*/.clang-tidy", "*/*/.clang-tidy", "*/*/*/.clang-tidy"):
        for path in sorted(ROOT.glob(pattern)):
            digest.update(path.read_bytes())
    return digest.hexdigest()


def digest_of(settings, command, files):
    digest = hashlib.sha256((settings + command).encode())
    for path in sorted(files):
        digest.update(str(path.relative_to(ROOT)).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def files_of(source, entry, commands, dependencies):
    """The source and the headers of its object; if the source is only a part of it, there are more headers than it includes."""
    if source not in commands:
        return apart_headers(entry)
    made_from = dependencies.get(object_of(entry), [])
    return {source} | {path for path in made_from if path not in commands}


def look_at(database, source, clean):
    """Prints clang-tidy's findings; creates `clean` if there are none."""
    result = subprocess.run(
        [CLANG_TIDY, "--quiet", "-p", str(database), source], capture_output=True, text=True, check=False
    )
    if result.returncode == 0:
        clean.touch()
        return True
    errors = result.stdout.strip() or result.stderr.strip()
    print(errors, flush=True)
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("-j", type=int, default=2, dest="jobs")
    parser.add_argument("files", nargs="+")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    commands, dependencies, settings = read_commands(build), read_dependencies(build), settings_digest()
    sources = [Path(name).resolve() for name in arguments.files]
    entries = {source: commands.get(source) or apart_entry(source, build) for source in sources}
    cache = build / CACHE
    cache.mkdir(exist_ok=True)
    installed = cache / "dsdpv1"  # where a package has its headers
    if not installed.exists():
        installed.symlink_to(ROOT)
    (cache / "compile_commands.json").write_text(json.dumps(list(entries.values())), encoding="utf-8")

    due = []
    for source, entry in entries.items():
        clean = cache / digest_of(settings, entry["command"], files_of(source, entry, commands, dependencies))
        if not clean.exists():
            due.append((entry["file"], clean))
    print(f"clang-tidy: {len(due)} of {len(arguments.files)} files to look at", flush=True)
    with ThreadPoolExecutor(arguments.jobs) as pool:
        results = list(pool.map(lambda item: look_at(cache, *item), due))
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
