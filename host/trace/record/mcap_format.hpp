#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

/// MCAP, the container of traces: https://mcap.dev/spec (version 0).
namespace verp::record::mcap {

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

inline constexpr std::uint64_t kRecordHead = 9;  ///< opcode and length
inline constexpr std::uint64_t kMessageHead = 22;
inline constexpr std::uint64_t kFooterSize = 20;

using StringMap = std::map<std::string, std::string>;

/// Of a record, and of a chunk unpacked. Ours have some hundred kB; a few bytes of zstd can stand
/// for gigabytes.
inline constexpr std::uint64_t kMostRecord = 64u << 20;

struct Schema {
  std::string_view name, encoding, data;
  bool operator==(const Schema&) const = default;
};
struct Channel {
  std::uint16_t schema = 0;
  std::string_view topic, encoding;
  bool operator==(const Channel&) const = default;
};

/// As in zip and zlib (reflected 0x04C11DB7). For pieces: value = crc32(piece, value).
std::uint32_t crc32(std::string_view bytes, std::uint32_t value = 0);

/// Little-endian numbers, length-prefixed strings and maps.
class Bytes {
 public:
  template <class Integer>
  Bytes& number(Integer value) {
    data.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  Bytes& u8(std::uint8_t value) { return number(value); }
  Bytes& u16(std::uint16_t value) { return number(value); }
  Bytes& u32(std::uint32_t value) { return number(value); }
  Bytes& u64(std::uint64_t value) { return number(value); }
  Bytes& raw(std::string_view bytes) {
    data.append(bytes);
    return *this;
  }
  Bytes& text(std::string_view bytes) {
    return u32(static_cast<std::uint32_t>(bytes.size())).raw(bytes);
  }
  Bytes& map(const StringMap& entries) {
    Bytes inner;
    for (const auto& [key, value] : entries) inner.text(key).text(value);
    return text(inner.data);
  }
  Bytes& record(Opcode opcode, std::string_view content) {
    return u8(static_cast<std::uint8_t>(opcode)).u64(content.size()).raw(content);
  }

  std::string data;
};

}  // namespace verp::record::mcap
