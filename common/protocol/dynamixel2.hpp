#pragma once
#include <cstddef>
#include <cstdint>

/// Dynamixel Protocol 2.0, both ends, bytes only. Source: ROBOTIS e-Manual, "DYNAMIXEL Protocol
/// 2.0" (emanual.robotis.com/docs/en/dxl/protocol2); for Fast Sync Read also the vendor's SDK,
/// which does not unstuff such replies.
///
///     FF FF FD 00 | id | length (2) | instruction | parameters ... | CRC (2)
///
/// `length` counts from the instruction to the CRC's end, after stuffing. A status packet's
/// instruction is 0x55; its first parameter is the error field.
namespace verp::dxl {

enum class Instruction : std::uint8_t {
  kPing = 0x01,
  kRead = 0x02,
  kWrite = 0x03,
  kRegWrite = 0x04,
  kAction = 0x05,
  kFactoryReset = 0x06,
  kReboot = 0x08,
  kClear = 0x10,
  kStatus = 0x55,
  kSyncRead = 0x82,
  kSyncWrite = 0x83,
  kFastSyncRead = 0x8A,
  kBulkRead = 0x92,
  kBulkWrite = 0x93,
  kFastBulkRead = 0x9A,
};

/// Low seven bits of the error field.
enum class Error : std::uint8_t {
  kNone = 0,
  kResultFail = 1,
  kInstruction = 2,
  kCrc = 3,
  kDataRange = 4,
  kDataLength = 5,
  kDataLimit = 6,
  kAccess = 7,
};
inline constexpr std::uint8_t kAlert = 0x80;  ///< Hardware Error Status (70) is not zero

/// kAll is ignored as a broadcast (firmware 42).
enum class Reset : std::uint8_t { kAll = 0xFF, kAllButId = 0x01, kAllButIdAndBaud = 0x02 };

/// Removes turns from a multi-turn position; refused while moving.
inline constexpr std::uint8_t kClearTurns[] = {0x01, 0x44, 0x58, 0x4C, 0x22};

inline constexpr std::uint8_t kBroadcast = 0xFE;
inline constexpr std::uint8_t kMaxId = 252;
inline constexpr std::uint8_t kHeader[4] = {0xFF, 0xFF, 0xFD, 0x00};
inline constexpr std::size_t kLengthAt = 5;
inline constexpr std::size_t kHeaderBytes = 7;  ///< up to `length`
inline constexpr std::size_t kCrcBytes = 2;
inline constexpr std::size_t kInstructionBytes = 10;  ///< a packet without parameters
inline constexpr std::size_t kStatusBytes = 11;       ///< a status packet without data
inline constexpr std::size_t kMaxPacket = 512;        ///< longest packet sent or accepted
inline constexpr std::size_t kFastHeaderBytes = 8;    ///< bytes before the first device block
inline constexpr std::size_t kFastBlockBytes = 4;  ///< error, id and CRC around each device's data

constexpr std::uint16_t get_u16(const std::uint8_t* bytes) {
  return static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
}
constexpr std::uint32_t get_u32(const std::uint8_t* bytes) {
  return static_cast<std::uint32_t>(get_u16(bytes)) | static_cast<std::uint32_t>(get_u16(bytes + 2))
                                                          << 16;
}
constexpr void put_u16(std::uint8_t* bytes, std::uint32_t value) {
  bytes[0] = static_cast<std::uint8_t>(value);
  bytes[1] = static_cast<std::uint8_t>(value >> 8);
}
constexpr void put_u32(std::uint8_t* bytes, std::uint32_t value) {
  put_u16(bytes, value);
  put_u16(bytes + 2, value >> 16);
}

/// CRC-16: polynomial 0x8005, not reflected, initial value 0 or an earlier part's `crc`.
std::uint16_t crc16(const std::uint8_t* data, std::size_t size, std::uint16_t crc = 0);

/// Writes one packet: begin, parameters, finish. Stuffing may need a third more room. A packet that
/// does not fit has size 0; nothing is written past the capacity.
class Encoder {
 public:
  constexpr Encoder(std::uint8_t* buffer, std::size_t capacity)
      : buffer_(buffer), capacity_(capacity < kMaxPacket ? capacity : kMaxPacket) {}
  void begin(std::uint8_t id, Instruction instruction);
  void u8(std::uint8_t value);
  void u16(std::uint32_t value);
  void u32(std::uint32_t value);
  void bytes(const std::uint8_t* data, std::size_t size);
  std::size_t finish();

 private:
  void raw(std::uint8_t value);
  std::uint8_t* buffer_;
  std::size_t capacity_;
  std::size_t size_ = 0;
  std::uint32_t last_ = 0;  ///< last three stuffable bytes
  bool fits_ = true;
};

// Whole packets. Each returns its size; 0 if it did not fit.
std::size_t encode_ping(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id);
std::size_t encode_read(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                        std::uint16_t address, std::uint16_t length);
std::size_t encode_write(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                         std::uint16_t address, const std::uint8_t* data, std::size_t size);
/// A write that waits for kAction.
std::size_t encode_reg_write(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                             std::uint16_t address, const std::uint8_t* data, std::size_t size);
/// `instruction` is kPing, kAction or kReboot.
std::size_t encode_plain(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                         Instruction instruction);
std::size_t encode_factory_reset(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                                 Reset reset);
std::size_t encode_clear_turns(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id);
/// `instruction` is kSyncRead or kFastSyncRead.
std::size_t encode_sync_read(std::uint8_t* buffer, std::size_t capacity, Instruction instruction,
                             std::uint16_t address, std::uint16_t length, const std::uint8_t* ids,
                             std::size_t count);
/// Sync Write: this, id and data of each device, finish.
void begin_sync_write(Encoder& encoder, std::uint16_t address, std::uint16_t length);
/// kBulkRead, kFastBulkRead, kBulkWrite. Then an entry for each device (in a Bulk Write followed by
/// its data), finish.
void begin_bulk(Encoder& encoder, Instruction instruction);
void bulk_entry(Encoder& encoder, std::uint8_t id, std::uint16_t address, std::uint16_t length);
inline constexpr std::size_t kBulkEntryBytes = 5;
std::size_t encode_status(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                          std::uint8_t error, const std::uint8_t* data, std::size_t size);

/// One device's part of a Fast Sync or Bulk Read's reply, not stuffed. The first also writes the
/// header with `all_bytes` of all blocks (kFastBlockBytes + length each). `crc` runs through all
/// parts. Returns the size; `buffer` holds 12 + length bytes.
std::size_t encode_fast_block(std::uint8_t* buffer, bool first, std::size_t all_bytes,
                              std::uint8_t id, std::uint8_t error, const std::uint8_t* data,
                              std::size_t length, std::uint16_t& crc);

/// `parameters` is valid until the parser's next call.
struct Packet {
  std::uint8_t id = 0;
  Instruction instruction = Instruction::kPing;
  std::uint8_t error = 0;  ///< of a status packet, with alert bit
  const std::uint8_t* parameters = nullptr;
  std::size_t size = 0;

  bool is_status() const { return instruction == Instruction::kStatus; }
  /// Reply to a fast read: blocks of error, id, data, CRC.
  bool is_fast_reply() const { return is_status() && id == kBroadcast; }
};

/// One device's data in a fast reply.
struct FastBlock {
  std::uint8_t error = 0;
  std::uint8_t id = 0;
  const std::uint8_t* data = nullptr;
};
/// The block at byte `offset`; false if the reply is too short. The next one is kFastBlockBytes +
/// length further.
bool fast_block_at(const Packet& reply, std::size_t offset, std::size_t length, FastBlock& block);
/// Block `index` of `length` data bytes each; false if there is none.
bool fast_block(const Packet& reply, std::size_t index, std::size_t length, FastBlock& block);

/// Finds packets in a byte stream. Noise, cut packets and bad CRCs cost no other packet: the search
/// resumes one byte after a false header. Bounded work: each byte is summed and moved at most once
/// per false header in the 512 bytes before it.
class Parser {
 public:
  /// True: a packet is complete; call next() until false before the next push().
  bool push(std::uint8_t byte);
  bool next();
  const Packet& packet() const { return packet_; }
  /// Forgets all bytes; the counters stay.
  void reset() { begin_ = size_ = done_ = need_ = 0; }

  std::uint32_t crc_errors() const { return crc_errors_; }
  std::uint32_t noise_bytes() const { return noise_bytes_; }
  /// Cost so far, in bytes stored, searched, summed and moved; wraps.
  std::uint32_t steps() const { return steps_; }

 private:
  enum class Look { kMore, kDrop, kPacket };
  Look look();
  bool may_begin_at(std::size_t offset) const;
  void search_on();
  void drop(std::size_t count);
  void make_room();
  void decode(std::size_t end);

  std::uint8_t buffer_[kMaxPacket];
  std::size_t begin_ = 0;  ///< where a packet may begin
  std::size_t size_ = 0;   ///< bytes in use
  std::size_t done_ = 0;   ///< packet last reported, dropped next
  std::size_t need_ = 0;   ///< bytes to wait for; at most kMaxPacket
  std::uint32_t crc_errors_ = 0;
  std::uint32_t noise_bytes_ = 0;
  std::uint32_t steps_ = 0;
  Packet packet_;
};

}  // namespace verp::dxl
