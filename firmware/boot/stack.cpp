#include "firmware/boot/stack.hpp"

extern "C" std::uint32_t verp_stack_limit[];
extern "C" std::uint32_t verp_stack_guard[];

namespace verp::boot {
namespace {
constexpr std::uint32_t kPattern = 0x5AFE57ACu;

// ARMv7-M Architecture Reference Manual, B3.5: memory protection unit.
constexpr std::uintptr_t kMpuType = 0xE000ED90, kMpuCtrl = 0xE000ED94, kMpuRnr = 0xE000ED98,
                         kMpuRbar = 0xE000ED9C, kMpuRasr = 0xE000EDA0;
constexpr std::uint32_t kMpuRegions = 0xFFu << 8;
constexpr std::uint32_t kHighestRegion = 7;  ///< counts above the others where regions overlap
constexpr std::uint32_t kNoAccess32Bytes = 4u << 1 | 1u;  ///< AP 0, 2 << 4 bytes, on
constexpr std::uint32_t kOnForAllElse = 1u << 2 | 1u;     ///< PRIVDEFENA, ENABLE

volatile std::uint32_t& reg(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}
}  // namespace

std::uintptr_t stack_limit() {
  return reinterpret_cast<std::uintptr_t>(verp_stack_limit);
}

bool guard_stack() {
  if ((reg(kMpuType) & kMpuRegions) == 0) return false;
  reg(kMpuRnr) = kHighestRegion;
  reg(kMpuRbar) = reinterpret_cast<std::uintptr_t>(verp_stack_guard);
  reg(kMpuRasr) = kNoAccess32Bytes;
  reg(kMpuCtrl) = kOnForAllElse;
  __asm__ volatile("dsb\n isb" ::: "memory");
  return true;
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
