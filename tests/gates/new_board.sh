#!/usr/bin/env bash
# new_board.sh ROOT BUILD: adds a first board as boards/README.md, "One more STM32 board", says, in a copy of the
# sources. It copies olimex_h405, whose chip has an emulator. boards.sh must find nothing missing, the images must
# build within their budget, and a unit test must run.
set -euo pipefail
root=$1 tree=$2/new_board old=olimex_h405 new=my_board
mkdir -p "$tree"
git -C "$root" ls-files -z | tar -C "$root" --null -T - -cf - | tar -C "$tree" -xf -
cd "$tree"

# Steps 1 to 3: the folder.
rm -rf "boards/$new"
cp -r "boards/$old" "boards/$new"
sed -i "s/$old/$new/g" "boards/$new"/*
# Step 4: presets.
python3 - "$old" "$new" <<'END'
import json, sys
old, new = sys.argv[1:]
presets = json.load(open("CMakePresets.json"))
for kind in ("configurePresets", "buildPresets", "testPresets"):
    mine = [json.dumps(each).replace(old, new) for each in presets[kind] if each["name"] == "fw-" + old]
    assert len(mine) == 1, kind
    presets[kind].append(json.loads(mine[0]))
json.dump(presets, open("CMakePresets.json", "w"), indent=1)
END
# Step 5: a row in the table of recipes.
sed -i "0,/^      {\"$old\",/s//      {\"$new\", \&kF405, {kOpenocd}, kStLink, \"PA9, PA10\", \"$old\", true},\n&/" host/boards/flash/recipe.cpp
# Steps 6 and 7.
sed -i "s/foreach(board /&$new /" tests/host/stm32_boards/CMakeLists.txt
sed -i "s/^| \`$old\/\` .*/&\n| \`$new\/\` | Cortex-M4F | mine |/" boards/README.md
tests/gates/boards.sh .

cmake --preset "fw-$new" >/dev/null
cmake --build --preset "fw-$new" --target "loop_$new" "loop_can_$new" "sensor_$new" "foot_$new" "unit_base_$new"
ctest --preset "fw-$new" -R "^(unit.$new.base|budget.$new)" --output-on-failure
