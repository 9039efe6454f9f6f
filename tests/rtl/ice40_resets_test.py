#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The flip-flops of rtl_ref/gates/ice40_resets.v in Icarus: a reset by level from power-on on, and none."""
import pathlib
import subprocess
import sys
import tempfile

CELLS = pathlib.Path(__file__).resolve().parents[2] / "rtl_ref" / "gates" / "ice40_resets.v"
# Inputs of a step, and Q with reset and without, as the value that reset gives (v), its inverse (n) or x. At first R is high, so that it has no rise, and C is inactive.
STEPS = (
    ("D = 1'bx", "x", "x"),
    ("R = 1'b0", "v", "x"),  # the level ends without an edge of the clock
    ("D = !VALUE", "v", "x"),
    ("C = !C", "n", "n"),
    ("C = !C; D = VALUE", "n", "n"),
    ("E = 1'b0; C = !C", "k", "k"),  # no enable: kept, where the cell has one
    ("C = !C; E = 1'b1; D = !VALUE", "k", "k"),
    ("C = !C", "n", "n"),
    ("R = 1'b1", "v", "n"),
    ("C = !C", "v", "n"),
    ("C = !C", "v", "n"),  # an edge during reset
    ("C = !C; R = 1'b0", "v", "n"),
)
NAMES = [f"SB_DFF{falling}{enable}{kind}" for falling in ("", "N") for enable in ("", "E") for kind in "RS"]


def bench(name):
    """Two cells, of which the second has no reset."""
    kind, value, enable = name[-1], int(name.endswith("S")), ".E(E), " if "E" in name[6:] else ""
    cells = "".join(f"  {name} u_{which} (.Q({which}), .C(C), .{kind}({reset}), {enable}.D(D));\n" for which, reset in (("with_reset", "R"), ("without", "1'b0")))
    lines = []
    for number, (inputs, *seen) in enumerate(STEPS):
        level = {"v": f"1'b{value}", "n": f"1'b{1 - value}", "x": "1'bx", "k": f"1'b{1 - value if enable else value}"}
        lines.append(f"    {inputs}; #1 if (with_reset !== {level[seen[0]]} || without !== {level[seen[1]]}) "
                     f'$display("{name}, step {number}: %b %b", with_reset, without);\n')
    return (f"module {name}_bench;\n  localparam VALUE = 1'b{value};\n  reg C = 1'b{int('N' in name)}, E = 1'b1, R = 1'b1, D;\n  wire with_reset, without;\n{cells}"
            f"  initial begin\n{''.join(lines)}  end\nendmodule\n")


def main():
    with tempfile.TemporaryDirectory() as folder:
        source, program = (pathlib.Path(folder) / name for name in ("bench.sv", "bench.vvp"))
        source.write_text("".join(map(bench, NAMES)), encoding="utf-8")
        tops = [word for name in NAMES for word in ("-s", f"{name}_bench")]
        subprocess.run(["iverilog", "-g2012", "-Wall", *tops, "-o", program, *(sys.argv[1:] or [CELLS]), source], check=True)
        said = subprocess.run(["vvp", "-n", program], check=True, capture_output=True, text=True).stdout
    print(said, end="")
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main())
