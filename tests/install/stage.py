#!/usr/bin/env python3
"""Installs the build and moves the installation to another place, where all other tests use it.

    stage.py CMAKE BUILD STAGE        BUILD is installed at STAGE.installed, then moved to STAGE

Installed files for users must not contain paths of this machine: neither of the build nor of the first installation.
"""
import pathlib
import shutil
import subprocess
import sys

TOLD = {".cmake", ".pc", ".txt", ".yaml", ".1"}


def places(build):
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    source = next(line for line in cache.splitlines() if line.startswith("CMAKE_HOME_DIRECTORY:"))
    return [str(build), source.partition("=")[2]]


def main():
    cmake, build, stage = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    first = stage.with_suffix(".installed")
    for folder in (first, stage, stage.with_name("examples")):  # the examples are built in an empty folder
        shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([cmake, "--install", build, "--prefix", first], check=True, stdout=subprocess.DEVNULL)
    first.rename(stage)
    faults = [f"{path.relative_to(stage)} names {place}" for path in sorted(stage.rglob("*"))
              if path.suffix in TOLD and path.is_file()
              for place in [*places(build), str(first)] if place in path.read_text(encoding="utf-8", errors="replace")]
    print("\n".join(faults) if faults else "stage: nothing names a place of this machine")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
