#!/usr/bin/env bash
# merge.sh ROOT: the merge gate leaves to --full what tests/full.md names, and no more. The lists below say which
# boards, sanitized folders and tests it must run, whatever tests/run and that table say. Each row names tests that
# exist, and one that stays. The whole run may take 45 minutes, 25 with a warm cache.
set -uf -o pipefail
cd "$1" || exit 3
failed=0
missing() { echo "$1" && failed=1; }

boards_of_full='mps2_an385 mps2_an500 mps3_an547 nucleo_f446re'
# The core, and readers of foreign bytes.
sanitized='unit fuzz math replay contract hil host.action host.bus host.can host.can_drivers host.edit host.eds host.files host.link host.live
  host.model host.radio host.record host.shadow host.stm32_drivers'
# Bits of every instruction set, loops over every bus, walks, faults, gates.
kept='replay.golden replay.matrix trace.mps2_an386 loop.mps2_an386 tour.mps2_an386 bench.mps2_an386 unit.mps2_an386 hil.olimex_h405.walk
  budget.olimex_h405 budget.opencr trace.qemu_rv32 can.qemu_rv32 trace.zcu102_r5 can_loop.zcu102_r5
  hil.Serial/Campaign.StaysSafeAndTells/noise hil.Can/CanCampaign.StaysSafeAndTells/doubled scenario.Generic21.WalksSideways
  gate.symbols gate.layers gate.format gate.merge launcher.promises contract.mps2_an386'
merge=$(tests/run --plan) full=$(tests/run --plan --full)

runs_board() { [[ $1 =~ (^|$'\n')'boards tests: '[^$'\n']*\ $2\ .*\ ctest\  ]]; } # plan board
boards=$(sed -nE 's/.*"name": "fw-([a-z0-9_]+)".*/\1/p' CMakePresets.json | sort -u)
for board in $boards; do
  runs_board "$full" "$board" || missing "tests/run: not even --full runs the board $board"
  [[ " $boards_of_full " == *" $board "* ]] || runs_board "$merge" "$board" ||
    missing "tests/run: the merge gate leaves out the board $board"
done
promised=$(sed -nE 's/.*kPromisedBoard = "([a-z0-9_]+)".*/\1/p' host/boards/board/cost_promise.hpp)
[[ $promised ]] && runs_board "$merge" "$promised" ||
  missing "tests/run: the merge gate leaves out ${promised:-?}, the board of the cost promises (host/boards/board/cost_promise.hpp)"

option() { sed -nE "s/^$1 tests: .* -$2 ([^ ]+).*/\1/p" <<<"$merge"; } # stage letter
left_out=$(option boards E)
for each in $kept; do
  [[ $left_out && ! $each =~ $left_out ]] || missing "tests/full.md: the merge gate leaves out $each"
done
names=$(option host-asan-ubsan R)
for each in $sanitized; do
  [[ $names && $each.0 =~ $names ]] || missing "tests/run: the sanitizers of the merge gate leave out $each"
done
elsewhere=$(option host-release E)
for each in unit math replay contract hil scenario gate $(cd tests && find host -mindepth 1 -maxdepth 1 -type d | tr / .); do
  [[ ! $each.0 =~ $elsewhere || $each.0 =~ $names ]] || missing "tests/run: the merge gate runs $each nowhere"
done
grep -q '^host-asan-ubsan tests: ' <<<"$full" || missing 'tests/run: --full has no sanitizers'
grep -q '^host-fuzz tests: ' <<<"$full" || missing 'tests/run: --full has no fuzzers'
[[ ! $(sed -nE 's/^host-release tests: .* -E ([^ ]+).*/\1/p' <<<"$full") ]] || missing 'tests/run: --full leaves tests out'

# Suite.Name for GoogleTest, the name for CMake.
declare -A tests of_boards
while read -r each; do tests[$each]=1; done < <(
  grep -rhozE --include='*_test.cpp' 'TEST(_F|_P)?\(\w+,\s*\w+\)' tests | tr -d '\n ' | tr '\0' '\n' | sed -E 's/.*\((.*),(.*)\)/\1.\2/'
  grep -rhoE --include=CMakeLists.txt --include='*.cmake' 'NAME [a-z0-9_.]+' tests | sed 's/.* //'
  grep -oE 'verp_can_(test|split)\([a-z.]+ [a-z_.]+' tests/can/CMakeLists.txt | sed 's/.* //; p; s/$/.more/')
while read -r each; do of_boards[$each]=1; done < <(
  grep -rhoE --include=CMakeLists.txt --include='*.cmake' '\w+\.\$\{VERP_BOARD|_test\(\w+ ' boards | sed -E 's/.*\(//; s/[. ].*//')
is_there() { # `*` is any part of a name
  local board kind=${1%%.*} name=$1
  for board in $boards; do
    [[ $1 != *."$board" && $1 != *."$board"[.*]* ]] && continue
    [[ $kind == '*' || ${of_boards[$kind]:-} ]]
    return
  done
  [[ ! $name =~ ^(.*)/[^/.]*$ ]] || name=${BASH_REMATCH[1]} # the value of a parameter
  [[ ${tests[$1]:-} ]] || { [[ $name =~ ([^./]+)[./]([^./]+)$ ]] && [[ ${tests[${BASH_REMATCH[1]}.${BASH_REMATCH[2]}]:-} ]]; }
}
while IFS='|' read -r _ left kept _; do
  kept=${kept//\`/}
  for each in ${left//\`/} $kept; do
    is_there "$each" || missing "tests/full.md: no test '$each'"
  done
  each=${kept// /}
  [[ ! $each =~ $left_out ]] || missing "tests/full.md: '$each' is left out, too"
done < <(grep '^| `' tests/full.md)

for bound in cold_budget_s=2700 warm_budget_s=1500 give_up_s=5200; do
  value=$(grep -oE "(^| )${bound%=*}=[0-9]+" tests/run | sed 's/.*=//')
  ((${value:-99999} <= ${bound#*=})) || missing "tests/run: ${bound%=*} is ${value:-missing}, at most ${bound#*=}"
done
exit "$failed"
