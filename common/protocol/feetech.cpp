#include "common/protocol/feetech.hpp"

namespace verp::feetech {
namespace {

constexpr std::size_t kIdAt = 2, kLengthAt = 3, kCodeAt = 4, kParametersAt = 5;

}  // namespace

std::uint8_t checksum(const std::uint8_t* from_id, std::size_t size) {
  unsigned sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum += from_id[i];
  return static_cast<std::uint8_t>(~sum);
}

void Encoder::begin(std::uint8_t id, std::uint8_t code) {
  size_ = 0;
  fits_ = true;
  u8(kHeaderByte);
  u8(kHeaderByte);
  u8(id);
  u8(0);  // length, set by finish()
  u8(code);
}

void Encoder::u8(std::uint8_t value) {
  fits_ = fits_ && size_ + 1 < capacity_;
  if (fits_) buffer_[size_++] = value;
}

void Encoder::u16(std::uint32_t value) {
  u8(static_cast<std::uint8_t>(value));
  u8(static_cast<std::uint8_t>(value >> 8));
}

void Encoder::bytes(const std::uint8_t* data, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) u8(data[i]);
}

std::size_t Encoder::finish() {
  if (!fits_) return 0;
  buffer_[kLengthAt] = static_cast<std::uint8_t>(size_ + 1 - kHeaderBytes);
  buffer_[size_] = checksum(buffer_ + kIdAt, size_ - kIdAt);
  return size_ + 1;
}

std::size_t encode_ping(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, Instruction::kPing);
  return encoder.finish();
}

std::size_t encode_read(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                        std::uint8_t address, std::uint8_t length) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, Instruction::kRead);
  encoder.u8(address);
  encoder.u8(length);
  return encoder.finish();
}

std::size_t encode_write(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                         std::uint8_t address, const std::uint8_t* data, std::size_t size) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, Instruction::kWrite);
  encoder.u8(address);
  encoder.bytes(data, size);
  return encoder.finish();
}

std::size_t encode_sync_read(std::uint8_t* buffer, std::size_t capacity, std::uint8_t address,
                             std::uint8_t length, const std::uint8_t* ids, std::size_t count) {
  Encoder encoder(buffer, capacity);
  encoder.begin(kBroadcast, Instruction::kSyncRead);
  encoder.u8(address);
  encoder.u8(length);
  encoder.bytes(ids, count);
  return encoder.finish();
}

void begin_sync_write(Encoder& encoder, std::uint8_t address, std::uint8_t length) {
  encoder.begin(kBroadcast, Instruction::kSyncWrite);
  encoder.u8(address);
  encoder.u8(length);
}

std::size_t encode_status(std::uint8_t* buffer, std::size_t capacity, std::uint8_t id,
                          std::uint8_t status, const std::uint8_t* data, std::size_t size) {
  Encoder encoder(buffer, capacity);
  encoder.begin(id, status);
  encoder.bytes(data, size);
  return encoder.finish();
}

bool Packet::is(const std::uint8_t* bytes, std::size_t count) const {
  if (count != whole_size()) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (bytes[i] != whole[i]) return false;
  }
  return true;
}

bool Parser::push(std::uint8_t byte) {
  drop(done_);
  done_ = 0;
  buffer_[size_++] = byte;
  return next();
}

bool Parser::next() {
  drop(done_);
  done_ = 0;
  for (;;) {
    switch (look()) {
      case Look::kMore:
        return false;
      case Look::kPacket:
        return true;
      case Look::kDrop:
        ++noise_bytes_;
        drop(1);
    }
  }
}

// The last two FF in a row are the header, because no device has the id FF.
Parser::Look Parser::look() {
  for (std::size_t i = 0; i < kIdAt && i < size_; ++i) {
    if (buffer_[i] != kHeaderByte) return Look::kDrop;
  }
  if (size_ > kIdAt && buffer_[kIdAt] == kHeaderByte) return Look::kDrop;
  if (size_ < kHeaderBytes) return Look::kMore;
  const std::size_t end = kHeaderBytes + buffer_[kLengthAt];
  if (end < kInstructionBytes) return Look::kDrop;
  if (size_ < end) return Look::kMore;
  if (checksum(buffer_ + kIdAt, end - kIdAt - 1) != buffer_[end - 1]) {
    ++checksum_errors_;
    return Look::kDrop;
  }
  packet_ = {buffer_[kIdAt], buffer_[kCodeAt], buffer_ + kParametersAt, end - kInstructionBytes,
             buffer_};
  done_ = end;
  return Look::kPacket;
}

void Parser::drop(std::size_t count) {
  if (count == 0) return;
  size_ -= count;
  for (std::size_t i = 0; i < size_; ++i) buffer_[i] = buffer_[i + count];
}

}  // namespace verp::feetech
