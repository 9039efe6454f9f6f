#!/usr/bin/env bash
# An archive of g++ that was compiled for optimisation across files, as the preset fast does, and a program of clang++.
#   lto.sh ROOT GXX CLANG OPTIONS...      the options that the archives of this project are compiled with
set -euo pipefail
root=$1 gxx=$2 clang=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cat >"$folder/program.cpp" <<'PROGRAM'
#include "model/systemc/character_line.hpp"
int main() { return dsdpv1::systemc::frame_of(0x00, true, true) == 0x400 ? 0 : 1; }
PROGRAM
"$gxx" -std=c++17 -O3 -flto "${@:4}" -I"$root" -c "$root/model/systemc/character_line.cpp" -o "$folder/part.o"
ar rc "$folder/archive.a" "$folder/part.o"
"$clang" -std=c++17 -O3 -I"$root" "$folder/program.cpp" "$folder/archive.a" -o "$folder/program"
"$folder/program"
