#!/bin/sh
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# Synthesis of the reference RTL, DSDPV1 and DSDPV1-RSU, for an iCE40 hx8k: prints cells, block RAMs and the greatest clock, and fails at 48 MHz or
# less.
#   synth.sh [FOLDER FOR RESULTS] [-u to rewrite the figures in docs/rtl.md]
set -eu
cd "$(dirname "$0")"
out=${1:-../build/rtl-synth}
mkdir -p "$out"

# synthesize TOP OPTION [-u]: with this option of synth_ice40
synthesize() {
  yosys -Q -l "$out/$1.yosys.log" -e 'implicitly declared' -p "
    read_verilog -sv -I. -I../registers $(tr '\n' ' ' < "$1/files.txt")
    synth_ice40 $2 -top $1 -json $out/$1.json
    stat" > "$out/$1.yosys.out" 2>&1 || { tail -n 20 "$out/$1.yosys.out"; exit 1; }
  nextpnr-ice40 --hx8k --package ct256 --json "$out/$1.json" --freq 56 --timing-allow-fail --pcf-allow-unconstrained --seed 1 \
    --report "$out/$1.report.json" --asc "$out/$1.asc" > "$out/$1.nextpnr.log" 2>&1 || { tail -n 20 "$out/$1.nextpnr.log"; exit 1; }
  echo "$1"
  python3 figures.py measured "$out/$1.report.json" --chip "$1" ${3:+"$3"}
}
# The mapper that knows delays (-abc9) makes the one that fills the device fast enough, and the other one larger (docs/rtl.md)
synthesize dsdpv1 "" "${2:-}"
synthesize dsdpv1_rsu -abc9 "${2:-}"
