#!/bin/sh
# Builds the reference RTL with Verilator and runs its own test, with the default parameters and at the limits of P2.
# Further arguments go to Verilator, e.g. --trace-fst. OUT is the folder for the builds, by default build/rtl-test.
set -eu
cd "$(dirname "$0")/.."
out=${OUT:-../build/rtl-test}

# check RTS_LEAD RTS_TRAIL [VERILATOR ARGUMENT...]
check() {
  lead=$1
  trail=$2
  shift 2
  folder=$out/lead${lead}_trail$trail
  mkdir -p "$folder"
  folder=$(cd "$folder" && pwd)
  verilator --cc --exe --build -j 2 -Wall -O3 --x-initial 0 "-GRTS_LEAD=$lead" "-GRTS_TRAIL=$trail" \
    -CFLAGS "-O1 -DRTS_LEAD=$lead -DRTS_TRAIL=$trail" -I. -I../registers --top-module dsdpv1 --Mdir "$folder" "$@" \
    $(cat files.txt) "$(pwd)/tb/rtl_test.cpp" -o rtl_test > "$folder/build.log" 2>&1 || { tail -n 30 "$folder/build.log"; exit 1; }
  "$folder/rtl_test"
}

check 4 4 "$@"
check 0 32 "$@"
check 32 0 "$@"
