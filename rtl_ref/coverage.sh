#!/bin/sh
# Coverage of the reference RTL by lines and toggles: model and RTL in lockstep on all scenarios that end before 120 ms of simulated
# time, on random stimuli and on the directed ones; then tables, and what was not reached with its explanation (coverage.txt). Fails
# when a run differs, a line or bit that was not reached has no explanation, or an explanation explains nothing.
#   coverage.sh PROGRAM [FOLDER FOR RESULTS] [-u to rewrite the figures in docs/rtl.md]
# PROGRAM is the one that loads the RTL that counts (target dsdpv1_rtl_coverage).
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")/.."
out=${2:-build/rtl-coverage}
end_before_ms=120
random_cycles=4000000
rm -rf "$out/counts" "$out/logs"
mkdir -p "$out/counts" "$out/logs"
out=$(realpath "$out")

# The arguments of one run each, the longest first
runs() {
  for scenario in scenarios/*.yaml; do
    if grep -q 'kind: arm' "$scenario"; then continue; fi  # firmware that would have to be built first
    end=$(sed -n 's/^end: *\([0-9]*\)ms$/\1/p' "$scenario")
    if [ "${end:-$end_before_ms}" -lt "$end_before_ms" ]; then echo "run $scenario --engine lockstep"; fi
  done
  for seed in 1 2; do echo "rtl-random --cycles $((random_cycles / 2)) --seed $seed --jobs 1"; done
  for stimulus in tests/cosim/stimuli/*.stimulus; do echo "rtl-random --replay $stimulus"; done
}

# shellcheck disable=SC2016  # the inner shell expands
runs | DSDPV1_RTL_COVERAGE=$out/counts xargs -P "$(nproc)" -L 1 sh -c '
  program=$1 log=$2/logs/$$.txt
  shift 2
  echo "dsdpv1-sim $*" >&2
  "$program" "$@" > "$log" 2>&1 || { cat "$log"; exit 1; }' one_run "$program" "$out" || exit 1

verilator_coverage --write "$out/merged.dat" "$out"/counts/*.dat
python3 -B rtl_ref/coverage.py report "$out/merged.dat" ${3:+"$3"}
