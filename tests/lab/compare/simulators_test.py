#!/usr/bin/env python3
"""Waves of Icarus, Verilator and GHDL, as VCD and as FST, of designs that do the same: all must be equal.

    simulators_test.py SIM
"""
import gzip
import itertools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

# One design in two languages. Names with dots and brackets, a vector from 0 up, a wide one, released and unknown bits, a real; Verilog
# dumps nothing for a while.
VERILOG = """
`timescale 1ns/1ps
module part(input wire [3:0] lower, output wire parity);
  assign parity = ^lower;
endmodule
module top(output reg clk);
  reg [7:0] count;
  reg [0:3] up;
  reg [99:0] wide;
  wire parity;
  part u_part(.lower(count[3:0]), .parity(parity));
  initial begin
    clk = 0;
    count = 0;
    up = 4'b0001;
    wide = 0;
    $dumpfile("WAVE");
    $dumpvars(0, top);
    repeat (200) begin
      #5 clk = ~clk;
      if (clk) begin
        count = count + 1;
        up = {up[1:3], up[0]};
        wide = {wide[98:0], count[0] ^ count[3]};
      end
    end
    #5 $finish;
  end
endmodule
"""
ICARUS_ALONE = """
`timescale 1ns/1ps
module odd;
  reg \\a.b ;
  reg \\esc[3] ;
  reg [7:0] bus;
  real level;
  integer number;
  event done;
  initial begin
    $dumpvars(0, odd);
    \\a.b = 1'bz; \\esc[3] = 0; bus = 8'bx; level = 1.5; number = -1;
    #10 bus = 8'bzzzz1111; level = 1e-30; -> done;
    #3 -> done;
    #10 $dumpoff;
    #1 bus = 8'h55;
    #4 $dumpon;
    #10 number = 7; \\a.b = 1'b1;
    #10 $finish;
  end
endmodule
"""
# Never ends by itself; writes what it has from time to time.
ENDLESS = """
`timescale 1ns/100ps
module half(input wire in, output wire out);
  assign out = ~in;
endmodule
module endless;
  reg clk;
  reg [7:0] count;
  real level;
  wire out;
  event done;
  half u_half(.in(clk), .out(out));
  initial begin
    clk = 0; count = 0; level = 0;
    $dumpfile("WAVE");
    $dumpvars(0, endless);
  end
  always #5 clk = ~clk;
  always @(posedge clk) begin
    count <= count + 1;
    level = level + 0.5;
    -> done;
    if (count == 255) $dumpflush;
    if (level >= LAST) $finish;
  end
endmodule
"""
VHDL = """
library ieee; use ieee.std_logic_1164.all; use ieee.numeric_std.all;
entity top is end top;
architecture a of top is
  signal clk : std_logic := '0';
  signal count : unsigned(7 downto 0) := (others => '0');
  signal up : std_logic_vector(0 to 3) := "0001";
  signal wide : std_logic_vector(99 downto 0) := (others => '0');
  signal parity : std_logic;
begin
  parity <= count(0) xor count(1) xor count(2) xor count(3);
  process
    variable next_count : unsigned(7 downto 0);
  begin
    for i in 1 to 200 loop
      wait for 5 ns;
      clk <= not clk;
      if clk = '0' then
        next_count := count + 1;
        count <= next_count;
        up <= up(1 to 3) & up(0);
        wide <= wide(98 downto 0) & (next_count(0) xor next_count(3));
      end if;
    end loop;
    wait for 5 ns;
    wait;
  end process;
end a;
"""
MAIN = """
#include "Vtop.h"
#include "verilated.h"
int main(int argc, char** argv) {
  VerilatedContext context;
  context.commandArgs(argc, argv);
  context.traceEverOn(true);
  Vtop top(&context);
  while (!context.gotFinish()) {
    top.eval();
    if (!top.eventsPending()) break;
    context.time(top.nextTimeSlot());
  }
  top.final();
}
"""


ENVIRONMENT = {**os.environ, **({"OBJCACHE": "ccache"} if shutil.which("ccache") else {})}


def run(folder, *command, status=0):
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False, env=ENVIRONMENT)
    if done.returncode != status:
        sys.exit(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout


def icarus(folder):
    (folder / "icarus.v").write_text(VERILOG.replace("WAVE", "icarus.vcd"), encoding="ascii")
    run(folder, "iverilog", "-g2012", "-o", "icarus.vvp", "icarus.v")
    run(folder, "vvp", "icarus.vvp")
    (folder / "icarus.vcd").rename(folder / "icarus_kept.vcd")
    run(folder, "vvp", "icarus.vvp", "-fst")
    (folder / "icarus.vcd").rename(folder / "icarus.fst")  # vvp keeps the name
    return ["icarus_kept.vcd", "icarus.fst"]


def verilator(folder):
    (folder / "main.cpp").write_text(MAIN, encoding="ascii")
    for kind, option in (("vcd", "--trace"), ("fst", "--trace-fst")):
        (folder / "top.v").write_text(VERILOG.replace("WAVE", f"verilator.{kind}"), encoding="ascii")
        run(folder, "verilator", "--cc", "--exe", "--build", "--timing", option, "-Wno-fatal", "-CFLAGS", "-O0", "--top-module", "top", "--Mdir",
            kind, "top.v", folder / "main.cpp")
        run(folder, f"{kind}/Vtop")
    return ["verilator.vcd", "verilator.fst"]


def ghdl(folder):
    (folder / "top.vhd").write_text(VHDL, encoding="ascii")
    run(folder, "ghdl", "-a", "top.vhd")
    run(folder, "ghdl", "-e", "top")
    for kind in ("vcd", "fst"):
        run(folder, "ghdl", "-r", "top", f"--{kind}=ghdl.{kind}", "--stop-time=1005ns")
    return ["ghdl.vcd", "ghdl.fst"]


def endless(folder, name, last):
    (folder / f"{name}.v").write_text(ENDLESS.replace("WAVE", name).replace("LAST", last), encoding="ascii")
    run(folder, "iverilog", "-g2012", "-o", f"{name}.vvp", f"{name}.v")
    return ["vvp", f"{name}.vvp", *(["-fst"] if name.endswith(".fst") else [])]


def killed(folder, name):
    """Once the file is long enough."""
    with subprocess.Popen(endless(folder, name, "1e9"), cwd=folder, stdout=subprocess.DEVNULL) as vvp:
        while vvp.poll() is None and (not (folder / name).exists() or (folder / name).stat().st_size < 300_000):
            pass
        vvp.kill()


def recovered(sim, folder):
    """What a killed simulator has left is equal to the wave of one that was not."""
    run(folder, *endless(folder, "whole.vcd", "50000"))
    for name in ("killed.vcd", "killed.fst"):
        killed(folder, name)
        good = f"good{name[-4:]}"
        run(folder, sim, "recover", name, "--output", good)
        said = run(folder, sim, "compare", "whole.vcd", good, "--json", "result.json")
        result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
        each = {signal["signal"].rpartition(".")[2]: signal["compared"] for signal in result["signals"]}
        if set(each) < {"clk", "count", "level", "out", "done"} or min(each.values()) < 1000:
            sys.exit(f"{name}: little was recovered\n{said}")


def compared(sim, folder, a, b):
    said = run(folder, sim, "compare", a, b, "--json", "result.json")
    missing = [name for name in ("clk", "count", "up", "wide", "parity") if f".{name} " not in said]
    if missing:
        sys.exit(f"{a} and {b}: {missing} were not compared\n{said}")


def main():
    sim = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory(prefix="dsdpv1_simulators_") as name:
        folder = pathlib.Path(name)
        waves = icarus(folder) + verilator(folder) + ghdl(folder)
        for a, b in itertools.combinations(waves, 2):
            compared(sim, folder, a, b)
        (folder / "packed.vcd.gz").write_bytes(gzip.compress((folder / waves[0]).read_bytes()))
        compared(sim, folder, "packed.vcd.gz", waves[1])
        recovered(sim, folder)
        (folder / "odd.v").write_text(ICARUS_ALONE, encoding="ascii")
        run(folder, "iverilog", "-g2012", "-o", "odd.vvp", "odd.v")
        run(folder, "vvp", "odd.vvp")
        run(folder, "vvp", "odd.vvp", "-fst")
        said = run(folder, sim, "compare", "dump.vcd", "dump.fst")
        for name in (r"odd.a.b", r"odd.esc[3]", "odd.bus", "odd.level", "odd.number", "odd.done"):
            if f" {name} " not in said:
                sys.exit(f"{name} was not compared\n{said}")
        (folder / "missed.v").write_text(ICARUS_ALONE.replace("#3 -> done", "#3"), encoding="ascii")
        run(folder, "iverilog", "-g2012", "-o", "missed.vvp", "missed.v")
        run(folder, "vvp", "missed.vvp")
        said = run(folder, sim, "compare", "dump.fst", "dump.vcd", status=1)
        if "odd.done: A 2, B 1" not in said:
            sys.exit(f"the missing moment of an event was not found\n{said}")


main()
