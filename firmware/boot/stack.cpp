#include "firmware/boot/stack.hpp"

extern "C" std::uint32_t verp_stack_limit[];

namespace verp::boot {
namespace {
constexpr std::uint32_t kPattern = 0x5AFE57ACu;
}  // namespace

std::uintptr_t stack_limit() {
  return reinterpret_cast<std::uintptr_t>(verp_stack_limit);
}

// Read in each round: the compiler may push registers late.
__attribute__((always_inline)) static inline std::uintptr_t stack_pointer() {
  std::uintptr_t sp;
#ifdef __riscv
  __asm__ volatile("mv %0, sp" : "=r"(sp));
#else
  __asm__ volatile("mov %0, sp" : "=r"(sp));
#endif
  return sp;
}

__attribute__((noinline)) std::uintptr_t paint_stack() {
  // Volatile: the compiler must neither drop the stores nor call a function, which needs this
  // stack.
  volatile std::uint32_t* word = verp_stack_limit;
  while (reinterpret_cast<std::uintptr_t>(word) < stack_pointer()) *word++ = kPattern;
  return stack_pointer();
}

std::size_t stack_used_below(std::uintptr_t from) {
  const volatile std::uint32_t* word = verp_stack_limit;
  while (reinterpret_cast<std::uintptr_t>(word) < from && *word == kPattern) ++word;
  return from - reinterpret_cast<std::uintptr_t>(word);
}

}  // namespace verp::boot
