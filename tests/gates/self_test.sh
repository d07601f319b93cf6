#!/usr/bin/env bash
# self_test.sh GATE ROOT [COMPILER NM OBJDUMP]: plants violations one at a time and checks that the gate names each.
set -euo pipefail

gate=$1 root=$2 here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0 planted=0

expect() { # what reason command...: the command must fail and say the reason (empty: pass)
  local what=$1 reason=$2 output status=0
  shift 2
  planted=$((planted + 1))
  output=$("$@" 2>&1) || status=$?
  if [[ -z $reason ]]; then
    ((status == 0)) && return
    echo "a false alarm: $what: $output"
  else
    ((status != 0)) && [[ $output == *"$reason"* ]] && return
    echo "not caught: $what (expected: $reason; got: ${output:-nothing})"
  fi
  failed=1
}

layers_case() { # what reason path text
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree/$(dirname "$3")"
  printf '%s\n' "$4" >"$scratch/tree/$3"
  expect "$1" "$2" "$here/layers.sh" "$scratch/tree" "${3%%/*}"
}

test_layers() {
  layers_case 'a clean header' '' common/gait/a.hpp $'#pragma once\n#include <cstdint>\n#include "common/math/a.hpp"'
  layers_case 'words in comments' '' common/gait/a.hpp $'// a new double #if\n/* virtual\n malloc */ int a;'
  layers_case 'the host includes all' '' host/twin/sim/a.cpp $'#include <ode/ode.h>\n#include "firmware/app/a.hpp"'
  layers_case 'upward include' 'common/gait must not include common/control' common/gait/a.hpp '#include "common/control/step.hpp"'
  layers_case 'sideways include' 'must not include common/balance' common/gait/a.hpp '#include "common/balance/a.hpp"'
  layers_case 'core includes host' 'must not include host/' common/io/a.hpp '#include "host/twin/sim/a.hpp"'
  layers_case 'core includes libm' 'must not include <cmath>' common/math/a.cpp '  # include <cmath>'
  layers_case 'Eigen past its door' 'must not include <Eigen/Core>' common/gait/a.hpp '#include <Eigen/Core>'
  layers_case 'ODE on the robot' 'must not include <ode/ode.h>' firmware/app/a.hpp '#include <ode/ode.h>'
  layers_case 'host uses a chip' 'must not include hal/chip' host/boards/board/a.cpp '#include "hal/chip/x/a.hpp"'
  layers_case 'one chip family uses another' 'must not include hal/chip' hal/chip/x/a.hpp '#include "hal/chip/y/a.hpp"'
  layers_case 'a brain that looks at the twin' 'must not include host/twin/sim' host/apps/demos/brain/a.cpp '#include "host/twin/sim/truth.hpp"'
  layers_case 'a brain that looks at its referee' 'must not include host/apps/demos' host/apps/demos/brain/a.cpp '#include "host/apps/demos/run.hpp"'
  layers_case 'a computer that looks at the run' 'must not include host/run/session' host/apps/demos/computer.cpp '#include "host/run/session/session.hpp"'
  layers_case 'relative include' 'by its path' common/gait/a.cpp '#include "a.hpp"'
  layers_case 'conditional compilation' 'no conditional compilation' common/io/a.hpp '#ifdef __arm__'
  layers_case 'a heap' 'must not use new' common/io/a.cpp 'int* f() { return new int; }'
  layers_case 'a double' 'must not use double' common/io/a.cpp 'float f(float x) { return float(double(x)); }'
  layers_case 'libm' 'must not use std::sin' common/io/a.cpp 'float f(float x) { return std::sin(x); }'
  layers_case 'a folder nobody planned' 'no rule for this folder' common/magic/a.cpp 'int a();'
}

golden_case() { # what reason version digest table: the last commit has versions 4 and 5
  local tree=$scratch/golden
  rm -rf "$tree"
  mkdir -p "$tree/tests/golden" "$tree/common/model"
  git -C "$tree" init -q
  printf '4 aa\n5 bb\n' >"$tree/tests/golden/core_versions.txt"
  git -C "$tree" add . && git -C "$tree" -c user.name=a -c user.email=a@b commit -qm a
  printf 'inline constexpr std::uint32_t kCoreVersion = %s;  ///<\n' "$3" >"$tree/common/model/image.hpp"
  printf '# digests\nall 100 %s\n' "$4" >"$tree/tests/golden/long_trace.txt"
  printf "$5" >"$tree/tests/golden/core_versions.txt"
  expect "$1" "$2" "$here/golden.sh" "$tree"
}

test_golden() {
  golden_case 'as it was' '' 5 bb '4 aa\n5 bb\n'
  golden_case 'a new version with its digest' '' 6 cc '4 aa\n5 bb\n6 cc\n'
  golden_case 'a changed digest, the version unchanged' 'raise kCoreVersion' 5 cc '4 aa\n5 bb\n'
  golden_case 'the same, the table edited too' 'Raise kCoreVersion' 5 cc '4 aa\n5 cc\n'
  golden_case 'a new version, not in the table' 'ends with version 5' 6 bb '4 aa\n5 bb\n'
  golden_case 'a new version of the same digest' 'a digest of its own' 6 bb '4 aa\n5 bb\n6 bb\n'
  golden_case 'a version that goes back' 'versions rise' 3 cc '4 aa\n5 bb\n3 cc\n'
}

seeds_case() { # what reason path text [table]
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree/tests/scenario" "$scratch/tree/$(dirname "$3")"
  cp "$root/tests/scenario/seeds.txt" "$scratch/tree/tests/scenario/"
  [[ -z ${5:-} ]] || printf "$5" >"$scratch/tree/tests/scenario/seeds.txt"
  printf '%s\n' "$4" >"$scratch/tree/$3"
  expect "$1" "$2" "$here/seeds.sh" "$scratch/tree"
}

test_seeds() {
  seeds_case 'a gate seed' '' tests/scenario/a_test.cpp 'walk("--seed 7");'
  seeds_case 'a gate on a tuning seed' 'seed 1007 is no gate seed' tests/scenario/a_test.cpp 'walk("--seed 7 --seed=1007");'
  seeds_case 'the right sets' '' common/robots/a/README.md 'Tuned on tuning seeds 1001-1020, shown on report seeds 2001-2050 and gate seeds 1-10.'
  seeds_case 'tuned on what the gate sees' 'seed 1-20 is no tuning seed' common/robots/a/a.sdf '<!-- tuning seeds 1-20 -->'
  seeds_case 'reported from tuning' 'is no report seed' host/README.md 'report seeds 1990-2010'
  seeds_case 'sets that overlap' 'in common' a.md '' 'gate 1 100\ntuning 100 2000\nreport 2001 9999\n'
}

files_case() { # what reason path text
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree/$(dirname "$3")"
  printf '%s\n' "$4" >"$scratch/tree/$3"
  expect "$1" "$2" "$here/files.sh" "$scratch/tree"
}

test_files() {
  files_case 'a file through the helper' '' host/a.cpp 'files::replace(file, bytes);'
  files_case 'a file in place' 'past host/os/files' host/a.cpp 'std::ofstream out(file);'
  files_case 'a file of C' 'past host/os/files' host/a.cpp 'FILE* f = std::fopen(file, "wb");'
  files_case 'a name without a sync' 'past host/os/files' host/a.cpp 'fs::rename(part, file);'
  files_case 'the helper itself' '' host/os/files/whole.cpp '::rename(from, to);'
}

symbols_case() { # what reason flags text
  local flags=()
  read -ra flags <<<"$3"
  printf '%s\n' "$4" >"$scratch/a.cpp"
  rm -f "$scratch/a.a"
  "$compiler" -std=c++20 -O2 -ffreestanding -ffp-contract=off -fno-math-errno "${flags[@]}" -c "$scratch/a.cpp" -o "$scratch/a.o"
  ar rc "$scratch/a.a" "$scratch/a.o"
  expect "$1" "$2" "$here/symbols.sh" "$scratch/a.a" "$nm" "$objdump"
}

test_symbols() {
  symbols_case 'clean code' '' '' 'extern "C" void* memcpy(void*, const void*, unsigned long); float f(float a, float b) { return a * b + 1; }'
  symbols_case 'a constant table' '' '-fPIC' 'extern const char* const t[]; const char* const t[] = {"a", "b"};'
  symbols_case 'a call of libm' 'must not need' '' 'extern "C" float sinf(float); float f(float x) { return sinf(x); }'
  symbols_case 'a heap' 'must not need' '' 'int* f() { return new int; }'
  symbols_case 'soft floats where there is an FPU' 'must not need' '' 'extern "C" float __addsf3(float, float); float f(float a) { return __addsf3(a, a); }'
  symbols_case 'a counter' 'a run can change' '' 'int f() { static int n; return ++n; }'
  symbols_case 'initialised data' 'a run can change' '' 'int n = 3;'
  symbols_case 'a constructor before main' 'a run can change' '' 'extern int g(); extern const int n; const int n = g();'
  symbols_case 'fused multiply-add' 'fused or double' '-mfma -ffp-contract=fast' 'float f(float a, float b, float c) { return a * b + c; }'
  symbols_case 'double arithmetic' 'fused or double' '' 'double f(double a) { return a * 3.0; }'
  disassembly_case 'Helium with integers' '' '   4:  vadd.i32  q0, q0, q1'
  disassembly_case 'one float' '' '   4:  vadd.f32  s0, s0, s1'
  disassembly_case 'Helium with floats' 'flush subnormals' '   4:  vadd.f32  q0, q0, q1'
  disassembly_case 'Helium converting' 'flush subnormals' '   4:  vcvt.f32.s32  q0, q1'
  symbols_case 'a general product' 'general products' '' 'void gebp() {}'
}

# A stub disassembler prints one line of another core.
disassembly_case() { # what reason line
  printf '#!/bin/sh\n[ "$1" != -d ] || echo "%s"\n' "$3" >"$scratch/objdump"
  chmod +x "$scratch/objdump"
  objdump=$scratch/objdump symbols_case "$1" "$2" '' 'int f() { return 1; }'
}

test_format() {
  git init -q "$scratch"
  cp "$root/.clang-format" "$scratch/"
  printf 'int a;\n' >"$scratch/a.cpp"
  git -C "$scratch" add a.cpp
  expect 'formatted code' '' "$here/format.sh" "$scratch"
  printf 'int   a ;\n' >"$scratch/a.cpp"
  expect 'unformatted code' 'clang-format' "$here/format.sh" "$scratch"
}

# Adds a board step by step; the gate names the next one.
test_boards() {
  local tree=$scratch/tree old=nucleo_f446re new=my_board gate=("$here/boards.sh" "$scratch/tree")
  mkdir -p "$tree/host/boards/flash" "$tree/tests/host/stm32_boards"
  cp -r "$root/boards" "$root/CMakePresets.json" "$tree/"
  cp "$root/host/boards/flash/recipe.cpp" "$tree/host/boards/flash/"
  cp "$root/tests/host/stm32_boards/CMakeLists.txt" "$tree/tests/host/stm32_boards/"
  expect 'the boards there are' '' "${gate[@]}"
  cp -r "$tree/boards/$old" "$tree/boards/$new"
  expect 'another name in board.hpp' "kName is not \"$new\"" "${gate[@]}"
  sed -i "s/$old/$new/g" "$tree/boards/$new"/*
  sed -i '/kBuzzer/d' "$tree/boards/$new/board.hpp"
  expect 'a word of board.hpp' 'no kBuzzer' "${gate[@]}"
  cp "$tree/boards/$old/board.hpp" "$tree/boards/$new/" && sed -i "s/$old/$new/" "$tree/boards/$new/board.hpp"
  expect 'no presets' "fw-$new is not there three times" "${gate[@]}"
  sed -i "s/^.*\"name\": \"fw-$old\".*/&\n&/" "$tree/CMakePresets.json"
  awk -v old="fw-$old" -v new="fw-$new" '{ if (index($0, "\"name\": \"" old "\"") && ++n % 2) gsub(old, new); print }' \
    "$tree/CMakePresets.json" >"$tree/p" && mv "$tree/p" "$tree/CMakePresets.json"
  expect 'no recipe' "no row for $new" "${gate[@]}"
  echo "// {\"$new\"}" >>"$tree/host/boards/flash/recipe.cpp"
  expect 'not on a model of its chip' "$new is not in its list" "${gate[@]}"
  sed -i "s/foreach(board /&$new /" "$tree/tests/host/stm32_boards/CMakeLists.txt"
  expect 'not in the table' "boards/README.md: no row for $new" "${gate[@]}"
  sed -i "s/^| \`$old\/\` .*/&\n| \`$new\/\` | Cortex-M4F | mine |/" "$tree/boards/README.md"
  expect 'every step done' '' "${gate[@]}"
}

# A project without a build: what tests/run would do, and the test sources.
merge_case() { # what reason [file sed-expression]
  local tree=$scratch/tree
  [[ -e $tree ]] || { mkdir -p "$tree" && tar -cf - tests boards CMakePresets.json host/boards/board/cost_promise.hpp | tar -C "$tree" -xf -; }
  [[ -z ${3:-} ]] || { cp "$3" "$scratch/kept" && sed -i -E "$4" "$tree/$3"; }
  expect "$1" "$2" "$here/merge.sh" "$tree"
  [[ -z ${3:-} ]] || cp "$scratch/kept" "$tree/$3"
}

test_merge() {
  cd "$root"
  merge_case 'as it is' ''
  merge_case 'the board of the cost promises to --full' 'leaves out mps2_an386, the board of the cost' tests/run "s/^boards_of_full='/&mps2_an386 /"
  merge_case 'another board to --full' 'leaves out the board opencr' tests/run "s/^boards_of_full='/&opencr /"
  merge_case 'promises of another board' 'leaves out mps2_an385, the board of the cost' host/boards/board/cost_promise.hpp 's/mps2_an386/mps2_an385/'
  merge_case 'a board that nobody runs' 'not even --full runs the board mps2_an385' tests/run 's/\[\[ ! \$full && " \$boards/[[ " $boards/'
  merge_case 'a folder of host without sanitizers' 'leave out host.model' tests/run 's/\|model\|/|/'
  merge_case 'the core without sanitizers' 'leave out replay' tests/run 's/\|replay\|/|/'
  merge_case 'a folder that no stage runs' 'runs host.sim nowhere' tests/run "s/^only_sanitized='/&host\\\\.sim|/; s/^sanitized=.*/sanitized='(unit|host\\\\.(action|bus|can))\\\\.'/"
  merge_case 'a longer run' 'cold_budget_s is 3000, at most 2700' tests/run 's/cold_budget_s=2700/cold_budget_s=3000/'
  merge_case 'a run of any length' 'warm_budget_s is missing' tests/run 's/warm_budget_s=1500/warm_s=1500/'
  merge_case 'sanitizers, not even with --full' '--full has no sanitizers' tests/run 's/preset host-asan-ubsan 900/preset host-debug 900/'
  merge_case 'no fuzzers, not even with --full' '--full has no fuzzers' tests/run 's/preset host-fuzz 900/preset host-debug 900/'
  merge_case 'bits of an instruction set to --full' 'leaves out trace.qemu_rv32' tests/full.md 's/^. `unit.zcu102_r5`/| `trace.qemu_rv32`/'
  merge_case 'everything of a folder to --full' 'leaves out scenario.Generic21' tests/full.md 's/^. `gate.new_board`/| `scenario.*`/'
  merge_case 'a test that is gone' "no test 'gate.old_board'" tests/full.md 's/`gate.new_board`/`gate.old_board`/'
  merge_case 'a board that is gone' "no test 'unit.mps2_an999'" tests/full.md 's/`unit.mps2_an386`/`unit.mps2_an999`/'
  merge_case 'nothing kept' "no test 'host.model.None.Such'" tests/full.md 's/`gate.boards`/`host.model.None.Such`/'
  merge_case '--full that leaves out' '--full leaves tests out' tests/run 's/\[\[ ! \$full && ! \$filter/[[ ! $filter/'
}

tests_case() { # what reason path text
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree/tests/a" "$scratch/tree/boards"
  echo 'hang_s=900 give_up_s=5200' >"$scratch/tree/tests/run"
  printf '%s\n' "$4" >"$scratch/tree/$3"
  expect "$1" "$2" "$here/tests.sh" "$scratch/tree"
}

test_tests() {
  tests_case 'a test' '' tests/a/a_test.cpp 'TEST(A, B) { EXPECT_EQ(outcome.status, failure.empty() ? 0 : 1); }'
  tests_case 'a test that skips itself' 'tests/a/a_test.cpp:1: a test that skips' tests/a/a_test.cpp 'TEST(A, B) { if (none) GTEST_SKIP(); }'
  tests_case 'a test that is switched off' 'skips itself' tests/a/a_test.cpp 'TEST(A, DISABLED_B) {}'
  tests_case 'content with a fall' 'a status is 0 or 1' tests/a/a_test.cpp '  ASSERT_TRUE(outcome.status == 0 || outcome.status == 1);'
  tests_case 'content with any' 'a status is 0 or 1' tests/a/a_test.cpp '  EXPECT_TRUE(walk.status <= 1);'
  tests_case 'time for what hangs' '' tests/a/CMakeLists.txt 'set_tests_properties(a PROPERTIES LABELS unit TIMEOUT 1800)'
  tests_case 'a limit for an idle PC' 'tests/a/CMakeLists.txt:1: its limit' tests/a/CMakeLists.txt 'set_tests_properties(a PROPERTIES TIMEOUT 300)'
}

findings_case() { # what reason sed-expression-for-the-table
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree/tests/unit/a" "$scratch/tree/tests/host/b" "$scratch/tree/boards/c"
  printf 'TEST(Suite, Name) {}\n' >"$scratch/tree/tests/unit/a/a_test.cpp"
  printf 'TEST_P(Long,\n       OnTwoLines) {}\n' >"$scratch/tree/tests/host/b/b_test.cpp"
  printf 'add_test(NAME gate.a COMMAND a)\n' >"$scratch/tree/tests/CMakeLists.txt"
  printf 'add_test(NAME bench.${VERP_BOARD} COMMAND a)\n' >"$scratch/tree/boards/c/a.cmake"
  for ((i = 1; i <= 23; ++i)); do
    echo "| $i | what \`verp walk\` must | \`unit.a.Suite.Name\` \`host.b.Long.OnTwoLines\` \`gate.a\` \`bench.mps2\`; by eye |"
  done | sed -E "$3" >"$scratch/tree/tests/findings.md"
  expect "$1" "$2" "$here/findings.sh" "$scratch/tree"
}

test_findings() {
  findings_case 'all there' '' ''
  findings_case 'a number without a row' 'row 7 is missing' '/^\| 7 /d'
  findings_case 'the last number without one' 'row 23 is missing' '/^\| 23 /d'
  findings_case 'a test of another name' "findings.md:3: no test 'unit.a.Suite.Names'" '3s/Suite.Name/Suite.Names/'
  findings_case 'a test of another folder' "no test 'host.c.Long.OnTwoLines'" 's/host.b/host.c/'
  findings_case 'a gate that is gone' "no test 'gate.b'" 's/gate.a/gate.b/'
  findings_case 'a test of no board' "no test 'cost.mps2'" 's/bench.mps2/cost.mps2/'
}

links_case() { # what reason text
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree/host/guide" "$scratch/tree/a"
  printf '# One: two\n\n## A `b` heading\n' >"$scratch/tree/a/b.md"
  printf '"commands.md"\n' >"$scratch/tree/host/guide/build_manual.py"
  printf '%s\n' "$3" >"$scratch/tree/host/guide/a.md"
  expect "$1" "$2" "$here/links.sh" "$scratch/tree"
}

test_links() {
  links_case 'a page, a folder, its headings, the web' '' '[x](../../a/b.md) [x](../../a) [x](../../a/b.md#one-two) [x](../../a/b.md#a-b-heading) [x](https://a.b/c)'
  links_case 'a generated page' '' '[x](reference/commands.md#verp-walk)'
  links_case 'in code' '' '`[x](y)` and [x](../../a)'
  links_case 'a page that is gone' 'host/guide/a.md:1: no ../../a/c.md' '[x](../../a) [x](../../a/c.md)'
  links_case 'a picture that is gone' 'no b.png' '![x](b.png)'
  links_case 'a heading that is gone' 'no heading for ../../a/b.md#three' '[x](../../a/b.md#three)'
  links_case 'a page that nobody writes' 'no page reference/none.md' '[x](reference/none.md)'
}

compiler=${3:-g++} nm=${4:-nm} objdump=${5:-objdump}
case $gate in
layers) test_layers ;;
symbols) test_symbols ;;
format) test_format ;;
golden) test_golden ;;
boards) test_boards ;;
merge) test_merge ;;
tests) test_tests ;;
findings) test_findings ;;
links) test_links ;;
seeds) test_seeds ;;
files) test_files ;;
*) echo "no gate '$gate'" && exit 2 ;;
esac
echo "$gate gate: $planted cases"
exit "$failed"
