#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace verp::canopen {

/// SDO abort codes, CiA 301's table.
enum class Abort : std::uint32_t {
  kNone = 0,
  kToggle = 0x05030000,
  kTimeout = 0x05040000,
  kCommand = 0x05040001,
  kBlockSize = 0x05040002,
  kSequence = 0x05040003,
  kCrc = 0x05040004,
  kOutOfMemory = 0x05040005,
  kUnsupportedAccess = 0x06010000,
  kWriteOnly = 0x06010001,
  kReadOnly = 0x06010002,
  kNoObject = 0x06020000,
  kNotMappable = 0x06040041,
  kPdoLength = 0x06040042,
  kIncompatibleParameter = 0x06040043,
  kIncompatibleDevice = 0x06040047,
  kHardware = 0x06060000,
  kLength = 0x06070010,
  kTooLong = 0x06070012,
  kTooShort = 0x06070013,
  kNoSubindex = 0x06090011,
  kValueRange = 0x06090030,
  kValueTooHigh = 0x06090031,
  kValueTooLow = 0x06090032,
  kMaxBelowMin = 0x06090036,
  kNoConnection = 0x060A0023,
  kGeneral = 0x08000000,
  kCannotStore = 0x08000020,
  kLocalControl = 0x08000021,
  kDeviceState = 0x08000022,
  kNoDictionary = 0x08000023,
  kNoData = 0x08000024,
};

/// English name; "unknown abort code" if not in the table.
const char* abort_text(Abort abort);

struct Address {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  constexpr bool operator==(const Address&) const = default;
};

struct Entry {
  bool readable = false;
  bool writable = false;
  std::uint32_t size = 0;      ///< bytes that a read returns now
  std::uint32_t min_size = 0;  ///< bytes that a write may have
  std::uint32_t max_size = 0;
};

/// Neither waits nor allocates:
///  - find(at, entry): kNone and the entry, or kNoObject, kNoSubindex.
///  - read(at, offset, buffer, size): copies bytes [offset, offset + size), little-endian, or
///    returns an error. Objects up to the server's buffer are read in one call; larger ones in
///    pieces, and must not change meanwhile.
///  - write(at, data, size): the whole new value, within the entry's sizes; done or refused, never
///    half.
template <class D>
concept Dictionary = requires(D& dictionary, Address at, Entry& entry, std::uint32_t offset,
                              std::uint8_t* buffer, const std::uint8_t* data, std::uint32_t size) {
  { dictionary.find(at, entry) } -> std::same_as<Abort>;
  { dictionary.read(at, offset, buffer, size) } -> std::same_as<Abort>;
  { dictionary.write(at, data, size) } -> std::same_as<Abort>;
};

/// Writes objects larger than the server's buffer (an image, an action):
///  - write_part(at, offset, data, size): the next bytes, without effect yet. Offset 0 discards an
///    abandoned transfer.
///  - write_done(at, size): all bytes passed the transfer's check, if any: take effect or refuse.
template <class D>
concept StreamingDictionary = Dictionary<D> &&
    requires(D& dictionary, Address at, std::uint32_t offset, const std::uint8_t* data,
             std::uint32_t size) {
  { dictionary.write_part(at, offset, data, size) } -> std::same_as<Abort>;
  { dictionary.write_done(at, size) } -> std::same_as<Abort>;
};

}  // namespace verp::canopen
