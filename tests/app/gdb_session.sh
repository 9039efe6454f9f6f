#!/usr/bin/env bash
# gdb-multiarch on the ARM board of a scenario: breakpoint, step, memory, then kill, which ends the run like Ctrl-C. Then on the board of serve.
# Usage: gdb_session.sh DSDPV1_SIM FIRMWARE, in the project's folder.
set -euo pipefail
sim=$1 firmware=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "$1" >&2
  cat "$folder"/{out,err,gdb} >&2 || true  # dp is a terminal, without an end
  exit 1
}

# start COMMAND...: sets run and port
start() {
  "$sim" "$@" --set "user_cpu.elf=$firmware" --gdb 0 >"$folder/out" 2>"$folder/err" &
  run=$!
  until [ "$(wc -l <"$folder/err")" -ge 1 ] && grep -q 'localhost:[0-9]' "$folder/err"; do  # the whole line
    kill -0 "$run" 2>/dev/null || fail "the run did not wait for gdb"
  done
  port=$(sed -n 's/.*localhost:\([0-9]*\).*/\1/p' "$folder/err" | head -n 1)
}

start run scenarios/arm_board_12m.yaml --no-progress

gdb-multiarch -nx -batch -ex 'set remotetimeout 60' -ex "target remote localhost:$port" -ex 'break dsdpv1_initialise' -ex continue \
  -ex 'print config->address' -ex stepi -ex 'monitor time' \
  -ex 'x/1bx 0x60000004' -ex 'x/4bx 0x60000000' -ex 'x/1wx 0x40021004' -ex 'x/1wx 0x40012008' -ex 'x/1wx 0xA0000004' -ex 'monitor time' -ex kill "$firmware" >"$folder/gdb" 2>&1 || fail "gdb failed"
status=0
wait "$run" || status=$?

[ "$status" -eq 130 ] || fail "exit code $status after kill, wanted 130"
grep -q 'Breakpoint 1.* dsdpv1_initialise' "$folder/gdb" || fail "gdb did not stop at the breakpoint"
grep -q '^\$1 = 5' "$folder/gdb" || fail "gdb did not read the station address from the firmware's memory"
grep -q '^0x60000004:.*0xc5' "$folder/gdb" || fail "gdb did not read B004"
grep -q '^0x60000000:.*0x01.*0x0d.*0x07.*0x01' "$folder/gdb" || fail "gdb did not read the version in the DPRAM"
grep -q '^0x40021004:.*0x001d040a' "$folder/gdb" || fail "gdb did not read RCC_CFGR"
grep -q '^0x40012008:.*0x0000' "$folder/gdb" || fail "gdb did not read the pins of port G"
grep -q '^0xa0000004:.*0x00000501' "$folder/gdb" || fail "gdb did not read FSMC_BTR1"
[ "$(grep -c ' us' "$folder/gdb")" -lt 2 ] || [ "$(grep ' us' "$folder/gdb" | sort -u | wc -l)" -eq 1 ] || fail "time went on while gdb looked"
grep -q 'INTERRUPTED' "$folder/out" || fail "the run does not say that it was interrupted"

start serve scenarios/arm_board_12m.yaml --pty "$folder/dp" --for 100ms
gdb-multiarch -nx -batch -ex 'set remotetimeout 60' -ex "target extended-remote localhost:$port" -ex load -ex start -ex detach "$firmware" >"$folder/gdb" 2>&1 || fail "gdb failed"
status=0
wait "$run" || status=$?
grep -q 'Transfer rate' "$folder/gdb" || fail "gdb did not load"
grep -q '^Temporary breakpoint 1, main' "$folder/gdb" || fail "gdb did not start"
grep -q 'start-up finished' "$folder/out" || fail "serve did not go on after gdb (exit code $status)"

status=0
"$sim" serve scenarios/serve_19k2.yaml --gdb 0 >"$folder/out" 2>&1 || status=$?
[ "$status" -eq 2 ] || fail "serve without a board: exit code $status"
grep -q 'dsdpv1-sim serve: --gdb needs a slave whose user_cpu has kind: arm' "$folder/out" || fail "serve without a board says something else"
