#!/usr/bin/env bash
# format.sh ROOT: every C++ file tracked at ROOT is formatted as .clang-format says.
# To repair: git ls-files '*.hpp' '*.cpp' | xargs clang-format -i
set -euo pipefail

cd "$1"
mapfile -t files < <(git ls-files -- '*.hpp' '*.cpp' '*.h' '*.c')
[[ ${#files[@]} -gt 0 ]] || { echo "format: no sources in $PWD" && exit 1; }
clang-format --dry-run -Werror --ferror-limit=3 "${files[@]}"
