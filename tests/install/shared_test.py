#!/usr/bin/env python3
"""BUILD_SHARED_LIBS: the C++ libraries as shared ones, installed, and a program with them; as a part of another project, so that nothing else of
this one is built.

    shared_test.py CMAKE ROOT BUILD FOLDER HERE
"""
import pathlib
import shutil
import subprocess
import sys

PARENT = """cmake_minimum_required(VERSION 3.25)
project(parent VERSION 7.0 LANGUAGES C CXX)
set(BUILD_SHARED_LIBS ON)
add_subdirectory(%s dsdpv1)
"""
COMPONENTS = ["checks", "dsdpv1"]  # the latter is the former name of core, driver, bus and systemc
LIBRARIES = ["core", "xgate", "driver", "driver_spc3", "driver_xgate", "bus", "pins", "check_recorder", "checks", "systemc", "driver_systemc", "systemc_bus"]
ARCHIVES = ["systemc_host", "host", "output", "socket"]  # always archives
KEPT = ["CMAKE_BUILD_TYPE", "CMAKE_C_COMPILER", "CMAKE_CXX_COMPILER", "CMAKE_C_FLAGS", "CMAKE_CXX_FLAGS", "CMAKE_UNITY_BUILD",
        "CMAKE_UNITY_BUILD_BATCH_SIZE"]
QUICKLY = [f"-DCMAKE_{language}_FLAGS_RELEASE=-O0 -DNDEBUG" for language in ("C", "CXX")]


def call(*command):
    subprocess.run(command, check=True)


def settings(build):
    """Settings of this build, but without optimisation, which does not affect linking and takes half the time."""
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8").splitlines()
    values = {name.partition(":")[0]: value for name, _, value in (line.partition("=") for line in cache if "=" in line)}
    ccache = values.get("DSDPV1_CCACHE", "")
    launchers = [f"-DCMAKE_{language}_COMPILER_LAUNCHER={ccache}" for language in ("C", "CXX")] if ccache and "NOTFOUND" not in ccache else []
    return [f"-D{name}={values[name]}" for name in KEPT if name in values] + QUICKLY + launchers, values["CMAKE_GENERATOR"]


def main():
    cmake, root, build, folder, here = sys.argv[1], *map(pathlib.Path, sys.argv[2:])
    parent, tree, stage, consumer = (folder / name for name in ("parent", "tree", "stage", "consumer"))
    for each in (parent, stage, consumer):
        shutil.rmtree(each, ignore_errors=True)
    parent.mkdir(parents=True)
    (parent / "CMakeLists.txt").write_text(PARENT % root, encoding="utf-8")
    options, generator = settings(build)
    call(cmake, "-G", generator, "-S", parent, "-B", tree, *options)
    call(cmake, "--build", tree, "--target", *(f"dsdpv1_{name}" for name in LIBRARIES + ARCHIVES))
    for component in COMPONENTS:
        call(cmake, "--install", tree, "--prefix", stage, "--component", component)
    found = {path.name for path in stage.rglob("libdsdpv1_*")}
    missing = [name for name in LIBRARIES if f"libdsdpv1_{name}.so" not in found]
    archives = {name for name in found if name.endswith(".a")}
    assert not missing and archives == {f"libdsdpv1_{name}.a" for name in ARCHIVES}, found
    call(cmake, "-G", generator, "-S", here / "systemc_bus", "-B", consumer, f"-DCMAKE_PREFIX_PATH={stage}", *options)
    call(cmake, "--build", consumer)
    call(consumer / "consumer")


if __name__ == "__main__":
    main()
