#!/bin/sh
# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0 OR MIT
# Coverage of the reference RTL by lines and toggles, of the DSDPV1 and of the DSDPV1-RSU's ports: model and RTL in lockstep on random stimuli and on
# the directed ones, of the DSDPV1 also on all scenarios that end before 120 ms of simulated time; then tables, and what was not reached with its
# explanation (coverage.txt of the chip). Fails when a run differs, a line or bit that was not reached has no explanation, or an explanation
# explains nothing.
#   coverage.sh PROGRAM [FOLDER FOR RESULTS] [-u to rewrite the figures in docs/rtl.md]
# PROGRAM is the one that loads the RTL that counts (target dsdpv1_rtl_coverage). CHIPS in the environment: these only.
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")/.."
out=${2:-build/rtl-coverage}
end_before_ms=120

# runs CHIP: the arguments of one run each, the longest first
runs() {
  if [ "$1" = dsdpv1_rsu ]; then
    for mode in spi uart parallel; do echo "rtl-random --chip dsdpv1_rsu --mode $mode --cycles 2000000 --seed 1 --jobs 1"; done
  else
    for scenario in scenarios/*.yaml; do
      if grep -qE 'kind: (arm|dsdpv1_rsu|apc3|spc3|vpc3|xgate)' "$scenario"; then continue; fi  # firmware that would have to be built first; other RTL
      end=$(sed -n 's/^end: *\([0-9]*\)ms$/\1/p' "$scenario")
      if [ "${end:-$end_before_ms}" -lt "$end_before_ms" ]; then echo "run $scenario --engine lockstep"; fi
    done
    for seed in 1 2 3; do echo "rtl-random --cycles 4000000 --seed $seed --jobs 1"; done
  fi
  for stimulus in tests/cosim/stimuli/"$1"/*.stimulus; do echo "rtl-random --chip $1 --replay $stimulus"; done
}

# count CHIP [-u]
count() {
  folder=$out/$1
  rm -rf "$folder"
  mkdir -p "$folder/counts" "$folder/logs"
  folder=$(realpath "$folder")
  # shellcheck disable=SC2016  # the inner shell expands
  runs "$1" | DSDPV1_RTL_COVERAGE=$folder/counts xargs -P "$(nproc)" -L 1 sh -c '
    program=$1 log=$2/logs/$$.txt
    shift 2
    echo "dsdpv1-sim $*" >&2
    "$program" "$@" > "$log" 2>&1 || { cat "$log"; exit 1; }' one_run "$program" "$folder" || exit 1
  verilator_coverage --write "$folder/merged.dat" "$folder"/counts/*.dat
  python3 -B rtl_ref/coverage.py report "$folder/merged.dat" --chip "$1" ${2:+"$2"}
}

for chip in ${CHIPS:-$(cd rtl_ref && dirname */files.txt)}; do count "$chip" "${3:-}"; done
