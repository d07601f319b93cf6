#!/usr/bin/env bash
# stack.sh ROOT: host/boards/board/stack_depth bounds virtual calls by the worst overrider and refuses calls that it can't follow.
set -uo pipefail
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
failed=0

cat >"$folder/common.hpp" <<'CODE'
struct Bus {
  virtual int send(int) = 0;
  virtual int poll(int) = 0;
};
extern Bus* volatile bus;
template <int kBytes>
[[gnu::noinline]] int use(int value) {
  volatile char room[kBytes];
  room[value] = 1;
  return room[0];
}
struct Chip final : Bus {
  int send(int value) override { return use<96>(value); }
  int poll(int value) override { return use<400>(value); }
};
struct Wrapper final : Bus {
  explicit Wrapper(Bus& of) : inner(of) {}
  int send(int value) override { return inner.send(value) + use<8>(value); }
  int poll(int value) override { return inner.poll(value) + 1; }
  Bus& inner;
};
CODE

# expect CODE ANSWER: what stack_depth says of verp_main in CODE matches ANSWER.
expect() {
  { echo '#include "common.hpp"' && echo "$1"; } >"$folder/image.cpp"
  arm-none-eabi-g++ -std=c++20 -Os -mcpu=cortex-m4 -mthumb -fno-exceptions -fno-rtti -nostdlib -Wl,-e,verp_main \
    "$folder/image.cpp" -o "$folder/image.elf" || exit 3
  answer=$("$root/host/boards/board/stack_depth" "$folder/image.elf" verp_main 2>&1)
  [[ $answer =~ $2 ]] || { echo "expected $2, got: $answer" && failed=1; }
}

root=$(cd "$1" && pwd)
objects='Chip chip; Wrapper wrapper(chip); Bus* volatile bus = &wrapper;'
expect "$objects extern \"C\" int verp_main() { return bus->poll(1); }" '^4[0-9][0-9] .*Wrapper::poll .*Chip::poll .*use<400> '
expect "$objects extern \"C\" int verp_main() { return bus->send(1); }" '^1[0-9][0-9] .*Chip::send .*use<96> '
expect "$objects volatile int way; extern \"C\" int verp_main() { return way ? bus->send(1) : bus->poll(1); }" '^4[0-9][0-9] .*use<400> '
expect 'int one(int value) { return value; } int (*volatile chosen)(int) = one;
  extern "C" int verp_main() { return chosen(1); }' 'calls through a register$'
expect "$objects struct Told { int before; int (*call)(int); }; int one(int value) { return use<4>(value); }
  Told told{1, one}; Told* volatile chosen = &told;
  extern \"C\" int verp_main() { return bus->poll(1) + chosen->call(1); }" '(calls through a register|outside a vtable)$'
expect '[[gnu::noinline]] int deeper(int value) { return value < 1 ? 0 : 1 + use<4>(deeper(value - 1) + deeper(value - 2)); }
  extern "C" int verp_main() { return deeper(3); }' 'is recursive$'
exit "$failed"
