"""The list of modules and habits of a platform (citizen.yaml) is complete, and its tests exist.

    citizen_list_test.py PROGRAM...     the test programs of SystemC
"""
import pathlib
import subprocess
import sys

import yaml

HABITS = ["payload rules", "quantum 0, 1, 10, 100 us", "suspension", "reset", "throw", "two instances", "clock elsewhere", "checks on", "save and restore"]
MODULES = ["PinModule", "TlmModule", "RsuPinModule", "RsuTlmModule, SPI", "RsuTlmModule, UART", "Spc3PinModule", "Spc3TlmModule"]


def tests_of(program):
    """The names of its tests, as SUITE.TEST."""
    suite, names = "", set()
    for line in subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout.splitlines():
        if line.startswith("  "):
            names.add(suite + line.split("#")[0].strip())
        elif line.split("#")[0].rstrip().endswith("."):
            suite = line.split("#")[0].strip()
    return names


def main():
    known = set().union(*(tests_of(program) for program in sys.argv[1:]))
    table = yaml.safe_load((pathlib.Path(__file__).parent / "citizen.yaml").read_text(encoding="utf-8"))
    faults = [] if list(table) == MODULES else [f"modules are {list(table)}"]
    for module, cells in table.items():
        if list(cells) != HABITS:
            faults.append(f"{module}: the cells are {list(cells)}")
        faults += [f"{module}, {habit}: no test {test}" for habit, test in cells.items() if isinstance(test, str) and test not in known]
    print("\n".join(faults) or f"{len(table)} modules, {sum(isinstance(test, str) for cells in table.values() for test in cells.values())} cells with a test")
    return len(faults) > 0


if __name__ == "__main__":
    sys.exit(main())
