#!/bin/sh
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# Builds DSDPV1-RSU's RTL with Verilator, with limits of run time and single faults, and runs the test of its serial ports: as it is, and with each
# fault of dsdpv1_rsu/faults.txt, which has to be found. Arguments go to Verilator. OUT is the folder for the build, by default build/rtl-test.
set -eu
cd "$(dirname "$0")/.."
out=${OUT:-../build/rtl-test}/rsu
mkdir -p "$out"
out=$(cd "$out" && pwd)
tests=$(for part in bench test spi_test owner_test uart_test exchange_test; do echo "$(pwd)/tb/rsu_$part.cpp"; done)
verilator --cc --exe --build -j 2 -Wall -O3 --x-initial 0 -CFLAGS -O1 -DSINGLE_FAULTS -DDSDPV1_RUN_TIME_LIMITS -I. -I../registers \
  --top-module dsdpv1_rsu --Mdir "$out" "$@" tb/rsu.vlt $(cat dsdpv1_rsu/files.txt) $tests -o rsu_test > "$out/build.log" 2>&1 || { tail -n 30 "$out/build.log"; exit 1; }
"$out/rsu_test"
"$out/rsu_test" faults dsdpv1_rsu/faults.txt
