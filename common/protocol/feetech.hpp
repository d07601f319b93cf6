#pragma once
#include <cstddef>
#include <cstdint>

/// Feetech's serial protocol (FT-SCS), both ends, bytes only. Source: Feetech, "Communication
/// Protocol User Manual", 1.1 to 1.3.7, whose examples tests/unit/protocol/feetech_test.cpp quotes.
///
///     FF FF | id | length | instruction, or the servo's status | parameters ... | checksum
///
/// `length` counts from the instruction to the checksum. The checksum is the complement of the sum
/// from the id on: a damaged packet passes with one chance in 256, and with certainty if two errors
/// cancel. No byte stuffing: FF FF may also stand in a packet. Requests and answers look alike.
namespace verp::feetech {

enum class Instruction : std::uint8_t {
  kPing = 0x01,
  kRead = 0x02,
  kWrite = 0x03,
  kRegWrite = 0x04,
  kAction = 0x05,
  kSyncRead = 0x82,
  kSyncWrite = 0x83,
};

inline constexpr std::uint8_t kBroadcast = 0xFE;
inline constexpr std::uint8_t kMaxId = 253;
inline constexpr std::uint8_t kHeaderByte = 0xFF;
inline constexpr std::size_t kHeaderBytes = 4;       ///< up to `length`
inline constexpr std::size_t kInstructionBytes = 6;  ///< a packet without parameters
inline constexpr std::size_t kStatusBytes = 6;       ///< an answer without data
inline constexpr std::size_t kMaxPacket = kHeaderBytes + 255;
inline constexpr std::size_t kMostParameters = 253;

std::uint8_t checksum(const std::uint8_t* from_id, std::size_t size);

/// STS servos put the low byte first.
constexpr std::uint16_t get_u16(const std::uint8_t* bytes) {
  return static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
}
constexpr void put_u16(std::uint8_t* bytes, std::uint32_t value) {
  bytes[0] = static_cast<std::uint8_t>(value);
  bytes[1] = static_cast<std::uint8_t>(value >> 8);
}

/// A magnitude with its sign in bit `sign_bit`.
constexpr std::int32_t from_magnitude(std::uint16_t raw, unsigned sign_bit) {
  const std::int32_t magnitude = raw & ((1 << sign_bit) - 1);
  return (raw >> sign_bit & 1) != 0 ? -magnitude : magnitude;
}
/// A value beyond the magnitude becomes the nearest one.
constexpr std::uint16_t to_magnitude(std::int32_t value, unsigned sign_bit) {
  const std::int32_t most = (1 << sign_bit) - 1;
  const std::int32_t size = value < -most ? most : value < 0 ? -value : value > most ? most : value;
  return static_cast<std::uint16_t>(size | (value < 0 ? 1 << sign_bit : 0));
}

/// Writes one packet: begin, parameters, finish. One that does not fit has size 0.
class Encoder {
 public:
  constexpr Encoder(std::uint8_t* buffer, std::size_t capacity)
      : buffer_(buffer), capacity_(capacity < kMaxPacket ? capacity : kMaxPacket) {}
  /// `code`: an instruction, or an answer's status.
  void begin(std::uint8_t id, std::uint8_t code);
  void begin(std::uint8_t id, Instruction instruction) {
    begin(id, static_cast<std::uint8_t>(instruction));
  }
  void u8(std::uint8_t value);
  void u16(std::uint32_t value);
  void bytes(const std::uint8_t* data, std::size_t size);
  std::size_t finish();

 private:
  std::uint8_t* buffer_;
  std::size_t capacity_;
  std::size_t size_ = 0;
  bool fits_ = true;
};

// Whole packets. Each returns its size; 0 if it did not fit.
std::size_t encode_ping(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id);
std::size_t encode_read(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                        std::uint8_t address, std::uint8_t length);
std::size_t encode_write(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                         std::uint8_t address, const std::uint8_t* data, std::size_t size);
std::size_t encode_sync_read(std::uint8_t* buffer, std::size_t capacity, std::uint8_t address,
                             std::uint8_t length, const std::uint8_t* ids, std::size_t count);
/// Sync Write: this, id and data of each device, finish.
void begin_sync_write(Encoder& encoder, std::uint8_t address, std::uint8_t length);
std::size_t encode_status(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                          std::uint8_t status, const std::uint8_t* data, std::size_t size);

/// Valid until the parser's next call.
struct Packet {
  std::uint8_t id = 0;
  std::uint8_t code = 0;  ///< Instruction of a request, status bits of an answer
  const std::uint8_t* parameters = nullptr;
  std::size_t size = 0;
  const std::uint8_t* whole = nullptr;

  std::size_t whole_size() const { return size + kInstructionBytes; }
  /// These bytes: our own request, echoed on one wire.
  bool is(const std::uint8_t* bytes, std::size_t count) const;
};

/// Finds packets in a byte stream, as dxl::Parser does: noise and bad checksums cost no other
/// packet, because the search resumes one byte after a false header.
class Parser {
 public:
  /// True: a packet is complete; call next() until false before the next push().
  bool push(std::uint8_t byte);
  bool next();
  const Packet& packet() const { return packet_; }
  /// Forgets all bytes; the counters stay.
  void reset() { size_ = done_ = 0; }

  std::uint32_t checksum_errors() const { return checksum_errors_; }
  std::uint32_t noise_bytes() const { return noise_bytes_; }

 private:
  enum class Look { kMore, kDrop, kPacket };
  Look look();
  void drop(std::size_t count);

  std::uint8_t buffer_[kMaxPacket];
  std::size_t size_ = 0;  ///< bytes in use
  std::size_t done_ = 0;  ///< packet last reported, dropped next
  std::uint32_t checksum_errors_ = 0;
  std::uint32_t noise_bytes_ = 0;
  Packet packet_;
};

}  // namespace verp::feetech
