#pragma once
#include <cstddef>
#include <cstdint>

/// One CAN frame as a value, classic or FD. Sources of the limits: ISO 11898-1 (identifiers, data
/// length codes).
namespace verp {

inline constexpr std::uint8_t kMaxCanData = 8;
inline constexpr std::uint8_t kMaxCanFdData = 64;

inline constexpr std::uint8_t kCanFdSizes[] = {12, 16, 20, 24, 32, 48, 64};  ///< beyond 8 bytes

/// The smallest data size of an FD frame that holds `size` bytes; 0 to 8 as they are. More than 64
/// gives 64.
constexpr std::uint8_t can_fd_size(std::size_t size) {
  if (size <= kMaxCanData) return static_cast<std::uint8_t>(size);
  for (const std::uint8_t each : kCanFdSizes) {
    if (size <= each) return each;
  }
  return kMaxCanFdData;
}

/// The data length code of a frame with `size` bytes, one that can_fd_size() would return.
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
  std::uint8_t size = 0;  ///< bytes of data in use
  bool extended = false;
  bool remote = false;           ///< a classic remote request: it has no data
  bool fd = false;               ///< CAN FD format
  bool bit_rate_switch = false;  ///< FD only: the data phase runs at the faster rate
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

/// Who wins the bus: of two frames that begin at one time, the one with the smaller rank. In the
/// order of the wire: 11 bits of identifier, RTR (SRR), IDE, then what an extended frame has
/// behind (ISO 11898-1: a dominant 0 overwrites a recessive 1).
constexpr std::uint32_t can_rank(const CanFrame& frame) {
  const std::uint32_t remote = frame.remote ? 1 : 0;
  if (!frame.extended) return (frame.id & 0x7FFu) << 21 | remote << 20;
  return (frame.id >> 18 & 0x7FFu) << 21 | 3u << 19 | (frame.id & 0x3FFFFu) << 1 | remote;
}

/// Whether this can stand on a bus: identifier, size and flags as its format has them.
constexpr bool is_sound(const CanFrame& frame) {
  if (frame.id > (frame.extended ? 0x1FFFFFFFu : 0x7FFu)) return false;
  if (frame.fd) return !frame.remote && frame.size == can_fd_size(frame.size);
  return frame.size <= kMaxCanData && !frame.bit_rate_switch;
}

}  // namespace verp
