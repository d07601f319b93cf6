#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/can_frame.hpp"

/// CanBus: CAN frames to and from drives and sensor nodes.
///
/// A backend promises:
///  - send(frame): queues the frame or refuses it (false); never waits for the wire. A working,
///    empty bus accepts kCanQueue frames. Frames with one identifier leave in order, others by
///    priority, none twice. Only bus-off drops queued frames, and then all. Refused: unsound frames
///    (is_sound()), and FD frames without FD.
///  - poll(frame, timeout_us): waits for a frame, or until timeout_us of bus time have passed since
///    the last accepted frame began on the wire (since open if none did): only then it returns
///    false. Other nodes' frames arrive once, whole and in wire order; our own never do. A frame
///    without room counts as an overrun. Error frames are only counted.
///  - now_us(): bus time in microseconds since open, never decreasing. After a poll that returned a
///    frame, the time of its end on the wire; between a send and the next poll it may lag. In
///    lockstep it is simulated time: a slow PC causes no timeout.
///  - After bus-off the backend rejoins when the standard allows it (128 times 11 recessive bits);
///    until then it refuses frames.
///  - No call allocates, throws or blocks past its timeout.
namespace verp::hal {

/// One tick of 32 drives, two goals in a frame, controlwords, SYNC and a request, twice.
inline constexpr std::size_t kCanQueue = 48;

/// Counts since open, modulo 2^32.
struct CanErrors {
  std::uint32_t errors = 0;    ///< error frames seen, ours and others'
  std::uint32_t overruns = 0;  ///< received frames lost for lack of room
  std::uint32_t bus_offs = 0;  ///< times that this node entered bus-off
  std::uint32_t dropped = 0;   ///< accepted frames that bus-off dropped
};

class CanBus {
 public:
  virtual bool send(const CanFrame& frame) = 0;
  virtual bool poll(CanFrame& frame, std::uint32_t timeout_us) = 0;
  virtual std::uint64_t now_us() = 0;
  virtual CanErrors errors() const = 0;

 protected:
  ~CanBus() = default;
};

}  // namespace verp::hal
