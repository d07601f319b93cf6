#pragma once
#include <cstddef>

extern "C" void verp_fault_entry();

namespace verp::board {

/// What stands behind the core's 16 vectors. An interrupt nobody asked for is a fault.
inline constexpr unsigned kInterrupts = 98;  ///< of the F746 (RM0385 10.1.2); the F4 have fewer
using Handler = void (*)();
struct InterruptTable {
  Handler handler[kInterrupts];
};
struct Interrupt {
  unsigned number;
  Handler handler;
};

template <std::size_t kCount>
constexpr InterruptTable make_interrupts(const Interrupt (&wanted)[kCount]) {
  InterruptTable table{};
  for (Handler& handler : table.handler) handler = verp_fault_entry;
  for (const Interrupt& each : wanted) table.handler[each.number] = each.handler;
  return table;
}

}  // namespace verp::board
