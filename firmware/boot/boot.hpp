#pragma once
#include <cstdint>

/// What firmware/boot asks of a board image, and what it gives to it. Boot is the same for every
/// Cortex-M: vectors, memory, FPU, stack measurement, fault capture. It knows no peripheral.
namespace verp::boot {

/// A fault as the core reports it (ARMv7-M Architecture Reference Manual, B1.5 and B3.2.15).
struct FaultReport {
  std::uint32_t pc =
      0;  ///< instruction that faulted; 0 when the stack overflowed, as nothing was saved
  std::uint32_t lr = 0;
  std::uint32_t cause = 0;    ///< CFSR
  std::uint32_t address = 0;  ///< BFAR or MMFAR, if the cause says so
  bool stack_overflow = false;
};

}  // namespace verp::boot

/// The image. Its result goes to verp_exit().
extern "C" int verp_main();
/// The board's end of the line after verp_main(): an emulator leaves, a robot resets.
extern "C" [[noreturn]] void verp_exit(int status);
/// The board's last words after a fault; runs on a fresh stack.
extern "C" [[noreturn]] void verp_fault(const verp::boot::FaultReport& report);
