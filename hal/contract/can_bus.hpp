#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/base/can_frame.hpp"

/// CanBus: how the controller reaches drives and sensor nodes with CAN frames.
///
/// Promises of a backend:
///  - send(frame): queues the frame or refuses it (false). Returns without waiting for the wire. A
///    bus that works accepts kCanQueue frames whenever nothing else is queued. Two frames with one
///    identifier leave in the order in which they were accepted; among others, identifiers decide
///    as they do on the wire. Nothing is sent twice, and nothing that waits is thrown away but by
///    bus-off, which drops all of it. What is not sound (is_sound()) is refused, and FD frames
///    where there is no FD.
///  - poll(frame, timeout_us): waits until a frame has arrived or timeout_us of bus time have
///    passed since the last accepted frame began on the wire (since the bus was opened, if there
///    was none). False means only that the time is over. Frames of other nodes come in the order of
///    the wire, each once, whole, and never our own; one that finds no room is counted as an
///    overrun. Error frames are counted, not handed over.
///  - now_us(): bus time in microseconds since the backend was opened, never decreasing. After a
///    poll that brought a frame it is when that frame ended on the wire; it may lag behind between
///    a send and the poll that follows. In lockstep it is simulated time, so a timeout is decided
///    there and a slow PC can't cause one.
///  - After bus-off the backend comes back by itself when the standard allows it (128 times 11
///    recessive bits); until then it refuses frames.
///  - No call allocates, throws or blocks past its timeout.
namespace verp::hal {

/// A tick's worth: goals of 32 drives two in a frame, controlwords, SYNC and a request, twice.
inline constexpr std::size_t kCanQueue = 48;

/// What went wrong since the bus was opened, each modulo 2^32.
struct CanErrors {
  std::uint32_t errors = 0;    ///< error frames seen, ours and others'
  std::uint32_t overruns = 0;  ///< frames that arrived and found no room
  std::uint32_t bus_offs = 0;  ///< how often this node left the bus for too many errors
  std::uint32_t dropped = 0;   ///< frames accepted that a bus-off dropped
};

template <class Bus>
concept CanBus = requires(Bus& bus, const Bus& seen, const CanFrame& out, CanFrame& in,
                          std::uint32_t us) {
  { bus.send(out) } -> std::same_as<bool>;
  { bus.poll(in, us) } -> std::same_as<bool>;
  { bus.now_us() } -> std::same_as<std::uint64_t>;
  { seen.errors() } -> std::same_as<CanErrors>;
};

}  // namespace verp::hal
