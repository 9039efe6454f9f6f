#!/usr/bin/env bash
# What ./run installs for each command, and what it says: a clone on a bare system, whose apt-get only writes down what it is asked for.
# shellcheck source=head.sh
. "$(dirname "$0")/head.sh"
run=$1
packages=$2

# Nothing is installed but what $folder/there names; the user is $folder/user, and there is no sudo.
mkdir "$folder/tools"
for tool in bash env dirname awk sed sort comm grep mkdir tail nproc cat paste; do ln -s "$(command -v "$tool")" "$folder/tools/$tool"; done
cp "$run" "$packages" "$folder"
cat >"$folder/tools/dpkg-query" <<'STUB'
#!/usr/bin/env bash
for name in "${@:4}"; do ! grep -qx -e "$name" -e all "${0%/*}/../there" || echo "installed $name"; done
STUB
cat >"$folder/tools/apt-get" <<'STUB'
#!/usr/bin/env bash
folder=${0%/*}/..
case "$*" in
  *--print-uris*) cat "$folder/sizes" ;;
  *install*)
    while [ "$1" != --no-install-recommends ]; do shift; done
    printf '%s\n' "${@:2}" | sort >"$folder/asked"
    [ ! -s "$folder/error" ] || { cat "$folder/error" && exit 100; }
    ;;
esac
STUB
cat >"$folder/tools/id" <<'STUB'
#!/usr/bin/env bash
cat "${0%/*}/../user"
STUB
chmod +x "$folder"/tools/{dpkg-query,apt-get,id}
printf '0 upgraded, 173 newly installed, 0 to remove.\nNeed to get 12.5 MB/137 MB of archives.\nAfter this operation, 1.2 GB of additional disk space will be used.\n' >"$folder/sizes"
echo 0 >"$folder/user"
: >"$folder/there"
: >"$folder/error"

# calls ARGUMENTS...: ./run with nothing but these tools; sets status, told and asked.
calls() {
  : >"$folder/asked"
  status=0
  told=$(cd "$folder" && PATH=$folder/tools ./run "$@" 2>&1) || status=$?
  asked=$(paste -sd ' ' "$folder/asked")
}

# in_groups GROUP...: the names that packages.txt has below these heads.
in_groups() {
  local group
  for group in "$@"; do sed -n "/^\[$group\]$/,/^\[.*\]$/{/^[a-z]/p}" "$packages"; done | sort | paste -sd ' '
}

# expects STATUS WORDS WHAT
expects() {
  [ "$status" -eq "$1" ] || fail "$3: exit $status, not $1"
  [[ $told == *"$2"* ]] || fail "$3: \"$2\" is missing in: $told"
}

# each command asks for its groups and no other, before anything else; here apt-get then fails
calls deps --commands
needs=$told
echo "E: Unable to fetch some archives" >"$folder/error"
while IFS=$'\t' read -r command groups; do
  calls "$command"
  # shellcheck disable=SC2086  # one word a group
  [ "$asked" = "$(in_groups $groups)" ] || fail "$command asks for $asked, its groups are $groups"
  expects 1 "packages.log (Unable to fetch some archives); as root: apt-get install --no-install-recommends " "$command"
  [ "$(wc -l <<<"$told")" -eq 2 ] || fail "$command: not two lines: $told"
done <<<"$needs"
[ "$(grep -c . <<<"$needs")" -ge 20 ] || fail "deps --commands: $needs"
for command in demo sim; do grep -qx "$command"$'\ttoolchain libraries d3 fst' <<<"$needs" || fail "$command needs more than its own groups: $needs"; done
mapfile -t known < <(sed -n 's/^\[\(.*\)\]$/\1/p' "$packages")
while read -r group; do [[ " ${known[*]} " == *" $group "* ]] || fail "packages.txt has no group $group"; done < <(cut -f 2 <<<"$needs" | tr ' ' '\n')
for group in "${known[@]}"; do
  grep -q "\b$group\b" <<<"$needs" || fail "no command needs the group $group"
  [ -n "$(in_groups "$group")" ] || fail "the group $group is empty"
done
calls build fast
[ "$asked" = "$(in_groups toolchain libraries d3 fst developer)" ] || fail "build fast asks for $asked"
calls build debug
[[ $asked != *chromium* && $asked != *slurm* ]] || fail "build debug asks for $asked"

# a group by name, all of them, and what is there already
: >"$folder/error"
calls deps browser lint
expects 0 "run: installing 3 packages (173 with dependencies), 12.5 MB, on the disk 1200 MB; about 1 min" "deps browser lint"
[ "$asked" = "chromium chromium-driver clang-format" ] || fail "deps browser lint asks for $asked"
[ "$(wc -l <<<"$told")" -eq 1 ] || fail "deps browser lint: not one line: $told"
echo chromium >"$folder/there"
calls deps browser
[ "$asked" = chromium-driver ] || fail "deps browser asks for $asked, too"
calls deps
[ "$asked" = "$(in_groups "${known[@]}" | sed 's/ chromium / /')" ] || fail "deps asks for $asked"
calls deps --list browser
expects 0 "chromium chromium-driver" "deps --list"
calls deps --list --tsv browser
[ "$(tail -n 1 <<<"$told")" = $'browser\t2\t1\t173\t12.5\t1200\tchromium chromium-driver' ] || fail "deps --list --tsv: $told"
calls deps --list --tsv
grep -qx $'run demo\t19\t19\t173\t12.5\t1200\ttoolchain libraries d3 fst' <<<"$told" || fail "deps --list --tsv: $told"
[ -z "$asked" ] || fail "deps --list installs $asked"
: >"$folder/sizes"
calls deps --list --tsv d3
expects 0 $'d3\t1\t1\t?\t?\t?\tnode-d3' "without package lists"
expects 0 "apt-get update fetches them" "without package lists"
calls deps d3
expects 0 "run: installing 1 packages" "without package lists"
echo all >"$folder/there"
calls deps toolchain browser
[ "$status $told$asked" = "0 " ] || fail "with all there: exit $status, $told, $asked"
calls deps --list --tsv browser
[ "$(tail -n 1 <<<"$told")" = $'browser\t2\t0\t0\t0\t0\tchromium chromium-driver' ] || fail "with all there: $told"

# without rights
: >"$folder/there"
echo 1000 >"$folder/user"
calls demo
expects 1 "run: 19 packages are missing, and there is no sudo; as root: apt-get install --no-install-recommends build-essential cmake" "without sudo"
[ -z "$asked" ] && [ "$(wc -l <<<"$told")" -eq 1 ] || fail "without sudo: $asked, $told"

finish
