#!/bin/sh
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# Builds the reference RTL with Verilator and runs its own test: with its parameters as they are, with others, and in the build with
# limits of run time, which has to do the same on every pin. Arguments go to Verilator, e.g. --trace-fst. OUT is the folder for the
# builds, by default build/rtl-test. With BUILDS=run_time_limits only that build is made and tested.
set -eu
cd "$(dirname "$0")/.."
out=${OUT:-../build/rtl-test}
mkdir -p "$out"
out=$(cd "$out" && pwd)

# build NAME [VERILATOR ARGUMENT...]
build() {
  folder=$out/$1
  shift
  mkdir -p "$folder"
  verilator --cc --exe --build -j 2 -Wall -O3 --x-initial 0 -CFLAGS -O1 -MAKEFLAGS "OPT_FAST=-O2 OPT_GLOBAL=-O1" -I. -I../registers --top-module dsdpv1 --Mdir "$folder" "$@" \
    $(cat dsdpv1/files.txt) "$(pwd)/tb/rtl_test.cpp" "$(pwd)/tb/ownership_test.cpp" "$(pwd)/tb/user_rules_test.cpp" "$(pwd)/tb/service_rules_test.cpp" "$(pwd)/tb/dpv1_test.cpp" -o rtl_test > "$folder/build.log" 2>&1 || { tail -n 30 "$folder/build.log"; exit 1; }
}

# check RESULT BUILD [NAME=NUMBER...]: keeps what the test prints in RESULT.txt, and prints it when it fails
check() {
  result=$out/$1.txt
  name=$2
  shift 2
  "$out/$name/rtl_test" "$@" > "$result" || { echo "$name $*"; cat "$result"; exit 1; }
}

# same RESULT RESULT: the build with limits of run time does what the one without them does
same() {
  cmp -s "$out/$1.txt" "$out/$2.txt" || { echo "$2 differs from $1"; exit 1; }
}

# The limits are of the transmitter and of the search, not of DPV1, whose timers are most of the cycles.
others="dpv1=0 rts_lead=0 rts_trail=32 search_window_ms=3"
build run_time_limits -DDSDPV1_RUN_TIME_LIMITS -CFLAGS -DDSDPV1_RUN_TIME_LIMITS "$@"
check defaults_at_run_time run_time_limits &
check others_at_run_time run_time_limits $others
wait $!
check long_lead run_time_limits dpv1=0 rts_lead=32 rts_trail=0

if [ "${BUILDS:-all}" = all ]; then
  build parameters "$@"
  build other_parameters -GRTS_LEAD=0 -GRTS_TRAIL=32 -GSEARCH_WINDOW_MS=3 "$@"
  check defaults parameters &
  check others other_parameters $others
  wait $!
  same defaults defaults_at_run_time
  same others others_at_run_time
fi
cat "$out/defaults_at_run_time.txt"
