#!/bin/sh
# Builds the reference RTL with Verilator and runs its own test. Further arguments go to Verilator, e.g. --trace-fst.
set -eu
cd "$(dirname "$0")/.."
out=${OUT:-../build/rtl-test}
mkdir -p "$out"
out=$(cd "$out" && pwd)
verilator --cc --exe --build -j 2 -Wall -O3 --x-initial 0 -CFLAGS -O1 -I. -I../registers --top-module dsdpv1 --Mdir "$out" "$@" \
  $(cat files.txt) "$(pwd)/tb/rtl_test.cpp" -o rtl_test > "$out.log" 2>&1 || { tail -n 30 "$out.log"; exit 1; }
"$out/rtl_test"
