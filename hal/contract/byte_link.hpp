#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// ByteLink: a full-duplex stream of bytes to an operator, another program or a serial device. It
/// knows no frames; whoever reads it finds them by their own marks.
///
/// Promises of a backend (time is the time of the wall, or of the fake's script):
///  - write(data, size, timeout_us): queues bytes from the front of data until all are queued or
///    timeout_us has passed; returns how many. With timeout 0 it takes what fits now and never
///    waits. What was queued leaves in order, without a further call.
///  - read(buffer, capacity, timeout_us): waits until at least one byte is there or timeout_us has
///    passed; stores what is there, at most capacity, in order; returns how many. The rest stays
///    for later reads.
///  - connected(): false once the other end is known to be gone: the device unplugged, the peer
///    closed. Never waits. A wire without a detect line is always connected. Changes only within
///    read() and write(). What arrived before a peer closed is read first; a device that is
///    unplugged takes unread bytes along. The read() that sees the loss returns at once; later
///    calls wait their timeout for the other end to come back. Bytes queued before a loss may be
///    lost; none appear twice, or after bytes that were written later.
///  - errors(): what went wrong since the link was opened. Counters only rise (modulo 2^32) and
///    survive a loss. A byte with a framing or noise error may be delivered or dropped.
///  - No call throws or blocks past its timeout; on a microcontroller none allocates.
/// Implementations: hal/fake/memory_link.hpp, host/link/link.hpp. Users:
/// firmware/app/link_bus.hpp, firmware/app/lockstep_bus.hpp.
namespace verp::hal {

struct LinkErrors {
  std::uint32_t overruns = 0;  ///< times bytes came faster than they were fetched, and were lost
  std::uint32_t framing = 0;   ///< bytes without a stop bit, breaks included: wrong baud, or a cut
  std::uint32_t noise = 0;     ///< bytes whose samples or parity disagreed
  std::uint32_t losses = 0;    ///< times that connected() became false
};

template <class Link>
concept ByteLink = requires(Link& link, const Link& seen, const std::uint8_t* from,
                            std::uint8_t* to, std::size_t size, std::uint32_t timeout_us) {
  { link.write(from, size, timeout_us) } -> std::same_as<std::size_t>;
  { link.read(to, size, timeout_us) } -> std::same_as<std::size_t>;
  { seen.connected() } -> std::same_as<bool>;
  { seen.errors() } -> std::same_as<LinkErrors>;
};

}  // namespace verp::hal
