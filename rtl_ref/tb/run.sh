#!/bin/sh
# Builds the reference RTL with Verilator and runs its own test: with its parameters as they are, with others, and in the build with
# limits of run time, which has to do the same on every pin. Arguments go to Verilator, e.g. --trace-fst. OUT is the folder for the
# builds, by default build/rtl-test.
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
  verilator --cc --exe --build -j 2 -Wall -O3 --x-initial 0 -CFLAGS -O1 -I. -I../registers --top-module dsdpv1 --Mdir "$folder" "$@" \
    $(cat files.txt) "$(pwd)/tb/rtl_test.cpp" "$(pwd)/tb/ownership_test.cpp" "$(pwd)/tb/user_rules_test.cpp" "$(pwd)/tb/service_rules_test.cpp" "$(pwd)/tb/dpv1_test.cpp" -o rtl_test > "$folder/build.log" 2>&1 || { tail -n 30 "$folder/build.log"; exit 1; }
}

# check BUILD [NAME=NUMBER...]: prints the results and keeps them in BUILD.txt
check() {
  name=$1
  shift
  echo "$name $*"
  "$out/$name/rtl_test" "$@" > "$out/$name.txt" || { cat "$out/$name.txt"; exit 1; }
  cat "$out/$name.txt"
}

# same BUILD: whether the build with limits of run time has just done what this one has
same() {
  cmp -s "$out/$1.txt" "$out/run_time_limits.txt" || { echo "run_time_limits differs from $1"; exit 1; }
}

others="rts_lead=0 rts_trail=32 search_window_ms=3"
build parameters "$@"
build other_parameters -GRTS_LEAD=0 -GRTS_TRAIL=32 -GSEARCH_WINDOW_MS=3 "$@"
build run_time_limits -DDSDPV1_RUN_TIME_LIMITS -CFLAGS -DDSDPV1_RUN_TIME_LIMITS "$@"
check parameters
check run_time_limits
same parameters
check other_parameters $others
check run_time_limits $others
same other_parameters
check run_time_limits rts_lead=32 rts_trail=0
