#!/usr/bin/env bash
# boards.sh ROOT: every STM32 board has an entry in each place that boards/README.md, "One more STM32 board", names.
set -uo pipefail
cd "$1" || exit 3
failed=0
missing() { echo "$1: $2; see boards/README.md, One more STM32 board" && failed=1; }
holds() { grep -qE -- "$2" "$1" 2>/dev/null; }

steps=$(sed -n '/^\*\*One more STM32 board/,/^\*\*One more board/p' boards/README.md)
for place in board.hpp memory.ld CMakeLists.txt README.md CMakePresets.json host/boards/flash/recipe.cpp \
  tests/host/stm32_boards/CMakeLists.txt boards/README.md; do
  [[ $steps == *"$place"* ]] || { echo "boards/README.md: its steps do not name $place" && failed=1; }
done

for file in boards/*/CMakeLists.txt; do
  holds "$file" '^verp_add_stm32_loop\(\)' || continue
  folder=$(dirname "$file") board=$(basename "$(dirname "$file")")
  holds "$file" '^verp_add_flash_tests\(' || missing "$file" 'no verp_add_flash_tests()'
  holds "$folder/board.hpp" "kName = \"$board\"" || missing "$folder/board.hpp" "kName is not \"$board\""
  for constant in kCore kReplayBlock kFamily kClockPlan kWithoutClockController kServoPort kOperatorPort kLed kServoPower kImu \
    kBattery kEmergencyStop kButtons kBuzzer; do
    holds "$folder/board.hpp" "\\b$constant\\b" || missing "$folder/board.hpp" "no $constant"
    [[ $steps == *"$constant"* ]] || { echo "boards/README.md: its steps do not name $constant" && failed=1; }
  done
  if holds "$file" '^verp_add_stm32_can_loop\(\)'; then
    holds "$folder/board.hpp" '\bkCanPort\b' || missing "$folder/board.hpp" 'no kCanPort'
    holds tests/host/stm32_boards/CMakeLists.txt "foreach\\(board .*\\b$board\\b" ||
      missing tests/host/stm32_boards/CMakeLists.txt "$board is not in its list"
  fi
  for symbol in verp_params_begin verp_params_bytes verp_actions_begin verp_actions_bytes verp_stack_size; do
    holds "$folder/memory.ld" "^$symbol *=" || missing "$folder/memory.ld" "no $symbol"
    [[ $steps == *"$symbol"* ]] || { echo "boards/README.md: its steps do not name $symbol" && failed=1; }
  done
  holds "$folder/README.md" 'Flash recipe' || missing "$folder/README.md" 'no flash recipe'
  [[ $(grep -cE "\"name\": \"fw-$board\"" CMakePresets.json) == 3 ]] ||
    missing CMakePresets.json "fw-$board is not there three times: to configure, to build, to test"
  holds host/boards/flash/recipe.cpp "\"$board\"" || missing host/boards/flash/recipe.cpp "no row for $board"
  holds boards/README.md "^\\| \`$board/\` " || missing boards/README.md "no row for $board"
done
exit "$failed"
