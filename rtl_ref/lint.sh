#!/bin/sh
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# Lints the reference RTL, DSDPV1 and DSDPV1-RSU, with all four tools in all its builds (normal, with faults, with limits of run time, with both), compares
# the numbers of the faults in the sources with the lists of faults, and looks for names that do not belong where they stand: a chip's, its
# addresses' and registers' in profibus/, pins of a port in dpram/. Also each waiver of a warning: whether it has a reason and is needed (waivers.py).
# Silent when all is well.
set -eu
cd "$(dirname "$0")"
# quiet COMMAND...: fails also when the command says anything
quiet() {
  output=$("$@" 2>&1) && [ -z "$output" ] || { echo "$output"; exit 1; }
}

# stranger PATTERN WHAT FILE...: fails with the lines that have the pattern, but for those of the licence
stranger() {
  pattern=$1
  what=$2
  shift 2
  ! grep -nE "$pattern" "$@" | grep -v '// SPDX-' || { echo "$what"; exit 1; }
}
stranger '[Dd][Ss][Dd][Pp][Vv]1|\bB0[0-9A-F]{2}' "a chip, its addresses or registers named where every DP slave's blocks are" profibus_types.svh profibus/*.sv
stranger '\b(csr|rd|wr|d_oe|[rl]_(req|sta))(_[io])?\b|CSR|RD\b|WR\b|[RL]_(REQ|STA)\b' \
  "a pin of a port named where the DPRAM's blocks are" dpram_types.svh dpram/*.sv

python=../.venv/bin/python  # of ./run, with pyslang
[ -x "$python" ] || python=python3
"$python" -c 'import pyslang' 2>/dev/null || { echo "no Python with pyslang (requirements-test.txt)"; exit 1; }
for define in "" -DSINGLE_FAULTS -DDSDPV1_RUN_TIME_LIMITS "-DSINGLE_FAULTS -DDSDPV1_RUN_TIME_LIMITS"; do
  for list in */files.txt; do
    top=${list%/*} files=$(cat "$list")
    quiet verilator --lint-only -Wall $define -I. -I../registers --top-module $top $files
    quiet iverilog -g2012 -Wall $define -I. -I../registers -s $top -t null $files
    quiet yosys -q -e '.*' -p "read_verilog -sv $define -I. -I../registers $(echo $files); hierarchy -check -top $top; proc; check -assert"
    quiet "$python" -B slang.py --single-unit $define -I. -I../registers --top $top $files
  done
done

python3 -B waivers.py

# numbers LIST FILE...: those of FAULT(n) in the files against those of the list
numbers() {
  list=$1
  shift
  in_sources=$(grep -ho 'FAULT([0-9]*)' "$@" | tr -dc '0-9\n' | sort -nu)
  in_list=$(grep -v '^#' "$list" | cut -d' ' -f1 | sort -n)
  [ "$in_sources" = "$in_list" ] || { echo "$list and the FAULT(n) of the sources differ"; exit 1; }
}
numbers dsdpv1/faults.txt profibus/*.sv dpram/*.sv dsdpv1/*.sv
numbers dsdpv1_rsu/faults.txt dsdpv1_rsu/*.sv
