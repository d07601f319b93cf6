#!/usr/bin/env bash
# tests.sh ROOT: refuses tests that can pass without testing. No test skips itself. No test accepts "status 0 or 1". No
# limit is shorter than the hang limit of tests/run, or it would measure how idle the PC is.
set -uo pipefail
cd "$1" || exit 3
failed=0
refuse() { # reason; lines of grep on stdin
  while IFS= read -r line; do
    echo "${line%%:*}:$(cut -d: -f2 <<<"$line"): $1" && failed=1
  done
}
in_tests() { grep -rnE --include='*.[ch]pp' "$@" tests; }

refuse 'a test that skips itself shows nothing: FAIL() with what is missing' < <(in_tests 'GTEST_SKIP|DISABLED_')
refuse 'a status is 0 or 1, and the run says which' < <(in_tests 'status *== *0 *\|\|.*status *== *1|status *<= *1|status *(!=|>|>=) *2\b')

hang_s=$(sed -nE 's/^hang_s=([0-9]+).*/\1/p' tests/run)
while IFS=: read -r file line limit; do
  ((${limit##* } >= ${hang_s:-0})) || refuse "its limit depends on an idle PC: at least $hang_s s" <<<"$file:$line:"
done < <(grep -rnoE --include=CMakeLists.txt --include='*.cmake' '\bTIMEOUT [0-9]+' tests boards)
exit "$failed"
