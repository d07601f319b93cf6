#!/usr/bin/env bash
# format.sh ROOT: clang-format changes no tracked C++ file.
# To repair: git ls-files '*.hpp' '*.cpp' | xargs clang-format -i
set -euo pipefail

cd "$1"
mapfile -t files < <(git ls-files -- '*.hpp' '*.cpp' '*.h' '*.c')
[[ ${#files[@]} -gt 0 ]] || { echo "format: no sources in $PWD" && exit 1; }
clang-format --dry-run -Werror --ferror-limit=3 "${files[@]}"
