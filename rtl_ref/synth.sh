#!/bin/sh
# Synthesis of the reference RTL for an iCE40 hx8k: prints cells, block RAMs and the greatest clock, and fails at 48 MHz or
# less.
#   synth.sh [FOLDER FOR RESULTS] [-u to rewrite the figures in docs/rtl.md]
set -eu
cd "$(dirname "$0")"
out=${1:-../build/rtl-synth}
mkdir -p "$out"
yosys -Q -l "$out/yosys.log" -e 'implicitly declared' -p "
  read_verilog -sv -I. -I../registers $(tr '\n' ' ' < files.txt)
  synth_ice40 -top dsdpv1 -json $out/dsdpv1.json
  stat" > "$out/yosys.out" 2>&1 || { tail -n 20 "$out/yosys.out"; exit 1; }
nextpnr-ice40 --hx8k --package ct256 --json "$out/dsdpv1.json" --freq 56 --timing-allow-fail --pcf-allow-unconstrained --seed 1 \
  --report "$out/report.json" --asc "$out/dsdpv1.asc" > "$out/nextpnr.log" 2>&1 || { tail -n 20 "$out/nextpnr.log"; exit 1; }
python3 figures.py measured "$out/report.json" ${2:+"$2"}
