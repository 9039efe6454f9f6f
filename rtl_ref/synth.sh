#!/bin/sh
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# Synthesis of the reference RTL, DSDPV1 and DSDPV1-RSU, for an iCE40 hx8k: prints cells, block RAMs and of each clock the least of the greatest
# frequencies that five seeds of the placement reach, and fails where one is too slow. Also compares the constraints (*.sdc) with the netlist.
#   synth.sh [FOLDER FOR RESULTS] [-u to rewrite the figures in docs/rtl.md]
set -eu
cd "$(dirname "$0")"
out=${1:-../build/rtl-synth}
seeds=${SEEDS:-1 2 3 4 5}
mkdir -p "$out"

# checked LOG COMMAND...: shows the end of its log where it fails
checked() {
  log=$1
  shift
  "$@" > "$log" 2>&1 || { tail -n 20 "$log"; exit 1; }
}

# synthesize TOP OPTION [-u]: with this option of synth_ice40
synthesize() {
  checked "$out/$1.yosys.out" yosys -Q -l "$out/$1.yosys.log" -e 'implicitly declared' -p "
    read_verilog -sv -I. -I../registers $(tr '\n' ' ' < "$1/files.txt")
    synth_ice40 $2 -top $1 -json $out/$1.json
    stat"
  python3 -B constraints.py "$1" "$out/$1.json"
  reports=
  for seed in $seeds; do
    checked "$out/$1.$seed.nextpnr.log" nextpnr-ice40 --hx8k --package ct256 --json "$out/$1.json" --freq 56 --timing-allow-fail \
      --pcf-allow-unconstrained --seed "$seed" --report "$out/$1.$seed.report.json" --asc "$out/$1.$seed.asc"
    reports="$reports $out/$1.$seed.report.json"
  done
  echo "$1"
  python3 -B figures.py measured $reports --chip "$1" ${3:+"$3"}
}
# The mapper that knows delays (-abc9) makes the one that fills the device fast enough, and the other one larger (docs/rtl.md)
synthesize dsdpv1 "" "${2:-}"
synthesize dsdpv1_rsu -abc9 "${2:-}"
