#!/usr/bin/env bash
# tidy.sh ROOT BUILD: clang-tidy on the core, with the flags in BUILD/compile_commands.json.
set -euo pipefail

cd "$1"
mapfile -t files < <(find common firmware -name '*.cpp' | LC_ALL=C sort)
[[ ${#files[@]} -gt 0 ]] || { echo "tidy: no sources in $PWD/common" && exit 1; }
compiled=()
for file in "${files[@]}"; do
  grep -qF "\"file\": \"$PWD/$file\"" "$2/compile_commands.json" && compiled+=("$file")
done
[[ ${#compiled[@]} -gt 0 ]] || { echo "tidy: $2/compile_commands.json compiles none of them" && exit 1; }
status=0
output=$(printf '%s\0' "${compiled[@]}" | xargs -0 -n 2 -P "$(nproc)" clang-tidy --quiet -p "$2" 2>&1) || status=1
grep -vE '^[0-9]+ warnings? generated' <<<"$output" | awk '!seen[$0]++' || true
exit "$status"
