# shellcheck shell=bash
# What the scripts of this folder begin with: a folder of their own, and a count of what fails. Bash.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# Their last line.
finish() {
  echo "$failures failures"
  [ "$failures" -eq 0 ]
}
