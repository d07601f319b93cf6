#pragma once
#include <cstdint>

#include "firmware/boot/boot.hpp"
#include "firmware/boot/stack.hpp"

/// Where a family's fault entry goes on, in C++ and on a fresh stack: it hands over the registers
/// of what broke. For families whose hardware saves nothing on the stack.
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
