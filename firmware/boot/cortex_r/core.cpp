#include "firmware/boot/core.hpp"

#include <cstdint>

#include "firmware/boot/boot.hpp"
#include "firmware/boot/fault_capture.hpp"
#include "firmware/boot/stack.hpp"

/// Cortex-R5; ARMv7-A and ARMv7-R Architecture Reference Manual: exceptions (B1.8), system control
/// registers of a PMSA (B6.1), memory protection (B5).
extern "C" {
extern std::uint32_t verp_stack_guard[];
extern std::uint32_t verp_code_begin[];
extern std::uint32_t verp_code_bytes[];  ///< the address is the value
}

/// Exception vectors: eight loads, then eight words, position-independent. The first is the core's
/// entry.
extern "C" __attribute__((naked, section(".vectors"), used)) void verp_entry() {
  __asm__ volatile(
      ".rept 8\n ldr pc, [pc, #24]\n .endr\n"
      ".word verp_start\n"  // reset
      ".word verp_undefined_entry\n"
      ".word verp_undefined_entry\n"  // supervisor call
      ".word verp_prefetch_entry\n"
      ".word verp_data_entry\n"
      ".word verp_undefined_entry\n"  // not used
      ".word verp_undefined_entry\n"  // IRQ: never enabled
      ".word verp_undefined_entry\n"  // FIQ
  );
}

/// System mode, interrupts off, except in fault handlers.
extern "C" __attribute__((naked, used)) void verp_start() {
  __asm__ volatile(
      "cpsid if, #0x1F\n"
      "ldr sp, =verp_stack_top\n"
      "b verp_reset\n"
      ".ltorg\n");
}

/// All faults enter here, in their own mode, with the stack at the top because it may be broken. lr
/// is 8 past the instruction after a data abort, otherwise 4.
extern "C" __attribute__((naked, used)) void verp_undefined_entry() {
  __asm__ volatile(
      "mov r2, #0\n"
      "mov r3, #0\n"
      "sub r0, lr, #4\n"
      "b verp_fault_entry\n");
}
extern "C" __attribute__((naked, used)) void verp_prefetch_entry() {
  __asm__ volatile(
      "mrc p15, 0, r2, c5, c0, 1\n"  // IFSR
      "mrc p15, 0, r3, c6, c0, 2\n"  // IFAR
      "sub r0, lr, #4\n"
      "b verp_fault_entry\n");
}
extern "C" __attribute__((naked, used)) void verp_data_entry() {
  __asm__ volatile(
      "mrc p15, 0, r2, c5, c0, 0\n"  // DFSR
      "mrc p15, 0, r3, c6, c0, 0\n"  // DFAR
      "sub r0, lr, #8\n"
      "b verp_fault_entry\n");
}
extern "C" __attribute__((naked, used)) void verp_fault_entry() {
  __asm__ volatile(
      "ldr sp, =verp_stack_top\n"
      "sub sp, sp, #16\n"
      "stmia sp, {sp, lr}^\n"  // the program's sp and lr
      "nop\n"
      "ldr r1, [sp, #4]\n"
      "b verp_fault_capture\n"  // the program's sp: fifth argument
      ".ltorg\n");
}

namespace verp::boot {
namespace {

/// Copies the vectors to address 0 (tightly coupled memory).
void place_vectors() {
  __asm__ volatile(
      "ldr r0, =verp_entry\n"
      "mov r1, #0\n"
      "1: ldr r2, [r0], #4\n"
      "str r2, [r1], #4\n"
      "cmp r1, #64\n"
      "bne 1b\n"
      "dsb\n isb\n" ::
          : "r0", "r1", "r2", "cc", "memory");
}

/// CPACR (B6.1.15): CP10 and CP11; FPEXC (B6.1.39): on.
void enable_fpu() {
  std::uint32_t access;
  __asm__ volatile("mrc p15, 0, %0, c1, c0, 2" : "=r"(access));
  access |= 0xFu << 20;
  __asm__ volatile("mcr p15, 0, %0, c1, c0, 2\n isb\n vmsr fpexc, %1" ::"r"(access), "r"(1u << 30));
}

constexpr std::uint32_t kNoAccess = 0;
/// DRACR (B6.1.26): privileged read only; normal memory, written back.
constexpr std::uint32_t kReadOnly = 5u << 8 | 1u << 3 | 3u;
constexpr std::uint32_t kGuardBytes = 32;

/// Sets one MPU region (B6.1.86, .27, .28, .26): a power of two of at least 32 bytes.
void set_region(std::uint32_t number, std::uint32_t begin, std::uint32_t bytes,
                std::uint32_t access) {
  const auto size = static_cast<std::uint32_t>(__builtin_ctz(bytes)) - 1;
  __asm__ volatile(
      "mcr p15, 0, %0, c6, c2, 0\n"
      "mcr p15, 0, %1, c6, c1, 0\n"
      "mcr p15, 0, %2, c6, c1, 4\n"
      "mcr p15, 0, %3, c6, c1, 2\n" ::"r"(number),
      "r"(begin), "r"(access), "r"(size << 1 | 1u)
      : "memory");
}

}  // namespace

void enable_core() {
  place_vectors();
  enable_fpu();
}

/// The highest overlapping region wins; the default map covers the rest. A stack that jumps over
/// its guard faults in the read-only code.
bool guard_stack() {
  set_region(0, reinterpret_cast<std::uintptr_t>(verp_code_begin),
             reinterpret_cast<std::uintptr_t>(verp_code_bytes), kReadOnly);
  set_region(1, reinterpret_cast<std::uintptr_t>(verp_stack_guard), kGuardBytes, kNoAccess);
  std::uint32_t control;
  __asm__ volatile("mrc p15, 0, %0, c1, c0, 0" : "=r"(control));
  control |= 1u << 17 | 1u;  // SCTLR: BR, M
  __asm__ volatile("dsb\n mcr p15, 0, %0, c1, c0, 0\n isb" ::"r"(control) : "memory");
  return true;
}

}  // namespace verp::boot
