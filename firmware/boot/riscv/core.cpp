#include "firmware/boot/core.hpp"

#include <cstdint>

#include "firmware/boot/boot.hpp"
#include "firmware/boot/fault_capture.hpp"
#include "firmware/boot/stack.hpp"

/// RISC-V in machine mode; "The RISC-V Instruction Set Manual, Volume II: Privileged Architecture":
/// traps (3.1), physical memory protection (3.7).
extern "C" {
extern std::uint32_t verp_stack_guard[];
extern std::uint32_t verp_code_begin[];
extern std::uint32_t verp_code_bytes[];  ///< the address is the value
}

/// The core's entry, at the lowest code address. The C library's errno needs `tp`.
extern "C" __attribute__((naked, section(".vectors"), used)) void verp_entry() {
  __asm__ volatile(
      ".option push\n .option arch, +zicsr\n"
      "la sp, verp_stack_top\n"
      "la tp, verp_thread_begin\n"
      "la t0, verp_fault_entry\n"
      "csrw mtvec, t0\n"
      ".option pop\n"
      "tail verp_reset\n");
}

/// All traps enter here, with the stack at the top because it may be broken. Interrupts are polled,
/// never taken.
extern "C" __attribute__((naked, aligned(4), used)) void verp_fault_entry() {
  __asm__ volatile(
      ".option push\n .option arch, +zicsr\n"
      "csrr a0, mepc\n"
      "mv a1, ra\n"
      "csrr a2, mcause\n"
      "csrr a3, mtval\n"
      "mv a4, sp\n"
      ".option pop\n"
      "la sp, verp_stack_top\n"
      "tail verp_fault_capture\n");
}

namespace verp::boot {
namespace {

// pmpcfg0: four entries, a byte each.
constexpr std::uint32_t kRead = 1, kExecute = 4, kPowerOfTwo = 3u << 3, kLocked = 1u << 7;

/// pmpaddr of a naturally aligned power of two of at least 8 bytes.
constexpr std::uint32_t region(std::uint32_t begin, std::uint32_t bytes) {
  return begin >> 2 | (bytes / 8 - 1);
}
constexpr std::uint32_t kGuardBytes = 32;

}  // namespace

void enable_core() {}

/// A locked entry binds machine mode too. A stack that jumps over its guard faults in the read-only
/// code.
bool guard_stack() {
  const std::uint32_t guard =
      region(reinterpret_cast<std::uintptr_t>(verp_stack_guard), kGuardBytes);
  const std::uint32_t code = region(reinterpret_cast<std::uintptr_t>(verp_code_begin),
                                    reinterpret_cast<std::uintptr_t>(verp_code_bytes));
  const std::uint32_t settings =
      (kLocked | kPowerOfTwo) | (kLocked | kPowerOfTwo | kRead | kExecute) << 8;
  __asm__ volatile(
      ".option push\n .option arch, +zicsr\n"
      "csrw pmpaddr0, %0\n"
      "csrw pmpaddr1, %1\n"
      "csrw pmpcfg0, %2\n"
      ".option pop\n" ::"r"(guard),
      "r"(code), "r"(settings)
      : "memory");
  return true;
}

}  // namespace verp::boot
