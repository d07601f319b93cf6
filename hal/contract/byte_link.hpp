#pragma once
#include <cstddef>
#include <cstdint>

/// ByteLink: a full-duplex byte stream without framing, to an operator, a program or a serial
/// device.
///
/// A backend promises (times are wall time, or the fake's script time):
///  - write(data, size, timeout_us): queues bytes from the front until all are queued or timeout_us
///    has passed; returns the count. With timeout 0 it queues what fits and returns at once. Queued
///    bytes leave in order without another call.
///  - read(buffer, capacity, timeout_us): waits for a byte or timeout_us; stores at most capacity
///    bytes in order; returns the count.
///  - connected(): false once the far end is known to be gone (device unplugged, peer closed).
///    Never waits; changes only within read() and write(). Without a detect line always true.
///  - Loss: bytes sent before a peer closed are still read; unplugging a device loses its unread
///    bytes. The read() that sees the loss returns at once; later calls wait out their timeout.
///    Queued bytes may be lost, but never appear twice or after later ones.
///  - errors(): counts since open, modulo 2^32; a loss does not reset them. A byte with a framing
///    or noise error may be delivered or dropped.
///  - No call throws or blocks past its timeout; on a microcontroller none allocates.
namespace verp::hal {

struct LinkErrors {
  std::uint32_t overruns = 0;  ///< times that bytes came too fast and were lost
  std::uint32_t framing = 0;   ///< bytes without a stop bit: wrong baud rate, break, cut wire
  std::uint32_t noise = 0;     ///< bytes whose samples or parity disagreed
  std::uint32_t losses = 0;    ///< times connected() became false
};

class ByteLink {
 public:
  virtual std::size_t write(const std::uint8_t* data, std::size_t size,
                            std::uint32_t timeout_us) = 0;
  virtual std::size_t read(std::uint8_t* buffer, std::size_t capacity,
                           std::uint32_t timeout_us) = 0;
  virtual bool connected() const = 0;
  virtual LinkErrors errors() const = 0;

 protected:
  ~ByteLink() = default;
};

}  // namespace verp::hal
