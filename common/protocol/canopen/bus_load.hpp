#pragma once
#include <cstdint>

#include "common/protocol/canopen/frame.hpp"

/// Bits of a frame on the wire, and a bus's load (ISO 11898-1). A stuff bit follows five equal bits
/// and may begin the next five: at worst one after five bits, then one each four.
///
///     classic   header 19 (39) | data | CRC 15 || delimiters, ACK, end 10 | intermission 3
///     FD        header 22 (41) | data || stuff count 4, CRC 17 (21), fixed stuff bits 6 (7) |
///               delimiters, ACK, end 10 | intermission 3
///
/// In brackets: 29-bit identifiers; FD with more than 16 bytes. Stuffing ends at the double line;
/// FD has fixed stuff bits behind it.
namespace verp::canopen {

/// Stuff bits: none, mean of random bits, maximum.
enum class Stuffing : std::uint8_t { kNone, kExpected, kWorst };

/// The phases of an FD frame that switches its rate.
struct FrameBits {
  std::uint32_t nominal = 0;
  std::uint32_t data = 0;

  constexpr std::uint32_t all() const { return nominal + data; }
  constexpr FrameBits& operator+=(const FrameBits& other) {
    nominal += other.nominal;
    data += other.data;
    return *this;
  }
  constexpr FrameBits operator*(std::uint32_t times) const {
    return {nominal * times, data * times};
  }
  constexpr FrameBits operator/(std::uint32_t parts) const {
    return {(nominal + parts - 1) / parts, (data + parts - 1) / parts};
  }
  constexpr bool operator==(const FrameBits&) const = default;
};

inline constexpr std::uint32_t kIntermissionBits = 3;
inline constexpr std::uint32_t kFrameEndBits = 10;  ///< CRC delimiter, ACK and its delimiter, end

constexpr std::uint32_t worst_stuff_bits(std::uint32_t bits) {
  return bits < 5 ? 0 : (bits - 1) / 4;
}

/// A random bit starts or continues a run; from there to five equal bits takes 2 + 4 + 8 + 16 bits
/// on average.
constexpr std::uint32_t stuff_bits(std::uint32_t bits, Stuffing stuffing) {
  constexpr std::uint32_t kBetweenTwo = 30;
  switch (stuffing) {
    case Stuffing::kNone:
      return 0;
    case Stuffing::kExpected:
      return (bits + kBetweenTwo / 2) / kBetweenTwo;
    case Stuffing::kWorst:
      return worst_stuff_bits(bits);
  }
  return 0;
}

/// Data frame with `size` bytes, and the intermission.
constexpr FrameBits classic_bits(std::uint8_t size, Stuffing stuffing, bool extended = false) {
  const std::uint32_t stuffed = (extended ? 39u : 19u) + 8u * size + 15u;
  return {stuffed + stuff_bits(stuffed, stuffing) + kFrameEndBits + kIntermissionBits, 0};
}

/// Frame with room for `size` bytes, and the intermission. `switched`: data rate from after BRS to
/// the CRC delimiter; these two count as nominal.
constexpr FrameBits fd_bits(std::size_t size, Stuffing stuffing, bool switched,
                            bool extended = false) {
  const std::uint32_t bytes = can_fd_size(size);
  const std::uint32_t arbitration = extended ? 36 : 17;  // start of frame to BRS
  const std::uint32_t stuffed_data = 5 + 8 * bytes;      // ESI, data length code, data
  const std::uint32_t crc = bytes > 16 ? 4 + 21 + 7 : 4 + 17 + 6;
  const std::uint32_t arbitration_stuff = stuff_bits(arbitration, stuffing);
  // A stuff bit after the last data bit would be the CRC field's first fixed one.
  const std::uint32_t data_stuff =
      stuff_bits(arbitration + stuffed_data - 1, stuffing) - arbitration_stuff;
  const std::uint32_t slow = arbitration + arbitration_stuff + kFrameEndBits + kIntermissionBits;
  const std::uint32_t fast = stuffed_data + data_stuff + crc;
  return switched ? FrameBits{slow, fast} : FrameBits{slow + fast, 0};
}

constexpr FrameBits frame_bits(const Frame& frame, Stuffing stuffing) {
  if (frame.fd) return fd_bits(frame.size, stuffing, frame.bit_rate_switch, frame.extended);
  return classic_bits(frame.remote ? std::uint8_t{0} : frame.size, stuffing, frame.extended);
}

/// A frame with its own stuff bits. FD as sent by an error-active node.
FrameBits exact_bits(const Frame& frame);

/// Polynomial 4599h, from start of frame to data.
std::uint16_t classic_crc(const Frame& frame);

/// Bit/s. FD frames that switch use `data`.
struct BitRates {
  std::uint32_t nominal = 1'000'000;
  std::uint32_t data = 1'000'000;
};
/// Duration, rounded up.
constexpr std::uint64_t wire_time_ns(const FrameBits& bits, const BitRates& rates) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  return (bits.nominal * kSecond + rates.nominal - 1) / rates.nominal +
         (bits.data * kSecond + rates.data - 1) / rates.data;
}
/// Busy share of a bus with `bits` each `period_us`, in thousandths, rounded up.
constexpr std::uint32_t load_permille(const FrameBits& bits, const BitRates& rates,
                                      std::uint32_t period_us) {
  return static_cast<std::uint32_t>((wire_time_ns(bits, rates) + period_us - 1) / period_us);
}

}  // namespace verp::canopen
