"""The C API as read by bindings/python/generate.py, compared with the C compiler's view of the headers: sizes, members, constants.

    layout_test.py COMPILER
"""
import ctypes
import pathlib
import subprocess
import sys
import tempfile

from dsdpv1 import _c

ROOT = pathlib.Path(__file__).resolve().parents[2]


def expectations():
    """Maps an expression of C to Python's value."""
    for name, value in vars(_c).items():
        if isinstance(value, int) and name.startswith("DPSIM_"):
            yield f"(long long){name}", value if value < 2**63 else value - 2**64
        elif isinstance(value, type) and issubclass(value, ctypes.Structure) and value is not ctypes.Structure:
            yield f"(long long)sizeof({name})", ctypes.sizeof(value)
            for member, _ in value._fields_:
                yield f"(long long)offsetof({name}, {member})", getattr(value, member).offset
                yield f"(long long)sizeof((({name}*)0)->{member})", getattr(value, member).size


def main(compiler):
    expected = list(expectations())
    lines = "\n".join(f'  printf("%lld\\n", {expression});' for expression, _ in expected)
    with tempfile.TemporaryDirectory() as folder:
        source, program = pathlib.Path(folder) / "layout.c", pathlib.Path(folder) / "layout"
        source.write_text(f'#include <stdio.h>\n#include "dsdpv1/dsdpv1.h"\nint main(void) {{\n{lines}\n  return 0;\n}}\n', encoding="utf-8")
        subprocess.run([compiler, f"-I{ROOT / 'include'}", "-o", program, source], check=True)
        found = subprocess.run([program], capture_output=True, text=True, check=True).stdout.split()
    wrong = [f"{expression} is {value}, Python has {wanted}" for (expression, wanted), value in zip(expected, found) if int(value) != wanted]
    print("\n".join(wrong) if wrong else f"{len(found)} sizes, members and constants are the compiler's")
    return 1 if wrong or len(found) < 300 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
