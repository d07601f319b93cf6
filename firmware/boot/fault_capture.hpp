#pragma once
#include <cstdint>

#include "firmware/boot/boot.hpp"
#include "firmware/boot/stack.hpp"

/// Runs on a fresh stack, with the registers at the fault. For families whose hardware saves
/// nothing on the stack.
extern "C" __attribute__((used)) [[noreturn]] void verp_fault_capture(std::uint32_t pc,
                                                                      std::uint32_t lr,
                                                                      std::uint32_t cause,
                                                                      std::uint32_t address,
                                                                      std::uint32_t sp) {
  verp::boot::FaultReport report;
  report.cause = cause;
  report.address = address;
  report.stack_overflow = sp < verp::boot::stack_limit();
  if (!report.stack_overflow) {
    report.lr = lr;
    report.pc = pc;
  }
  verp_fault(report);
}
