#pragma once
#include <cstddef>
#include <cstdint>

/// Bytes and waiting on a half-duplex serial line, whatever its protocol.
namespace verp::app {

inline constexpr std::uint32_t kBitsPerByte = 10;  ///< start, eight data, stop
/// From a request's last byte to the reply, above the device's own return delay of 0: an allowance,
/// not a measurement. A slower servo counts as silent.
inline constexpr std::uint32_t kReplySlackUs = 25;
inline constexpr std::uint32_t kTransactionSlackUs =
    150;  ///< master's interrupt and driver latency
/// ROBOTIS e-Manual, Return Delay Time, and Feetech's memory table, Return delay: 254 x 2 us.
inline constexpr std::uint32_t kLongestReturnDelayUs = 508;
/// Most extra bytes per device after an unanswered read (RequestMaster::spare_bytes).
inline constexpr std::uint8_t kMostSpare = 2;

constexpr std::uint32_t wire_us(std::size_t bytes, std::uint32_t baud) {
  const std::uint64_t bits = std::uint64_t{bytes} * kBitsPerByte * 1000000u;
  return baud == 0 ? 0xFFFFFFFFu : static_cast<std::uint32_t>((bits + baud - 1) / baud);
}

constexpr std::uint32_t timeout_us(std::size_t bytes, std::size_t replies, std::uint32_t baud) {
  return wire_us(bytes, baud) + static_cast<std::uint32_t>(replies) * kReplySlackUs +
         kTransactionSlackUs;
}

}  // namespace verp::app
