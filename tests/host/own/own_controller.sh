#!/usr/bin/env bash
# own_controller.sh VERP [BOARD]: a new controller's project builds, walks, records and replays, and its mistakes are
# reported. With a board, it walks there in QEMU with the same digest, and flash takes its image.
set -euo pipefail
verp=$1 board=${2:-}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
say() { echo "own_controller: $*" && exit 1; }
digest() { sed -nE 's/^ *"digest": "(0x[0-9a-f]+)".*/\1/p' "$1"; }

mkdir "a place"
"$verp" new controller my_controller --in "a place" >said || say "cannot lay it out"
own="a place/my_controller"
"$verp" walk --controller "$own" --physics-step 2 --for 3 --json --record a.mcap >own.json || say "does not walk: $(cat own.json)"
[[ $(digest own.json) == 0x* ]] || say "no digest"
if [[ $board ]]; then
  "$verp" walk --controller "$own" --physics-step 2 --for 3 --json --on "$board" >board.json 2>said || say "$board does not walk: $(cat said board.json)"
  [[ $(digest board.json) == $(digest own.json) ]] || say "$board has digest $(digest board.json), this PC $(digest own.json)"
  "$verp" flash --controller "$own" --board "$board" --dry-run >said || say "cannot flash it: $(cat said)"
  grep -q "my_controller/build/fw-$board/images/loop_$board.elf" said || say "flashes something else: $(cat said)"
  exit
fi
"$verp" walk --physics-step 2 --for 3 --json >core.json
[[ $(digest core.json) != $(digest own.json) ]] || say "the digest knows nothing of the wave"
"$verp" trace export a.mcap >a.csv
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "rad.r_shoulder_pitch") c = i; next } $c < least { least = $c }
  END { exit !(least < -1) }' a.csv || say "the arm is not up"
"$verp" replay --controller "$own" a.mcap >said || say "does not replay: $(cat said)"
"$verp" replay a.mcap 2>said && say "the core replays what it did not decide"
grep -q -- "--controller $scratch/a place/my_controller" said || say "replay does not say whose it is: $(cat said)"
ctest --test-dir "$own/build/pc" >said || say "its test fails: $(cat said)"

write() { # the line that replaces the wave's
  sed "s|^  waved_rad += .*|  $1|" good.cpp >"$own/controller.cpp"
  ! cmp -s good.cpp "$own/controller.cpp" || say "controller.cpp has no line to put '$1' in"
}
# Exit status 1 and one line with the file or the joint.
wrong() { # what is wrong, and the expected message
  local status=0
  WRONG=$1 "$verp" walk --controller "$own" --physics-step 2 --for 3 --json >wrong.json 2>said || status=$?
  [[ $status == 1 && $(wc -l <said) == 1 ]] && grep -q "$2" said || say "'$1' gives status $status and says '$(cat said)', not '$2'"
}
cp "$own/controller.cpp" good.cpp
write 'waved_rad += nonsense;'
wrong nonsense "my_controller/controller.cpp:[0-9]*:[0-9]*: error: .nonsense. was not declared"
write 'const std::string_view wrong = std::getenv("WRONG"); volatile float none = 0; if (wrong == "memory") *reinterpret_cast<volatile int*>(8) = 0; out.goal_count[3] = wrong == "number" ? verp::app::goal_of(params.joint[3], none / none) : 1 << 20;'
sed -i '1i #include <cstdlib>\n#include <string_view>' "$own/controller.cpp"
wrong memory 'the controller crashed at tick 1[0-9][0-9]: memory'
wrong number 'goal for l_shoulder_pitch is not a number'
wrong counts 'goal for l_shoulder_pitch is 1048576 counts'
