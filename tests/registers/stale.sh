#!/usr/bin/env bash
# generate.py --check on a copy of the files: silent when they are current, exit 1 and the file's name when one is not.
set -euo pipefail
python=$1 root=$2
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
mkdir -p "$copy/registers" "$copy/docs"
cp "$root"/registers/{generate.py,*.rdl,*_regs.*} "$copy/registers"
cp "$root"/docs/registers*.md "$copy/docs"

check() { "$python" "$copy/registers/generate.py" --check; }

# finds_stale FILE: --check must fail and name this file alone.
finds_stale() {
  local status=0 answer
  answer=$(check) || status=$?
  if [ "$status" -ne 1 ] || [ "$answer" != "$1: stale, run registers/generate.py" ]; then
    echo "FAILED: $1 is stale, but --check says \"$answer\" and exits $status"
    exit 1
  fi
}

check
for file in registers/{dsdpv1_regs.{hpp,h,svh},spc3_regs.{hpp,h}} docs/registers{,_spc3}.md; do
  sed -i 's/Generated from/Made from/' "$copy/$file"
  finds_stale "$file"
  "$python" "$copy/registers/generate.py" >/dev/null
done
rm "$copy/docs/registers.md"
finds_stale docs/registers.md
