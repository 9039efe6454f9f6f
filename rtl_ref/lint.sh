#!/bin/sh
# Lints the reference RTL with all three tools in all its builds (normal, with faults, with limits of run time, with both), and compares
# the numbers of the faults in the sources with faults.txt. Silent when all is well.
set -eu
cd "$(dirname "$0")"
files=$(cat files.txt)

# quiet COMMAND...: fails also when the command says anything
quiet() {
  output=$("$@" 2>&1) && [ -z "$output" ] || { echo "$output"; exit 1; }
}

for define in "" -DDSDPV1_FAULTS -DDSDPV1_RUN_TIME_LIMITS "-DDSDPV1_FAULTS -DDSDPV1_RUN_TIME_LIMITS"; do
  quiet verilator --lint-only -Wall $define -I. -I../registers --top-module dsdpv1 $files
  quiet iverilog -g2012 -Wall $define -I. -I../registers -s dsdpv1 -t null $files
  quiet yosys -q -e '.*' -p "read_verilog -sv $define -I. -I../registers $(echo $files); hierarchy -check -top dsdpv1; proc; check -assert"
done

in_sources=$(grep -ho 'FAULT([0-9]*)' profibus/*.sv dsdpv1/*.sv | tr -dc '0-9\n' | sort -nu)
in_list=$(grep -v '^#' faults.txt | cut -d' ' -f1 | sort -n)
[ "$in_sources" = "$in_list" ] || { echo "faults.txt and the FAULT(n) of the sources differ"; exit 1; }
