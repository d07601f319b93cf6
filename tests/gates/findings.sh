#!/usr/bin/env bash
# findings.sh ROOT: tests/findings.md numbers its rows from 1 without a gap, and each test it names exists. The prefix
# of a GoogleTest name gives the folder; other names are CMake tests.
set -uo pipefail
cd "$1" || exit 3
table=tests/findings.md failed=0
complain() { echo "$table:$1" && failed=1; }

exists() { # name
  local name=$1 folder suite
  suite=${name%.*} suite=${suite##*.}
  case $name in
  unit.*.*.*) folder=${name#unit.} folder=tests/unit/${folder%%.*} ;;
  hil.* | scenario.* | contract.*) folder=tests/${name%%.*} ;;
  host.*.*.*) folder=${name#host.} folder=tests/host/${folder%%.*} ;;
  Bench.*) folder=tests/bench ;;
  *) # a board's tests carry its name
    grep -rqE --include=CMakeLists.txt --include='*.cmake' "NAME (${name//./\\.}|${name%%.*}\.\\$\{VERP_BOARD\})( |\$)" tests boards
    return
    ;;
  esac
  grep -rqzE --include='*_test.cpp' "TEST(_F|_P)?\($suite,[[:space:]]*${name##*.}\)" "$folder" 2>/dev/null
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
