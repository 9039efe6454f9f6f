#!/usr/bin/env bash
# The command line of ./run: help, and one line with exit 2 for what it does not know.
# shellcheck source=head.sh
. "$(dirname "$0")/head.sh"
run=$1

# refuses WORDS ARGUMENTS...: exit 2, nothing on stdout, one line on stderr with these words.
refuses() {
  local words=$1 status=0 errors
  shift
  errors=$("$run" "$@" 2>&1 >/dev/null) || status=$?
  [ "$status" -eq 2 ] || fail "run $*: exit $status, not 2"
  [ "$(wc -l <<<"$errors")" -eq 1 ] || fail "run $*: not one line: $errors"
  [[ $errors == *"$words"* ]] || fail "run $*: \"$words\" is missing in: $errors"
}

help=$("$run" --help) || fail "--help: exit $?"
for command in demo test edit sim nightly accept-campaign rtl-random rtl-faults rtl-synth rtl-board rtl-coverage rtl-formal rtl-gates mutants fuzz bench traces cosim registers docs build format lint generate conformance release deps; do
  grep -q "^  $command " <<<"$help" || fail "--help does not explain $command"
done
grep -q '^Examples:' <<<"$help" || fail "--help has no examples"
wide=$(awk 'length($0) > 80' <<<"$help")
[ -z "$wide" ] || fail "--help is wider than 80 columns: $wide"
[ "$("$run")" = "$help" ] || fail "without arguments it does not print the help"

for command in demo test nightly docs rtl-synth rtl-board reproducible release build conformance deps; do
  help=$("$run" "$command" --help) || fail "$command --help: exit $?"
  [[ $help == "  $command "* ]] || fail "$command --help does not explain it: $help"
  [ "$(grep -c '^  [^ ]' <<<"$help")" -eq 1 ] || fail "$command --help explains others, too: $help"
done

version=$("$run" --version) || fail "--version: exit $?"
[[ $version =~ ^dsdpv1\ [0-9]+\.[0-9]+\.[0-9]+(\ \([^ ]+\))?$ ]] || fail "--version prints $version"
[ "${version%% (*}" = "dsdpv1 $2" ] || fail "--version prints $version, this is $2"
if git -C "$(dirname "$run")" rev-parse HEAD >/dev/null 2>&1; then
  [[ $version == *"($(git -C "$(dirname "$run")" describe --always --abbrev=9)"*")" ]] || fail "--version names no commit: $version"
fi

refuses "unknown command dmeo (did you mean demo?), expected demo test edit sim" dmeo
refuses "unknown command whatever, expected demo" whatever
refuses "unknown group tets (did you mean tests?), expected toolchain libraries" deps d3 tets
refuses "unknown group --force, expected toolchain" deps --force
refuses "--tsv is for --list" deps --tsv
refuses "no file of the project" edit nowhere.cpp
refuses "expected --quick" test --fast
refuses "again is one argument too many, expected one of --quick" test --quick again
refuses "expected default fast library debug coverage fuzz" build release
refuses "expected --record --released" conformance now
refuses "unknown argument --chekc, expected --check --record" release --chekc
refuses "unknown argument now, expected --out FOLDER" demo now
refuses "debug is one argument too many, expected one of default fast" build fast debug
refuses "--record is one argument too many, expected one of --check --record" release --check --record
refuses "rtl-formal takes no arguments" rtl-formal quickly
refuses "rtl-gates: argument --cells: invalid choice: 'asic'" rtl-gates --list --cells asic
refuses "invalid choice: 'sdv'" registers --format sdv
refuses "nightly takes no arguments" nightly quickly
refuses "rtl-coverage takes no arguments" rtl-coverage again
refuses "unknown row fast, expected core_2" bench --only fast
refuses "0 is no number of rounds" bench --rounds 0
refuses "unknown row core_2, expected arm" bench --instructions --only core_2
refuses "--record needs --instructions" bench --record
refuses "unknown target gds, expected telegram" fuzz gds
refuses "0 is no number of seconds" fuzz --seconds 0
refuses "--reproduce needs one target" fuzz --reproduce "$run"
refuses "--seconds and --runs, expected one of them" fuzz --seconds 1 --runs 1

finish
