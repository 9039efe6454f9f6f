#!/usr/bin/env bash
# What ./run sim builds before it calls the program: a clone with a cmake that only writes down what it is asked for.
# shellcheck source=head.sh
. "$(dirname "$0")/head.sh"
run=$1
source=$2

mkdir -p "$folder"/{tools,build/default/apps,scenarios}
cp "$run" "$folder/run"
cp "$source"/scenarios/*.yaml "$folder/scenarios"
printf '[toolchain]\nbash\n[firmware]\nbash\n' >"$folder/packages.txt"
touch "$folder/CMakePresets.json"
printf '#!/bin/sh\necho "$@"\n' >"$folder/build/default/apps/dsdpv1-sim"
cat >"$folder/tools/cmake" <<STUB
#!/bin/sh
echo "\$@" >>"$folder/asked"
echo "cmake says much"
[ ! -e "$folder/broken" ] || exit 1
case "\$*" in --preset*) [ ! -e "$folder/compiler" ] || echo 'build dsdpv1_firmware: phony' >"$folder/build/default/build.ninja" ;; esac
STUB
chmod +x "$folder/tools/cmake" "$folder/build/default/apps/dsdpv1-sim"

# builds TARGETS ARGUMENTS...: ./run sim ARGUMENTS builds the program and these, and hands it the arguments.
builds() {
  local targets=$1 told
  shift
  : >"$folder/asked"
  told=$(cd "$folder" && PATH=$folder/tools:$PATH ./run sim "$@") || fail "sim $*: exit $?"
  [ "$told" = "$*" ] || fail "sim $*: the program was told $told"
  grep -q -- "--target dsdpv1-sim$targets\$" "$folder/asked" || fail "sim $*: not$targets but: $(cat "$folder/asked")"
}

echo 'build all: phony' >"$folder/build/default/build.ninja"
builds "" run scenarios/power_on_12m.yaml
builds "" run --help
status=0
message=$(cd "$folder" && PATH=$folder/tools:$PATH ./run sim run scenarios/arm_board_12m.yaml 2>&1) || status=$?
[ "$status" -eq 1 ] || fail "without a compiler: exit $status"
[[ $message == *"needs arm-none-eabi-gcc"* ]] || fail "without a compiler: $message"

touch "$folder/compiler"
for command in run sweep serve compare; do builds " dsdpv1_firmware" "$command" scenarios/arm_board_12m.yaml; done
builds " dsdpv1_firmware" run scenarios/power_on_12m.yaml --set user_cpu.elf=build/default/examples/firmware/device_O0.elf
builds " dsdpv1_rtl_libraries dsdpv1_firmware" run scenarios/arm_board_12m.yaml --engine lockstep
for action in check regenerate; do builds " dsdpv1_firmware" traces "$action"; done
builds " dsdpv1_firmware" traces check arm_board_12m
builds " dsdpv1_rtl_libraries" traces check power_on_12m --engine rtl
builds "" traces list
builds " dsdpv1_firmware" regress
for engines in skip,rtl rtl,skip step,rtl,skip skip,lockstep; do builds " dsdpv1_rtl_libraries dsdpv1_firmware" regress --engine "$engines"; done
builds "" run scenarios/arm_board_12m.yaml --set user_cpu.elf=my.elf
echo '# elf: build/default/examples/firmware/device_O2.elf' >"$folder/mine.yaml"
builds "" run mine.yaml

# configures OPTIONS COMMAND [ARGUMENTS...]: with these options, "-" for not at all.
configures() {
  local options=$1 found
  shift
  : >"$folder/asked"
  (cd "$folder" && PATH=$folder/tools:$PATH ./run "$@") >/dev/null 2>&1 || fail "$*: exit $?"
  found=$(sed -n 's/^--preset //p' "$folder/asked")
  [ "${found:--}" = "$options" ] || fail "$*: configures $found, not $options"
}

# tests come in with the first command that builds them, and stay; what has been installed since is found
rm "$folder/build/default/build.ninja"
configures "default --fresh -DBUILD_TESTING=OFF" sim run mine.yaml
echo BUILD_TESTING:BOOL=OFF >"$folder/build/default/CMakeCache.txt"
configures - sim run mine.yaml
configures "default -DBUILD_TESTING=ON" build
echo BUILD_TESTING:BOOL=ON >"$folder/build/default/CMakeCache.txt"
configures - build
configures - sim run mine.yaml
touch -d @1 "$folder/CMakePresets.json"
touch -d @2 "$folder/build/default/build.ninja"
configures default sim run mine.yaml
configures "debug --fresh -DBUILD_TESTING=ON" build debug
configures "fast --fresh -DBUILD_TESTING=OFF" build fast
configures "fuzz --fresh -DBUILD_TESTING=OFF" build fuzz

: >"$folder/asked"
told=$(cd "$folder" && PATH=$folder/tools:$PATH ./run build library)
[ "$told" = "$folder/build/default/capi" ] || fail "build library: told $told"
grep -q -- "--target dsdpv1_capi --" "$folder/asked" || fail "build library: $(cat "$folder/asked")"

# the first time takes long
message=$(cd "$folder" && PATH=$folder/tools:$PATH ./run sim run mine.yaml 2>&1)
[[ $message != *compiling* ]] || fail "a second time: $message"
rm "$folder/build/default/apps/dsdpv1-sim"
message=$(cd "$folder" && PATH=$folder/tools:$PATH ./run sim run mine.yaml 2>&1) || true
[[ $message == *"compiling dsdpv1-sim for the first time: about 4 minutes"* ]] || fail "the first time: $message"

printf '#!/bin/sh\necho "$@"\n' >"$folder/build/default/apps/dsdpv1-sim"
chmod +x "$folder/build/default/apps/dsdpv1-sim"

# Of what CMake and ninja print one line is seen, and the end where they fail; all of it in CI, and with --verbose.
speaks() {
  message=$(cd "$folder" && env -u CI PATH="$folder/tools:$PATH" "$@" sim run mine.yaml 2>&1) || status=$?
}
rm -f "$folder/build/default/build.ninja"
speaks ./run
[ "$message" = "run mine.yaml" ] || fail "more is seen than the program prints: $message"
speaks ./run --verbose
[[ $message == *"cmake says much"* ]] || fail "--verbose: $message"
speaks env CI=true ./run
[[ $message == *"cmake says much"* ]] || fail "in CI: $message"
# on a terminal the last line, as wide as it is
if command -v script >/dev/null; then
  shown=$(cd "$folder" && env -u CI PATH="$folder/tools:$PATH" script -qec "stty cols 12; ./run sim run mine.yaml" /dev/null </dev/null)
  [[ $shown == *$'\r\033[Kcmake says \r'* ]] || fail "on a terminal: $shown"
fi
touch "$folder/broken"
status=0
speaks ./run
[ "$status" -eq 1 ] || fail "cmake fails: exit $status"
[[ $message == *"cmake failed, the end of $folder/build/default.log:"*"cmake says much" ]] || fail "cmake fails: $message"

# release: its files, then the bare system where that is asked for
rm "$folder/broken"
mkdir -p "$folder"/{cmake,.venv/bin,tests/release,tests/docs}
for name in requirements.lock requirements-test.lock; do touch "$folder/$name" "$folder/.venv/$name"; done
ln -s "$(command -v python3)" "$folder/.venv/bin/python"
for program in cmake/release tests/release/bare_system tests/docs/check_docs; do
  printf 'import os, sys\nprint("%s", *map(os.path.basename, sys.argv[1:]))\nsys.exit(os.path.exists("%s.fails"))\n' "$program" "$folder/$program" >"$folder/$program.py"
done
files="cmake/release default release"
bare="tests/release/bare_system release bare"
releases() {
  local expected=$1 status=0 told
  shift
  told=$(cd "$folder" && PATH=$folder/tools:$PATH ./run release "$@" 2>/dev/null | paste -sd ';') || status=$?
  [ "$told $status" = "$expected" ] || fail "release $*: $told $status, not $expected"
}
releases "$files 0"
releases "$files;$bare 0" --check
releases "$files;$bare --record;tests/docs/check_docs update_bare 0" --record
touch "$folder/tests/release/bare_system.fails"
releases "$files;$bare --record 1" --record
touch "$folder/cmake/release.fails"
releases "$files 1" --check

finish
