#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/dictionary.hpp"
#include "common/protocol/canopen/frame.hpp"

/// SDO frames (CiA 301). Byte 0 begins with a three-bit command, except in a block's segments.
/// Initiating frames and aborts have the address in bytes 1 to 3.
namespace verp::canopen::sdo {

inline constexpr std::uint8_t kFrameBytes = 8;
inline constexpr std::uint8_t kSegmentBytes = 7;
inline constexpr std::uint8_t kMaxBlock = 127;        ///< segments in a block
inline constexpr std::uint8_t kMaxIdleBlocks = 8;     ///< consecutive blocks without progress
inline constexpr std::uint32_t kTimeoutUs = 500'000;  ///< bus time; masters often wait 0.3-1 s

/// Client command specifiers; the server's differ.
namespace request {
inline constexpr std::uint8_t kDownloadSegment = 0;
inline constexpr std::uint8_t kDownload = 1;
inline constexpr std::uint8_t kUpload = 2;
inline constexpr std::uint8_t kUploadSegment = 3;
inline constexpr std::uint8_t kBlockUpload = 5;
inline constexpr std::uint8_t kBlockDownload = 6;
}  // namespace request
namespace response {
inline constexpr std::uint8_t kUploadSegment = 0;
inline constexpr std::uint8_t kDownloadSegment = 1;
inline constexpr std::uint8_t kUpload = 2;
inline constexpr std::uint8_t kDownload = 3;
inline constexpr std::uint8_t kBlockDownload = 5;
inline constexpr std::uint8_t kBlockUpload = 6;
}  // namespace response

inline constexpr std::uint8_t kAbort = 0x80;  ///< no block segment has it

inline constexpr std::uint8_t kToggleBit = 0x10;
inline constexpr std::uint8_t kLastSegment = 0x01;  ///< of a segmented transfer
inline constexpr std::uint8_t kExpedited = 0x02;
inline constexpr std::uint8_t kSizeGiven = 0x01;
inline constexpr std::uint8_t kLastOfBlocks = 0x80;
inline constexpr std::uint8_t kBlockCrc = 0x04;
inline constexpr std::uint8_t kBlockSizeGiven = 0x02;
inline constexpr std::uint8_t kSubMask = 0x03;
inline constexpr std::uint8_t kBlockInitiate = 0;
inline constexpr std::uint8_t kBlockEnd = 1;
inline constexpr std::uint8_t kBlockResponse = 2;
inline constexpr std::uint8_t kBlockStart = 3;

constexpr std::uint8_t command(std::uint8_t specifier, unsigned bits = 0) {
  return static_cast<std::uint8_t>(unsigned{specifier} << 5 | bits);
}
constexpr std::uint8_t specifier_of(const Frame& frame) {
  return static_cast<std::uint8_t>(frame.data[0] >> 5);
}
constexpr Address address_of(const Frame& frame) {
  return {static_cast<std::uint16_t>(get_le(frame.data + 1, 2)), frame.data[3]};
}
/// Unused bytes, by byte 0: of four (expedited), of seven (a segment), a block's last segment.
constexpr unsigned unused_of_four(const Frame& frame) {
  return frame.data[0] >> 2 & 3u;
}
constexpr unsigned unused_of_seven(const Frame& frame) {
  return frame.data[0] >> 1 & 7u;
}
constexpr unsigned unused_of_block(const Frame& frame) {
  return frame.data[0] >> 2 & 7u;
}

constexpr Frame bare(std::uint32_t id, std::uint8_t byte0) {
  Frame frame = classic_frame(id, kFrameBytes);
  frame.data[0] = byte0;
  return frame;
}
/// `number` goes into bytes 4 to 7.
constexpr Frame addressed(std::uint32_t id, std::uint8_t byte0, Address at,
                          std::uint32_t number = 0) {
  Frame frame = bare(id, byte0);
  put_le(frame.data + 1, at.index, 2);
  frame.data[3] = at.subindex;
  put_le(frame.data + 4, number, 4);
  return frame;
}
constexpr Frame abort_frame(std::uint32_t id, Address at, Abort reason) {
  return addressed(id, kAbort, at, static_cast<std::uint32_t>(reason));
}
/// At most 7 bytes.
constexpr Frame segment(std::uint32_t id, std::uint8_t specifier, bool toggle,
                        const std::uint8_t* data, unsigned size, bool last) {
  const unsigned unused = kSegmentBytes - size;
  Frame frame = bare(
      id, command(specifier, (toggle ? kToggleBit : 0u) | unused << 1 | (last ? kLastSegment : 0)));
  for (unsigned i = 0; i < size; ++i) frame.data[1 + i] = data[i];
  return frame;
}
constexpr Frame block_end(std::uint32_t id, std::uint8_t specifier, unsigned unused,
                          std::uint16_t crc) {
  Frame frame = bare(id, command(specifier, unused << 2 | kBlockEnd));
  put_le(frame.data + 1, crc, 2);
  return frame;
}
/// Confirms segments in order, sets the next block's size.
constexpr Frame block_response(std::uint32_t id, std::uint8_t specifier, std::uint8_t sequence,
                               std::uint8_t block) {
  Frame frame = bare(id, command(specifier, kBlockResponse));
  frame.data[1] = sequence;
  frame.data[2] = block;
  return frame;
}

/// Polynomial 1021h, not reflected, initial value 0 or an earlier `crc`.
std::uint16_t crc16(const std::uint8_t* data, std::size_t size, std::uint16_t crc = 0);

}  // namespace verp::canopen::sdo
