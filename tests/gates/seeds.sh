#!/usr/bin/env bash
# seeds.sh ROOT: the sets in tests/scenario/seeds.txt share no seed, every `--seed N` below tests/ is a gate seed, and
# every text that says `tuning seeds A-B`, `gate seeds A-B` or `report seeds A-B` names seeds of that set.
set -euo pipefail

cd "$1"
table=tests/scenario/seeds.txt
set_count=$(grep -cvE '^#|^$' "$table")
((set_count == 3)) || { echo "$table: three sets are wanted, $set_count found" && exit 1; }
mapfile -t files < <(find . \( -path ./build -o -path ./.git -o -path ./tests/gates \) -prune -o -type f \
  \( -name '*.[ch]pp' -o -name '*.md' -o -name '*.sh' -o -name '*.sdf' -o -name '*.table' -o -name '*.txt' \) -print | LC_ALL=C sort)

awk -v table="$table" '
BEGIN {
  while ((getline line <table) > 0) {
    if (line ~ /^#/ || split(line, word, " ") != 3) continue
    for (other in first) {
      if (word[2] <= last[other] && first[other] <= word[3]) {
        printf "%s: %s and %s have seeds in common\n", table, other, word[1]; bad = 1
      }
    }
    first[word[1]] = word[2] + 0; last[word[1]] = word[3] + 0
  }
}
function judge(set, a, b) {
  if (a + 0 >= first[set] && b + 0 <= last[set]) return
  printf "%s:%d: seed %s is no %s seed (%d to %d, %s)\n", FILENAME, FNR, a == b ? a : a "-" b, set, first[set], last[set], table
  bad = 1
}
FILENAME ~ /^\.\/tests\/(scenario|host|target|hil|can)\// {
  rest = $0
  while (match(rest, /--seed[ =]+[0-9]+/)) {
    seed = substr(rest, RSTART, RLENGTH); sub(/^[^0-9]+/, "", seed)
    if ($0 !~ /expect_refused/) judge("gate", seed, seed)
    rest = substr(rest, RSTART + RLENGTH)
  }
}
{
  rest = $0
  while (match(rest, /(tuning|gate|report) seeds [0-9]+-[0-9]+/)) {
    split(substr(rest, RSTART, RLENGTH), word, " ")
    split(word[3], range, "-")
    judge(word[1], range[1], range[2])
    rest = substr(rest, RSTART + RLENGTH)
  }
}
END { exit bad }' "${files[@]}"
