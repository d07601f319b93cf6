#include <cstdint>

#include "firmware/boot/boot.hpp"
#include "firmware/boot/stack.hpp"

/// From power-on to verp_main(): the FPU, the stack pattern, .data, .bss, constructors. Symbols
/// from sections.ld.
extern "C" {
extern std::uint32_t verp_stack_top[];
extern const std::uint32_t verp_data_image[];
extern std::uint32_t verp_data_begin[];
extern std::uint32_t verp_data_end[];
extern std::uint32_t verp_bss_begin[];
extern std::uint32_t verp_bss_end[];
using Constructor = void (*)();
extern const Constructor verp_init_begin[];
extern const Constructor verp_init_end[];

[[noreturn]] void verp_reset();
void verp_fault_entry();
void verp_systick();
}

namespace {

#ifdef __ARM_FP
// Coprocessor Access Control Register (ARMv7-M ARM, B3.2.20): full access to CP10 and CP11. Any
// float instruction before this faults.
void enable_fpu() {
  *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88u) |= 0xFu << 20;
  __asm__ volatile("dsb\n isb" ::: "memory");
}
#else
void enable_fpu() {}
#endif

// Volatile keeps these loops from becoming calls to memcpy and memset, which are fine here on every
// core we know but need not be.
void fill_memory() {
  const volatile std::uint32_t* from = verp_data_image;
  for (volatile std::uint32_t* to = verp_data_begin; to != verp_data_end; ++to) *to = *from++;
  for (volatile std::uint32_t* word = verp_bss_begin; word != verp_bss_end; ++word) *word = 0;
}

union Vector {
  std::uint32_t* stack;
  void (*handler)();
};

}  // namespace

extern "C" void verp_reset() {
  enable_fpu();
  verp::boot::guard_stack();
  verp::boot::paint_stack();
  fill_memory();
  for (const Constructor* constructor = verp_init_begin; constructor != verp_init_end;
       ++constructor) {
    (*constructor)();
  }
  verp_exit(verp_main());
}

// The table of ARMv7-M ARM, B1.5.3. A board that uses interrupts adds its own table behind this
// one, in section .vectors.interrupts.
extern const Vector verp_vectors[16];
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
