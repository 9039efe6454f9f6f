"""Shared by the checks of a whole project in this folder: --root, a line for each fault, exit 1 when there is any."""
import argparse
import pathlib


def main(doc, check, right):
    """`doc`: of the program. `check(root)`: its faults. `right`: what is printed without any. Returns the exit code."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    faults = list(check(parser.parse_args().root))
    print("\n".join(faults) if faults else right)
    return 1 if faults else 0
