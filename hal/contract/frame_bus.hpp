#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// FrameBus: how the controller, always the bus master, reaches servos and bus sensors with encoded bytes.
///
/// Promises of a backend:
///  - send(data, size): queues the whole frame or refuses it (false) without sending any of it. Returns without
///    waiting for the wire. A later send never overtakes an earlier one.
///  - poll(buffer, capacity, deadline_us): waits until bytes have arrived or bus time reaches deadline_us, and
///    returns how many bytes it stored, at most capacity; 0 means only that the deadline passed. Bytes keep
///    their order; a backend may hand over a frame in several pieces.
///  - now_us(): bus time in microseconds since the backend was opened, never decreasing. In lockstep it is
///    simulated time, so a timeout is decided there and a slow PC can't cause one.
///  - No call allocates, throws or blocks past its deadline.
namespace verp::hal {

template <class Bus>
concept FrameBus = requires(Bus& bus, const std::uint8_t* data, std::uint8_t* buffer,
                            std::size_t size, std::uint64_t deadline_us) {
  { bus.send(data, size) } -> std::same_as<bool>;
  { bus.poll(buffer, size, deadline_us) } -> std::same_as<std::size_t>;
  { bus.now_us() } -> std::same_as<std::uint64_t>;
};

}  // namespace verp::hal
