#pragma once
#include <cstddef>
#include <cstdint>

/// Measures how deep the stack went: startup fills it with a pattern, and what no longer holds the
/// pattern was used.
namespace verp::boot {

/// Lowest address of the stack.
std::uintptr_t stack_limit();

/// Forbids every access to the 32 bytes below the stack, so that an overflow faults there and then.
/// False: this core has no memory protection unit; the stack then ends where RAM does. At start.
bool guard_stack();

/// Fills what lies below the caller's frame with the pattern again, so that the next reading starts
/// here. Returns the address from which depth counts.
std::uintptr_t paint_stack();

/// Deepest use below `from`, in bytes, since it was last painted.
std::size_t stack_used_below(std::uintptr_t from);

}  // namespace verp::boot
