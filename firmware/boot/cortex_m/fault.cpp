#include <cstdint>

#include "firmware/boot/boot.hpp"
#include "firmware/boot/stack.hpp"

namespace {
constexpr std::uintptr_t kCfsr = 0xE000ED28;   // ARMv7-M ARM, B3.2.15
constexpr std::uintptr_t kBfar = 0xE000ED38;   // B3.2.18
constexpr std::uintptr_t kMmfar = 0xE000ED34;  // B3.2.17
constexpr std::uint32_t kBfarValid = 1u << 15;
constexpr std::uint32_t kMmfarValid = 1u << 7;
constexpr std::uint32_t kStackLimit = 1u << 20;  // STKOF of ARMv8-M; 0 before

std::uint32_t read_register(std::uintptr_t address) {
  return *reinterpret_cast<const volatile std::uint32_t*>(address);
}
}  // namespace

/// `frame`: r0-r3, r12, lr, pc, xpsr (B1.5.6); unreadable if the stack left RAM.
extern "C" [[noreturn]] void verp_fault_capture(const std::uint32_t* frame) {
  verp::boot::FaultReport report;
  report.cause = read_register(kCfsr);
  if ((report.cause & kBfarValid) != 0) report.address = read_register(kBfar);
  if ((report.cause & kMmfarValid) != 0) report.address = read_register(kMmfar);
  report.stack_overflow = (report.cause & kStackLimit) != 0 ||
                          reinterpret_cast<std::uintptr_t>(frame) < verp::boot::stack_limit();
  if (!report.stack_overflow) {
    report.lr = frame[5];
    report.pc = frame[6];
  }
  verp_fault(report);
}

extern "C" void verp_fault_entry();
/// A board that uses SysTick replaces it.
extern "C" __attribute__((weak, naked)) void verp_systick() {
  __asm__ volatile("b verp_fault_entry");
}

/// All faults enter here. The stack may be broken, so it restarts from the top.
extern "C" __attribute__((naked)) void verp_fault_entry() {
  __asm__ volatile(
      "mrs r0, msp\n"
      "ldr r1, =verp_stack_top\n"
      "mov sp, r1\n"
      "b verp_fault_capture\n"
      ".ltorg\n");
}
