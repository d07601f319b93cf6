#include "common/protocol/dynamixel2.hpp"

namespace verp::dxl {
namespace {

constexpr std::uint16_t kPolynomial = 0x8005;

struct CrcTable {
  std::uint16_t row[256];
};

consteval CrcTable make_crc_table() {
  CrcTable table{};
  for (unsigned i = 0; i < 256; ++i) {
    unsigned value = i << 8;
    for (int bit = 0; bit < 8; ++bit) {
      value = (value & 0x8000u) != 0 ? (value << 1) ^ kPolynomial : value << 1;
    }
    table.row[i] = static_cast<std::uint16_t>(value);
  }
  return table;
}

constexpr CrcTable kCrc = make_crc_table();

}  // namespace

std::uint16_t crc16(const std::uint8_t* data, std::size_t size, std::uint16_t crc) {
  for (std::size_t i = 0; i < size; ++i) {
    crc = static_cast<std::uint16_t>((crc << 8) ^ kCrc.row[(crc >> 8 ^ data[i]) & 0xFF]);
  }
  return crc;
}

void Encoder::raw(std::uint8_t value) {
  if (size_ < capacity_) {
    buffer_[size_++] = value;
  } else {
    fits_ = false;
  }
}

void Encoder::begin(std::uint8_t id, Instruction instruction) {
  size_ = 0;
  last_ = 0;
  fits_ = true;
  for (std::uint8_t value : kHeader) raw(value);
  raw(id);
  raw(0);  // length, set by finish()
  raw(0);
  u8(static_cast<std::uint8_t>(instruction));
}

void Encoder::u8(std::uint8_t value) {
  raw(value);
  last_ = (last_ << 8 | value) & 0xFFFFFF;
  if (last_ == 0xFFFFFD) raw(0xFD);
}

void Encoder::u16(std::uint32_t value) {
  u8(static_cast<std::uint8_t>(value));
  u8(static_cast<std::uint8_t>(value >> 8));
}

void Encoder::u32(std::uint32_t value) {
  u16(value);
  u16(value >> 16);
}

void Encoder::bytes(const std::uint8_t* data, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) u8(data[i]);
}

std::size_t Encoder::finish() {
  if (!fits_ || size_ + kCrcBytes > capacity_) return 0;
  put_u16(buffer_ + kLengthAt, static_cast<std::uint32_t>(size_ + kCrcBytes - kHeaderBytes));
  put_u16(buffer_ + size_, crc16(buffer_, size_));
  return size_ + kCrcBytes;
}

namespace {

std::size_t encode_write_as(Instruction instruction, std::uint8_t* buffer, std::size_t capacity,
                            std::uint8_t id, std::uint16_t address, const std::uint8_t* data,
                            std::size_t size) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, instruction);
  encoder.u16(address);
  encoder.bytes(data, size);
  return encoder.finish();
}

}  // namespace

std::size_t encode_plain(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                         Instruction instruction) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, instruction);
  return encoder.finish();
}

std::size_t encode_ping(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id) {
  return encode_plain(buffer, capacity, id, Instruction::kPing);
}

std::size_t encode_read(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                        std::uint16_t address, std::uint16_t length) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, Instruction::kRead);
  encoder.u16(address);
  encoder.u16(length);
  return encoder.finish();
}

std::size_t encode_write(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                         std::uint16_t address, const std::uint8_t* data, std::size_t size) {
  return encode_write_as(Instruction::kWrite, buffer, capacity, id, address, data, size);
}

std::size_t encode_reg_write(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                             std::uint16_t address, const std::uint8_t* data, std::size_t size) {
  return encode_write_as(Instruction::kRegWrite, buffer, capacity, id, address, data, size);
}

std::size_t encode_factory_reset(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                                 Reset reset) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, Instruction::kFactoryReset);
  encoder.u8(static_cast<std::uint8_t>(reset));
  return encoder.finish();
}

std::size_t encode_clear_turns(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, Instruction::kClear);
  encoder.bytes(kClearTurns, sizeof kClearTurns);
  return encoder.finish();
}

std::size_t encode_sync_read(std::uint8_t* buffer, std::size_t capacity, Instruction instruction,
                             std::uint16_t address, std::uint16_t length, const std::uint8_t* ids,
                             std::size_t count) {
  Encoder encoder(buffer, capacity);
  encoder.begin(kBroadcast, instruction);
  encoder.u16(address);
  encoder.u16(length);
  encoder.bytes(ids, count);
  return encoder.finish();
}

void begin_sync_write(Encoder& encoder, std::uint16_t address, std::uint16_t length) {
  encoder.begin(kBroadcast, Instruction::kSyncWrite);
  encoder.u16(address);
  encoder.u16(length);
}

void begin_bulk(Encoder& encoder, Instruction instruction) {
  encoder.begin(kBroadcast, instruction);
}

void bulk_entry(Encoder& encoder, std::uint8_t id, std::uint16_t address, std::uint16_t length) {
  encoder.u8(id);
  encoder.u16(address);
  encoder.u16(length);
}

std::size_t encode_status(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                          std::uint8_t error, const std::uint8_t* data, std::size_t size) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, Instruction::kStatus);
  encoder.u8(error);
  encoder.bytes(data, size);
  return encoder.finish();
}

std::size_t encode_fast_block(std::uint8_t* buffer, bool first, std::size_t all_bytes,
                              std::uint8_t id, std::uint8_t error, const std::uint8_t* data,
                              std::size_t length, std::uint16_t& crc) {
  std::size_t size = 0;
  if (first) {
    for (std::uint8_t value : kHeader) buffer[size++] = value;
    buffer[size++] = kBroadcast;
    put_u16(buffer + size, static_cast<std::uint32_t>(1 + all_bytes));
    size += 2;
    buffer[size++] = static_cast<std::uint8_t>(Instruction::kStatus);
  }
  buffer[size++] = error;
  buffer[size++] = id;
  for (std::size_t i = 0; i < length; ++i) buffer[size++] = data[i];
  crc = crc16(buffer, size, crc);
  put_u16(buffer + size, crc);
  crc = crc16(buffer + size, kCrcBytes, crc);
  return size + kCrcBytes;
}

bool fast_block_at(const Packet& reply, std::size_t offset, std::size_t length, FastBlock& block) {
  if (!reply.is_fast_reply() || offset + length + kFastBlockBytes > reply.size) return false;
  const std::uint8_t* start = reply.parameters + offset;
  block = {start[0], start[1], start + 2};
  return true;
}

bool fast_block(const Packet& reply, std::size_t index, std::size_t length, FastBlock& block) {
  return fast_block_at(reply, index * (length + kFastBlockBytes), length, block);
}

}  // namespace verp::dxl
