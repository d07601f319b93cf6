#pragma once
#include <concepts>
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/record/tick_record.hpp"

/// What the control loop needs besides a FrameBus: somebody who gives orders, somebody who keeps
/// the record, and perhaps a clock.
namespace verp::app {

/// What an operator may put into one tick's Inputs.
struct OperatorOrder {
  Command command;  ///< the standing order
  std::uint16_t flags =
      0;  ///< kEmergencyStop, kCommandFresh, kParameterWrite; other bits are ignored
  std::uint16_t parameter_id = 0;    ///< valid with kParameterWrite
  std::uint32_t parameter_bits = 0;  ///< valid with kParameterWrite
  std::uint16_t mailbox = 0;
  std::uint16_t reserved = 0;
  VERP_FIELDS(command, flags, parameter_id, parameter_bits, mailbox, reserved)
};
static_assert(packed_size<OperatorOrder>() == sizeof(OperatorOrder));

/// OperatorLink: order(tick) returns what the operator wants in this tick. The loop asks exactly
/// once a tick, after the bus was read; it never waits. Ticks rise, but may skip (an overrun).
template <class Link>
concept OperatorLink = requires(Link& link, std::uint32_t tick) {
  { link.order(tick) } -> std::same_as<OperatorOrder>;
};

/// What the clock that paces a loop says of the tick that begins.
struct Beat {
  std::uint32_t periods = 0;  ///< since the tick before; 0: no clock, bus time tells
  bool overran = false;       ///< the tick before ended after its deadline
};

/// Recorder: takes each tick after its goals were sent, so that recording never delays them. It
/// never waits for longer than a tick can spare and never allocates on a microcontroller.
template <class Sink>
concept Recorder = requires(Sink& sink, const TickRecord& record, const State& state,
                            const Outputs& outputs) {
  { sink.record(record, state, outputs) } -> std::same_as<void>;
};

}  // namespace verp::app
