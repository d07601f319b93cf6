#pragma once
#include <cstdint>

/// Between firmware/boot and a board image. Boot uses no peripheral.
namespace verp::boot {

/// ARMv7-M ARM, B1.5 and B3.2.15.
struct FaultReport {
  std::uint32_t pc = 0;  ///< 0 after a stack overflow, which saves nothing
  std::uint32_t lr = 0;
  std::uint32_t cause = 0;    ///< CFSR
  std::uint32_t address = 0;  ///< BFAR or MMFAR, if valid by the cause
  bool stack_overflow = false;
};

}  // namespace verp::boot

/// The result goes to verp_exit().
extern "C" int verp_main();
/// An emulator exits, a robot resets.
extern "C" [[noreturn]] void verp_exit(int status);
/// Runs on a fresh stack.
extern "C" [[noreturn]] void verp_fault(const verp::boot::FaultReport& report);
