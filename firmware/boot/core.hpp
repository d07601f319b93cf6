#pragma once

/// Functions that each family implements in firmware/boot/<family>, whose entry sets the stack
/// pointer and calls verp_reset().
namespace verp::boot {

/// Called first: enables float instructions and routes faults to verp_fault(). Code before it may
/// use neither.
void enable_core();

}  // namespace verp::boot

extern "C" [[noreturn]] void verp_reset();
