#pragma once
#include <cstddef>

extern "C" void verp_fault_entry();

namespace verp::board {

/// The vectors behind the core's 16. An unused interrupt is a fault.
inline constexpr unsigned kInterrupts = 98;  ///< F746 (RM0385 10.1.2); F4 chips have fewer
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
