#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// FrameBus: how the controller, always the bus master, reaches servos and bus sensors with encoded
/// bytes.
///
/// Promises of a backend:
///  - send(data, size): queues the whole frame or refuses it (false) without sending any of it.
///  Returns without
///    waiting for the wire. A later send never overtakes an earlier one. Frames of up to kMaxFrame
///    bytes are accepted whenever nothing else is queued.
///  - poll(buffer, capacity, timeout_us): waits until bytes have arrived or timeout_us of bus time
///  have passed
///    since the last accepted frame began on the wire (since the bus was opened, if there was
///    none); returns how many bytes it stored, at most capacity. 0 means only that the timeout
///    passed. Bytes keep their order; a backend may hand over a frame in several pieces. The
///    timeout counts from the send, so that a master that collects a reply in several polls gives
///    each of them the same number, and a remote backend needs no question of its own to learn when
///    the frame left.
///  - now_us(): bus time in microseconds since the backend was opened, never decreasing. Exact
///  after a poll; may
///    lag behind between a send and the poll that follows. In lockstep it is simulated time, so a
///    timeout is decided there and a slow PC can't cause one.
///  - No call allocates, throws or blocks past its timeout.
namespace verp::hal {

inline constexpr std::size_t kMaxFrame =
    512;  ///< bytes; a Sync Write of 4 bytes to 32 servos takes 174

template <class Bus>
concept FrameBus = requires(Bus& bus, const std::uint8_t* data, std::uint8_t* buffer,
                            std::size_t size, std::uint32_t timeout_us) {
  { bus.send(data, size) } -> std::same_as<bool>;
  { bus.poll(buffer, size, timeout_us) } -> std::same_as<std::size_t>;
  { bus.now_us() } -> std::same_as<std::uint64_t>;
};

}  // namespace verp::hal
