#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/dictionary.hpp"
#include "common/protocol/canopen/frame.hpp"

/// CiA 301. Objects follow in mapping order without gaps, least significant bit first.
namespace verp::canopen {

/// Entry of 1600h or 1A00h: index high, subindex, length in bits.
struct Mapped {
  Address at;
  std::uint8_t bits = 0;

  static constexpr Mapped from(std::uint32_t value) {
    return {{static_cast<std::uint16_t>(value >> 16), static_cast<std::uint8_t>(value >> 8)},
            static_cast<std::uint8_t>(value)};
  }
  constexpr std::uint32_t value() const {
    return std::uint32_t{at.index} << 16 | std::uint32_t{at.subindex} << 8 | bits;
  }
  constexpr bool operator==(const Mapped&) const = default;
};

/// Bits that a data type's object (0001h to 0007h) skips in an RPDO; 0 for others.
constexpr std::uint8_t dummy_bits(Address at) {
  constexpr std::uint8_t kBits[] = {0, 1, 8, 16, 32, 8, 16, 32};
  return at.subindex == 0 && at.index < 8 ? kBits[at.index] : std::uint8_t{0};
}
inline constexpr Mapped kDummyU8{{0x0005, 0}, 8};
inline constexpr Mapped kDummyU16{{0x0006, 0}, 16};
inline constexpr Mapped kDummyU32{{0x0007, 0}, 32};

/// 8 entries for a classic frame's bytes, 64 for FD.
template <std::size_t kEntries = 8>
struct PdoMapping {
  std::uint8_t count = 0;
  Mapped entries[kEntries] = {};

  constexpr unsigned bits() const {
    unsigned sum = 0;
    for (unsigned i = 0; i < count; ++i) sum += entries[i].bits;
    return sum;
  }
  constexpr unsigned bytes() const { return (bits() + 7) / 8; }
  /// False: full.
  constexpr bool add(Mapped entry) {
    if (count >= kEntries) return false;
    entries[count++] = entry;
    return true;
  }
};

constexpr std::uint64_t low_bits(std::uint64_t value, unsigned bits) {
  return bits >= 64 ? value : value & ((std::uint64_t{1} << bits) - 1);
}
/// At most 64 bits; `bytes` must be zero there.
constexpr void put_bits(std::uint8_t* bytes, unsigned at, unsigned bits, std::uint64_t value) {
  for (unsigned done = 0; done < bits;) {
    const unsigned shift = (at + done) % 8;
    const unsigned now = bits - done < 8 - shift ? bits - done : 8 - shift;
    const auto part = static_cast<unsigned>(low_bits(value >> done, now));
    std::uint8_t& byte = bytes[(at + done) / 8];
    byte = static_cast<std::uint8_t>(byte | part << shift);
    done += now;
  }
}
constexpr std::uint64_t get_bits(const std::uint8_t* bytes, unsigned at, unsigned bits) {
  std::uint64_t value = 0;
  for (unsigned done = 0; done < bits;) {
    const unsigned shift = (at + done) % 8;
    const unsigned now = bits - done < 8 - shift ? bits - done : 8 - shift;
    value |= low_bits(std::uint64_t{bytes[(at + done) / 8]} >> shift, now) << done;
    done += now;
  }
  return value;
}

/// Fills data and size, in an FD frame up to the next valid size. `get(at, bits)` returns an
/// object's value; dummies are zero. At most 64 bits, 512 in an FD frame.
template <std::size_t kEntries, class Get>
constexpr void pack_pdo(const PdoMapping<kEntries>& mapping, Frame& frame, Get&& get) {
  const unsigned bytes = mapping.bytes();
  frame.size = frame.fd ? can_fd_size(bytes) : static_cast<std::uint8_t>(bytes);
  for (unsigned i = 0; i < frame.size; ++i) frame.data[i] = 0;
  unsigned at = 0;
  for (unsigned i = 0; i < mapping.count; ++i) {
    const Mapped& each = mapping.entries[i];
    if (dummy_bits(each.at) == 0) {
      put_bits(frame.data, at, each.bits, low_bits(get(each.at, each.bits), each.bits));
    }
    at += each.bits;
  }
}

enum class PdoLength : std::uint8_t {
  kRight,
  kTooShort,  ///< not processed: EMCY 8210h is due
  kTooLong,   ///< processed without the rest: EMCY 8220h is due
};

/// `put(at, bits, value)` gets all but dummies.
template <std::size_t kEntries, class Put>
constexpr PdoLength unpack_pdo(const PdoMapping<kEntries>& mapping, const Frame& frame, Put&& put) {
  const unsigned bytes = mapping.bytes();
  if (frame.size < bytes) return PdoLength::kTooShort;
  unsigned at = 0;
  for (unsigned i = 0; i < mapping.count; ++i) {
    const Mapped& each = mapping.entries[i];
    if (dummy_bits(each.at) == 0) put(each.at, each.bits, get_bits(frame.data, at, each.bits));
    at += each.bits;
  }
  const unsigned sent = frame.fd ? can_fd_size(bytes) : bytes;
  return frame.size > sent ? PdoLength::kTooLong : PdoLength::kRight;
}

}  // namespace verp::canopen
