#pragma once
#include <cstddef>
#include <cstdint>

/// FrameBus: encoded frames between the controller, the bus master, and servos and bus sensors.
///
/// A backend promises:
///  - send(data, size): queues the whole frame or refuses all of it (false); never waits for the
///    wire. Frames leave in order. An empty queue accepts frames of up to kMaxFrame bytes.
///  - poll(buffer, capacity, timeout_us): waits until bytes have arrived, or until timeout_us of
///    bus time have passed since the last accepted frame began on the wire (since open if there was
///    none). So one timeout serves every poll of a reply. Returns the bytes stored, at most
///    capacity; 0 means only that the time is over. Bytes keep their order; a frame may come in
///    pieces.
///  - now_us(): bus time in microseconds since open, never decreasing. Exact after a poll; may lag
///    between a send and the next poll. In lockstep it is simulated time: a slow PC causes no
///    timeout.
///  - No call allocates, throws or blocks past its timeout.
namespace verp::hal {

/// Bytes; a Sync Write of 4 bytes to 32 servos has 174.
inline constexpr std::size_t kMaxFrame = 512;

class FrameBus {
 public:
  virtual bool send(const std::uint8_t* data, std::size_t size) = 0;
  virtual std::size_t poll(std::uint8_t* buffer, std::size_t capacity,
                           std::uint32_t timeout_us) = 0;
  virtual std::uint64_t now_us() = 0;

 protected:
  ~FrameBus() = default;
};

}  // namespace verp::hal
