#!/usr/bin/env bash
# merge.sh ROOT: the merge gate runs every board and, under sanitizers, every test folder, except those named below.
# Work left to --full must be named here too, not only in tests/run. The whole run may take 40 minutes, 20 with a warm
# cache. Prints what is missing; exit status 1 if anything is.
set -uo pipefail
cd "$1" || exit 3
failed=0
missing() { echo "$1" && failed=1; }

boards_of_full='mps2_an385 mps3_an547' # qemu_rv32 has no floating-point unit either; no robot's board has an M55
# These take minutes: real robots, flashing, windows, searches by many walks, and play. Of tool, the merge gate runs
# only the tests of user input.
folders_of_full='run flash view scene identify survey tune demos'
never='pictures camera'                # OpenGL drivers are not ours
input=host.tool.verp_tool_test.input_tests.0
merge=$(tests/run --plan) full=$(tests/run --plan --full)

runs_board() { grep -q "^fw-$2 tests: ctest " <<<"$1"; } # plan board
while read -r board; do
  runs_board "$full" "$board" || missing "tests/run: not even --full runs the board $board"
  [[ " $boards_of_full " == *" $board "* ]] || runs_board "$merge" "$board" ||
    missing "tests/run: the merge gate leaves out the board $board"
done < <(sed -nE 's/.*"name": "fw-([a-z0-9_]+)".*/\1/p' CMakePresets.json | sort -u)
promised=$(sed -nE 's/.*kPromisedBoard = "([a-z0-9_]+)".*/\1/p' host/board/cost_promise.hpp)
[[ $promised ]] && runs_board "$merge" "$promised" ||
  missing "tests/run: the merge gate leaves out ${promised:-?}, the board of the cost promises (host/board/cost_promise.hpp)"

names=$(sed -nE 's/^host-asan-ubsan tests: .* -R ([^ ]+).*/\1/p' <<<"$merge")
built=$(sed -nE 's/^host-asan-ubsan build: //p' <<<"$merge")
sanitized() { # name-of-a-test folder
  [[ $names && $1 =~ $names && " $built " == *" $2/all "* ]] ||
    missing "tests/run: the sanitizers of the merge gate leave out $1 of $2"
}
for each in unit:unit math:exhaustive replay:replay contract:contract hil:hil nocompile:nocompile; do
  sanitized "${each%:*}.a" "tests/${each#*:}"
done
for each in tests/host/*/CMakeLists.txt; do
  folder=$(basename "$(dirname "$each")")
  [[ $folder == tool || " $folders_of_full $never " == *" $folder "* ]] || sanitized "host.$folder.a" "tests/host/$folder"
done
sanitized "$input" tests/host/tool # the tests of what users type and which files they give
grep -q 'TEST_LIST input_tests' tests/host/tool/CMakeLists.txt || missing 'tests/host/tool: no list of input_tests'
grep -q '^host-asan-ubsan tests: ' <<<"$full" || missing 'tests/run: --full has no sanitizers'

for bound in cold_budget_s=2400 warm_budget_s=1200 give_up_s=5200; do
  value=$(grep -oE "(^| )${bound%=*}=[0-9]+" tests/run | sed 's/.*=//')
  ((${value:-99999} <= ${bound#*=})) || missing "tests/run: ${bound%=*} is ${value:-missing}, at most ${bound#*=}"
done
exit "$failed"
