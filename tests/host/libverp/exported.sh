#!/usr/bin/env bash
# exported.sh FOLDER LIBRARY NM: library, exported.map and verp.h agree, except for the loops that ODE calls. Every
# declaration has a comment.
set -euo pipefail
folder=$1 library=$2 nm=$3
declared=$(grep -oE '\bverp_[a-z_]+\(' "$folder/verp.h" | grep -v ')' | tr -d '(' | LC_ALL=C sort -u)
listed=$(grep -oE '^ +[A-Za-z0-9_]+;' "$folder/exported.map" | tr -d ' ;' | LC_ALL=C sort)
exported=$("$nm" -D --defined-only "$library" | awk '$2 == "T" { sub(/@.*/, "", $3); print $3 }' | LC_ALL=C sort)
[[ -n $declared ]] || { echo "verp.h declares nothing" && exit 1; }
diff <(echo "$declared") <(grep -v '^_Z' <<<"$listed") || { echo "exported.map (>) is not what verp.h (<) declares" && exit 1; }
diff <(echo "$listed") <(echo "$exported") || { echo "the library (>) does not export what exported.map (<) lists" && exit 1; }
awk '/^(int|uint32_t|const char\*) verp_/ && before !~ /\*\/$|;$/ { print FILENAME ":" FNR ": no words: " $0; bad = 1 }
     { before = $0 } END { exit bad }' "$folder/verp.h"
