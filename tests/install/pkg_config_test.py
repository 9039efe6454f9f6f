#!/usr/bin/env python3
"""Programs compiled only with the options of pkg-config, in an empty folder.

    pkg_config_test.py CXX CC STAGE HERE
"""
import concurrent.futures
import os
import pathlib
import subprocess
import sys
import tempfile

# Name of the .pc files, source, arguments of the program: words, or files of the data. dsdpv1-core is used by package_test.py.
PROGRAMS = [
    (["dsdpv1-checks"], "tests/bus/consumer.cpp", []),
    (["dsdpv1-systemc-bus"], "tests/systemc_bus/consumer.cpp", []),
    (["dsdpv1-systemc"], "examples/tlm_platform.cpp", []),
    (["dsdpv1-capi", "dsdpv1-driver"], "examples/c_api.c", ["scenarios/dsdpv1.gsd"]),
    (["dsdpv1-xgate", "dsdpv1-driver", "dsdpv1-bus"], "examples/xgate_host.cpp", []),
    (["dsdpv1-commands"], "examples/own_slave/own_slave.cpp", ["run", "examples/own_slave/own_slave.yaml"]),
]


def pkg_config(environment, *arguments):
    return subprocess.run(["pkg-config", *arguments], env=environment, check=True, text=True, stdout=subprocess.PIPE).stdout.split()


def build_and_run(number, program, cxx, cc, places, environment, folder):
    modules, source, arguments = program
    compiler, standard = (cc, "-std=c99") if source.endswith(".c") else (cxx, "-std=c++17")
    kind, _, rest = source.partition("/")
    binary = folder / f"program{number}"
    command = [compiler, standard, places[kind] / rest, *pkg_config(environment, "--cflags", "--libs", *modules), "-o", binary]
    subprocess.run(command, cwd=folder, check=True)
    subprocess.run([binary, *(places["data"] / each if "." in each else each for each in arguments)], cwd=folder, env=environment, check=True,
                   stdout=subprocess.DEVNULL, timeout=300)


def main():
    cxx, cc, stage, here = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
    libraries = next(stage.rglob("pkgconfig")).parent
    environment = {**os.environ, "PKG_CONFIG_PATH": str(libraries / "pkgconfig"), "LD_LIBRARY_PATH": str(libraries)}
    data = stage / "share/dsdpv1"
    places = {"tests": here, "examples": data / "examples", "data": data}
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = [pool.submit(build_and_run, number, program, cxx, cc, places, environment, pathlib.Path(folder))
                for number, program in enumerate(PROGRAMS)]
        for run in runs:
            run.result()
    print(f"{len(PROGRAMS)} programs built and run")
    return 0


if __name__ == "__main__":
    sys.exit(main())
