#pragma once
#include <cstdint>

/// The interface of firmware/boot and a board image. Boot uses no peripheral.
namespace verp::boot {

/// A fault as the core reports it (ARMv7-M ARM, B1.5 and B3.2.15).
struct FaultReport {
  std::uint32_t pc = 0;  ///< faulting instruction; 0 after a stack overflow, which saves nothing
  std::uint32_t lr = 0;
  std::uint32_t cause = 0;    ///< CFSR
  std::uint32_t address = 0;  ///< BFAR or MMFAR, if valid by the cause
  bool stack_overflow = false;
};

}  // namespace verp::boot

/// The image's main function; the result goes to verp_exit().
extern "C" int verp_main();
/// Called after verp_main(): an emulator exits, a robot resets.
extern "C" [[noreturn]] void verp_exit(int status);
/// The board's fault handler; runs on a fresh stack.
extern "C" [[noreturn]] void verp_fault(const verp::boot::FaultReport& report);
