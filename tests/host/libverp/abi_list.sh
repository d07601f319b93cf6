#!/usr/bin/env bash
# abi_list.sh FOLDER CC: abi.json matches verp.h, by its own script and by a compiler. Changed headers and undocumented
# functions are found.
set -euo pipefail
folder=$1 cc=$2 here=$(dirname "$0")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
say() { echo "abi_list: $*" && exit 1; }
list() { PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$folder/abi_list.py" "$@"; }
compiles() { # LIST FOLDER_OF_HEADER
  /usr/bin/python3 "$here/abi_asserts.py" "$1" >"$scratch/asserts.c" && "$cc" -std=gnu11 -Wall -Werror -fsyntax-only -I "$2" "$scratch/asserts.c"
}

list "$folder/verp.h" | diff "$folder/abi.json" - ||
  say "verp.h (>) is not what abi.json (<) lists; mend it: host/apps/libverp/abi_list.py > host/apps/libverp/abi.json"
compiles "$folder/abi.json" "$folder" || say "the compiler reads verp.h otherwise than abi.json lists it"

# Each function needs a comment directly above it.
bare=$(awk '/^(int|uint32_t|const char\*) verp_[a-z_]+\(/ && before !~ /\*\/$/ {print $0} {before = $0}' "$folder/verp.h" | grep -o 'verp_[a-z_]*(' || true)
[[ -z $bare ]] || say "verp.h says nothing about ${bare//$'\n'/ }"

changes=('s/int16_t vx_tenth_mm_s;/int32_t vx_tenth_mm_s;/' 's/VERP_BUSY = -3/VERP_BUSY = -13/' 's/uint32_t robot, uint64_t\* digest/uint32_t robot, uint32_t* digest/'
  's/double low;/double high_;/' 's/int verp_decide(uint64_t token)/int verp_decide(uint64_t token, int how)/' 's/VERP_POSE = 12/VERP_POSE = 13/'
  's/float zmp_m\[2\]/uint32_t zmp_m[2]/')
for change in "${changes[@]}"; do
  sed "$change" "$folder/verp.h" >"$scratch/verp.h"
  cmp -s "$folder/verp.h" "$scratch/verp.h" && say "verp.h has nothing of '$change' any more"
  list "$scratch/verp.h" | cmp -s "$folder/abi.json" - && say "the list does not show '$change'"
  compiles "$folder/abi.json" "$scratch" 2>/dev/null && say "the compiler does not see '$change'"
done
exit 0
