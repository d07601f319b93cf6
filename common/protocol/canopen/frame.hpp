#pragma once
#include <cstdint>

#include "common/base/can_frame.hpp"

/// CAN frames in CANopen: little-endian, classic data frames.
namespace verp::canopen {

using Frame = CanFrame;

/// `bytes` is 1 to 8.
constexpr std::uint64_t get_le(const std::uint8_t* from, unsigned bytes) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < bytes; ++i) value |= std::uint64_t{from[i]} << (8 * i);
  return value;
}
/// Writes the low `bytes` bytes of `value`, 1 to 8.
constexpr void put_le(std::uint8_t* to, std::uint64_t value, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

constexpr Frame classic_frame(std::uint32_t id, std::uint8_t size) {
  Frame frame;
  frame.id = id;
  frame.size = size < kMaxCanData ? size : kMaxCanData;
  return frame;
}

/// CANopen services are classic data frames with 11-bit identifiers.
constexpr bool is_canopen(const Frame& frame) {
  return !frame.extended && !frame.remote && !frame.fd;
}

}  // namespace verp::canopen
