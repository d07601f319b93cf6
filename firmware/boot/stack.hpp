#pragma once
#include <cstddef>
#include <cstdint>

/// Measures stack depth: startup fills the stack with a pattern; whatever differs was used.
namespace verp::boot {

/// Lowest address of the stack.
std::uintptr_t stack_limit();

/// Call at start. Forbids access to the 32 bytes below the stack, so that an overflow faults at
/// once. False: no memory protection unit; the stack then ends with RAM.
bool guard_stack();

/// Refills the stack below the caller's frame and returns the address from which depth counts.
std::uintptr_t paint_stack();

/// Deepest use below `from`, in bytes, since it was last painted.
std::size_t stack_used_below(std::uintptr_t from);

}  // namespace verp::boot
