#pragma once
#include <cstddef>
#include <cstdint>

/// Startup fills the stack with a pattern; whatever differs was used.
namespace verp::boot {

/// Lowest address of the stack.
std::uintptr_t stack_limit();

/// Call at start: forbids the 32 bytes below the stack, so that an overflow faults at once. False:
/// no memory protection unit; the stack then ends with RAM.
bool guard_stack();

/// Refills the stack below the caller's frame; depth counts from the result.
std::uintptr_t paint_stack();

/// Deepest use below `from`, bytes, since it was last painted.
std::size_t stack_used_below(std::uintptr_t from);

}  // namespace verp::boot
