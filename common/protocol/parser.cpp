#include "common/protocol/dynamixel2.hpp"

namespace verp::dxl {
namespace {

constexpr std::size_t kInstructionAt = 7;

}  // namespace

bool Parser::push(std::uint8_t byte) {
  drop(done_);
  done_ = 0;
  if (begin_ + size_ == kMaxPacket) make_room();
  buffer_[begin_ + size_++] = byte;
  ++steps_;
  return size_ >= need_ && next();
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
        search_on();
    }
  }
}

/// True if the bytes there match a header, as far as they go.
bool Parser::may_begin_at(std::size_t offset) const {
  const std::uint8_t* from = buffer_ + begin_ + offset;
  for (std::size_t i = 0; i < sizeof kHeader && offset + i < size_; ++i) {
    if (from[i] != kHeader[i]) return false;
  }
  return true;
}

Parser::Look Parser::look() {
  if (!may_begin_at(0)) return Look::kDrop;
  need_ = size_ + 1;
  if (size_ < kHeaderBytes) return Look::kMore;
  const std::uint8_t* from = buffer_ + begin_;
  const std::size_t length = get_u16(from + kLengthAt);
  const std::size_t end = kHeaderBytes + length;
  if (length < 1 + kCrcBytes || end > kMaxPacket) return Look::kDrop;
  need_ = end;
  if (size_ < end) return Look::kMore;
  steps_ += static_cast<std::uint32_t>(end);
  if (crc16(from, end - kCrcBytes) != get_u16(from + end - kCrcBytes)) {
    ++crc_errors_;
    return Look::kDrop;
  }
  decode(end);
  return Look::kPacket;
}

void Parser::search_on() {
  std::size_t offset = 1;
  while (offset < size_ && !may_begin_at(offset)) ++offset;
  noise_bytes_ += static_cast<std::uint32_t>(offset);
  steps_ += static_cast<std::uint32_t>(offset);
  drop(offset);
}

void Parser::drop(std::size_t count) {
  if (count == 0) return;
  need_ = 0;
  size_ -= count;
  begin_ = size_ == 0 ? 0 : begin_ + count;
}

/// begin_ is above 0: a packet at the front is complete when the buffer is full.
void Parser::make_room() {
  for (std::size_t i = 0; i < size_; ++i) buffer_[i] = buffer_[begin_ + i];
  begin_ = 0;
  steps_ += static_cast<std::uint32_t>(size_);
}

void Parser::decode(std::size_t end) {
  done_ = end;
  std::uint8_t* const from = buffer_ + begin_;
  packet_ = Packet{};
  packet_.id = from[4];
  packet_.instruction = static_cast<Instruction>(from[kInstructionAt]);
  packet_.parameters = from + kInstructionAt + 1;
  if (packet_.is_fast_reply()) {
    packet_.size = end - kInstructionAt - 1;
    return;
  }
  std::size_t to = kInstructionAt + 1;
  std::uint32_t last = from[kInstructionAt];
  for (std::size_t i = to; i < end - kCrcBytes; ++i) {
    last = (last << 8 | from[i]) & 0xFFFFFF;
    from[to++] = from[i];
    if (last == 0xFFFFFD) ++i;  // skips the stuffed FD
  }
  packet_.size = to - kInstructionAt - 1;
  if (packet_.is_status() && packet_.size > 0) {
    packet_.error = packet_.parameters[0];
    ++packet_.parameters;
    --packet_.size;
  }
}

}  // namespace verp::dxl
