#pragma once
#include <cstddef>
#include <cstdint>

/// Classic or FD. Limits from ISO 11898-1.
namespace verp {

inline constexpr std::uint8_t kMaxCanData = 8;
inline constexpr std::uint8_t kMaxCanFdData = 64;

inline constexpr std::uint8_t kCanFdSizes[] = {12, 16, 20, 24, 32, 48, 64};  ///< beyond 8 bytes

/// Smallest FD size that holds `size` bytes; at most 64.
constexpr std::uint8_t can_fd_size(std::size_t size) {
  if (size <= kMaxCanData) return static_cast<std::uint8_t>(size);
  for (const std::uint8_t each : kCanFdSizes) {
    if (size <= each) return each;
  }
  return kMaxCanFdData;
}

/// `size` must be one that can_fd_size() returns.
constexpr std::uint8_t can_length_code(std::uint8_t size) {
  if (size <= kMaxCanData) return size;
  std::uint8_t code = 9;
  for (const std::uint8_t each : kCanFdSizes) {
    if (size <= each) return code;
    ++code;
  }
  return 15;
}

struct CanFrame {
  std::uint32_t id = 0;   ///< 11 bits, or 29 if `extended`
  std::uint8_t size = 0;  ///< bytes in use
  bool extended = false;
  bool remote = false;           ///< classic remote request, without data
  bool fd = false;               ///< CAN FD format
  bool bit_rate_switch = false;  ///< FD: faster data phase
  std::uint8_t data[kMaxCanFdData] = {};

  constexpr bool operator==(const CanFrame& other) const {
    if (id != other.id || size != other.size || extended != other.extended) return false;
    if (remote != other.remote || fd != other.fd) return false;
    if (bit_rate_switch != other.bit_rate_switch) return false;
    for (unsigned i = 0; i < size; ++i) {
      if (data[i] != other.data[i]) return false;
    }
    return true;
  }
};

/// The smaller rank wins the bus. Bits in wire order: 11 identifier bits, RTR (SRR), IDE, the rest
/// of an extended identifier (ISO 11898-1: a dominant 0 overwrites a recessive 1).
constexpr std::uint32_t can_rank(const CanFrame& frame) {
  const std::uint32_t remote = frame.remote ? 1 : 0;
  if (!frame.extended) return (frame.id & 0x7FFu) << 21 | remote << 20;
  return (frame.id >> 18 & 0x7FFu) << 21 | 3u << 19 | (frame.id & 0x3FFFFu) << 1 | remote;
}

/// True if the format allows identifier, size and flags.
constexpr bool is_sound(const CanFrame& frame) {
  if (frame.id > (frame.extended ? 0x1FFFFFFFu : 0x7FFu)) return false;
  if (frame.fd) return !frame.remote && frame.size == can_fd_size(frame.size);
  return frame.size <= kMaxCanData && !frame.bit_rate_switch;
}

}  // namespace verp
