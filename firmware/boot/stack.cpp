#include "firmware/boot/stack.hpp"

extern "C" std::uint32_t verp_stack_limit[];

namespace verp::boot {
namespace {
constexpr std::uint32_t kPattern = 0x5AFE57ACu;
}  // namespace

std::uintptr_t stack_limit() {
  return reinterpret_cast<std::uintptr_t>(verp_stack_limit);
}

__attribute__((noinline)) std::uintptr_t paint_stack() {
  std::uintptr_t sp;
  __asm__ volatile("mov %0, sp" : "=r"(sp));
  // Volatile: the compiler must neither drop these stores nor turn them into a call that needs this
  // very stack.
  for (volatile std::uint32_t* word = verp_stack_limit; reinterpret_cast<std::uintptr_t>(word) < sp;
       ++word) {
    *word = kPattern;
  }
  return sp;
}

std::size_t stack_used_below(std::uintptr_t from) {
  const volatile std::uint32_t* word = verp_stack_limit;
  while (reinterpret_cast<std::uintptr_t>(word) < from && *word == kPattern) ++word;
  return from - reinterpret_cast<std::uintptr_t>(word);
}

}  // namespace verp::boot
