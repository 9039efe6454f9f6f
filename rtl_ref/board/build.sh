#!/bin/sh
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# The reference RTL on an iCE40-HX8K breakout board: simulates the wrapper's start with Icarus, builds the bitstream, prints where it is, and fails where
# CLK does not reach 48 MHz. Run on no board so far (docs/hardware.md).
#   build.sh [FOLDER FOR RESULTS] [--simulate-only]
set -eu
cd "$(dirname "$0")/.."
out=${1:-../build/rtl-board}
mkdir -p "$out"
files="$(tr '\n' ' ' < dsdpv1_rsu/files.txt) board/board.sv"
cells=$(dirname "$(command -v yosys)")/../share/yosys/ice40/cells_sim.v

# checked LOG COMMAND...: shows the end of its log where it fails
checked() {
  log=$1
  shift
  "$@" > "$log" 2>&1 || { tail -n 20 "$log"; exit 1; }
}

checked "$out/board.compile.log" iverilog -g2012 -DNO_ICE40_DEFAULT_ASSIGNMENTS -I. -I../registers -s board_tb -o "$out/board.vvp" $files "$cells" board/board_tb.sv
checked "$out/board.simulation.log" vvp -n "$out/board.vvp"
grep -qx 'the board starts' "$out/board.simulation.log" || { cat "$out/board.simulation.log"; exit 1; }
[ "${2:-}" != --simulate-only ] || exit 0

checked "$out/board.yosys.log" yosys -Q -e 'implicitly declared' -p "read_verilog -sv -I. -I../registers $files; synth_ice40 -abc9 -top board -json $out/board.json; stat"
seed=${SEED:-1}
checked "$out/board.nextpnr.log" nextpnr-ice40 --hx8k --package ct256 --json "$out/board.json" --pcf board/board.pcf --freq 48 --seed "$seed" \
  --report "$out/board.report.json" --asc "$out/board.asc"
checked "$out/board.icepack.log" icepack "$out/board.asc" "$out/board.bin"
grep 'Max frequency' "$out/board.nextpnr.log" | tail -n 3
echo "$out/board.bin"
