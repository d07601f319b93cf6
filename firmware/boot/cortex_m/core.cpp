#include "firmware/boot/core.hpp"

#include <cstdint>

#include "firmware/boot/boot.hpp"
#include "firmware/boot/stack.hpp"

extern "C" {
extern std::uint32_t verp_stack_top[];
extern std::uint32_t verp_stack_guard[];
void verp_fault_entry();
void verp_systick();
}

namespace {

// ARMv7-M Architecture Reference Manual (ARM), B3.5: memory protection unit.
constexpr std::uintptr_t kMpuType = 0xE000ED90, kMpuCtrl = 0xE000ED94, kMpuRnr = 0xE000ED98,
                         kMpuRbar = 0xE000ED9C, kMpuRasr = 0xE000EDA0;
constexpr std::uint32_t kMpuRegions = 0xFFu << 8;
constexpr std::uint32_t kHighestRegion = 7;               ///< wins where regions overlap
constexpr std::uint32_t kNoAccess32Bytes = 4u << 1 | 1u;  ///< AP 0, 2 << 4 bytes, on
constexpr std::uint32_t kOnForAllElse = 1u << 2 | 1u;     ///< PRIVDEFENA, ENABLE

volatile std::uint32_t& reg(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

union Vector {
  std::uint32_t* stack;
  void (*handler)();
};

}  // namespace

extern const Vector verp_vectors[16];

namespace verp::boot {

void enable_core() {
  // VTOR (ARMv7-M ARM, B3.2.5): a boot loader may have left its own table there.
  reg(0xE000ED08u) = reinterpret_cast<std::uintptr_t>(verp_vectors);
#ifdef __ARM_FP
  // CPACR (ARMv7-M ARM, B3.2.20): full access to CP10 and CP11. Float instructions fault before.
  reg(0xE000ED88u) |= 0xFu << 20;
#endif
  __asm__ volatile("dsb\n isb" ::: "memory");
}

#if __ARM_ARCH >= 8
// ARMv8-M has a stack limit register (MSPLIM); its MPU cannot forbid every access.
bool guard_stack() {
  __asm__ volatile("msr msplim, %0" ::"r"(verp::boot::stack_limit()));
  return true;
}
#else
bool guard_stack() {
  if ((reg(kMpuType) & kMpuRegions) == 0) return false;
  reg(kMpuRnr) = kHighestRegion;
  reg(kMpuRbar) = reinterpret_cast<std::uintptr_t>(verp_stack_guard);
  reg(kMpuRasr) = kNoAccess32Bytes;
  reg(kMpuCtrl) = kOnForAllElse;
  __asm__ volatile("dsb\n isb" ::: "memory");
  return true;
}
#endif

}  // namespace verp::boot

// The table of ARMv7-M ARM, B1.5.3. A board's interrupt table follows in section
// .vectors.interrupts.
__attribute__((section(".vectors"), used)) const Vector verp_vectors[16] = {
    {.stack = verp_stack_top},      // initial stack
    {.handler = verp_reset},        // reset
    {.handler = verp_fault_entry},  // NMI
    {.handler = verp_fault_entry},  // hard fault
    {.handler = verp_fault_entry},  // memory management
    {.handler = verp_fault_entry},  // bus
    {.handler = verp_fault_entry},  // usage
    {.stack = nullptr},             // reserved
    {.stack = nullptr},             // reserved
    {.stack = nullptr},             // reserved
    {.stack = nullptr},             // reserved
    {.handler = verp_fault_entry},  // SVCall
    {.handler = verp_fault_entry},  // debug monitor
    {.stack = nullptr},             // reserved
    {.handler = verp_fault_entry},  // PendSV
    {.handler = verp_systick},      // SysTick
};
