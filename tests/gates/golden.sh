#!/usr/bin/env bash
# golden.sh ROOT: each kCoreVersion has one digest of the long trace, for ever. The last line of
# tests/golden/core_versions.txt is the current one. Versions rise, no digest recurs, committed lines never change. New
# numbers in generic21's file need a new version, too.
set -euo pipefail

cd "$1"
table=tests/golden/core_versions.txt trace=tests/golden/long_trace.txt
bad=0
complain() { echo "$1" && bad=1; }

version=$(sed -nE 's/^inline constexpr std::uint32_t kCoreVersion = ([0-9]+);.*/\1/p' common/model/image.hpp)
digest=$(awk '$1 == "all" { print $3 }' "$trace")
read -r last_version last_digest < <(tail -n 1 "$table")
[[ $version && $version == "$last_version" ]] ||
  complain "$table: ends with version $last_version, and common/model/image.hpp has kCoreVersion $version: tests/replay/update_golden"
[[ $digest && $digest == "$last_digest" ]] ||
  complain "$trace: the digest $digest is not that of version $last_version in $table: raise kCoreVersion in common/model/image.hpp, then tests/replay/update_golden"
awk '/^#/ { next } $1 <= before { exit 1 } $2 in seen { exit 1 } { before = $1; seen[$2] }' "$table" ||
  complain "$table: versions rise, and each has a digest of its own"
if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
  changed=$({ git log --format= -p -- "$table" && git diff HEAD -- "$table"; } | sed -nE 's/^-([0-9]+ .*)/\1/p')
  [[ -z $changed ]] || complain "$table: was committed, and is another now: $changed. Raise kCoreVersion instead"
fi
exit "$bad"
