#pragma once

/// What each family of cores does in its own way: firmware/boot/<family>. The family's entry sets
/// the stack pointer and calls verp_reset().
namespace verp::boot {

/// First of all: after it float instructions work, and a fault ends in verp_fault(). Code that runs
/// before it may use neither.
void enable_core();

}  // namespace verp::boot

extern "C" [[noreturn]] void verp_reset();
