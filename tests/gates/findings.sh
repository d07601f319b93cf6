#!/usr/bin/env bash
# findings.sh ROOT: tests/findings.md numbers its rows from 1 without a gap, and each test it names exists. The prefix
# of a GoogleTest name gives the folder; other names are CMake tests.
set -uo pipefail
cd "$1" || exit 3
table=tests/findings.md failed=0
complain() { echo "$table:$1" && failed=1; }

declare -A tests # "tests/unit/gait Suite.Name", or a name that CMake gives
while read -r each; do tests[$each]=1; done < <(
  grep -rozE --include='*_test.cpp' 'TEST(_F|_P)?\(\w+,\s*\w+\)' tests | tr -d '\n ' | tr '\0' '\n' |
    sed -E 's,^(tests/(unit|host)/[^/]+|tests/[^/]+)/[^:]*:.*\((.*)\,(.*)\),\1 \3.\4,'
  grep -rhoE --include=CMakeLists.txt --include='*.cmake' 'NAME ([a-z0-9_.]+|[a-z0-9_]+\.\$\{VERP_BOARD\})( |$)' tests boards | sed 's/NAME //; s/ $//')
exists() { # name
  local name=$1 test
  test=${name%.*} test=${test##*.}.${name##*.}
  case $name in
  unit.*.*.* | host.*.*.*) name="${name#*.}" name="tests/${1%%.*}/${name%%.*} $test" ;;
  hil.* | scenario.* | contract.*) name="tests/${name%%.*} $test" ;;
  Bench.*) name="tests/bench $test" ;;
  esac
  [[ ${tests[$name]:-} || ${tests["${name%%.*}.\${VERP_BOARD}"]:-} ]] # a board's tests carry its name
}

number=0 line=0
while IFS= read -r row; do
  line=$((line + 1))
  [[ $row =~ ^\|\ ([0-9]+)\ \| ]] || continue
  number=$((number + 1))
  [[ ${BASH_REMATCH[1]} == "$number" ]] || { complain "$line: row $number is missing" && number=${BASH_REMATCH[1]}; }
  while read -r name; do
    exists "$name" || complain "$line: no test '$name' in the sources"
  done < <(sed 's/.*|\(.*\)|$/\1/' <<<"$row" | grep -oE '`[^` ]+`' | tr -d '`' | grep -F . )
done <"$table"
((number >= 23)) || complain "1: row $((number + 1)) is missing"
exit "$failed"
