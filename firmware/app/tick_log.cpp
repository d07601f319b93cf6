#include "firmware/app/tick_log.hpp"

namespace verp::app {

void TickLog::keep(const TickRecord& record, const State& state) {
  if (hold_ == kAll) return;
  ring_[record.inputs.tick % kTicks] = record;
  any_ = true;
  if (hold_ != kNothing) return;
  last_.record = record;
  last_.state = state;
}

std::size_t TickLog::size(ImageKind kind) const {
  if (kind == ImageKind::kState) return hold_ != kNothing && any_ ? sizeof last_ : 0;
  if (kind == ImageKind::kTicks) return any_ ? sizeof ring_ : 0;
  return images_.size(kind);
}

void TickLog::read(ImageKind kind, std::size_t offset, std::uint8_t* to, std::size_t count) const {
  if (kind == ImageKind::kState) {
    __builtin_memcpy(to, reinterpret_cast<const std::uint8_t*>(&last_) + offset, count);
  } else if (kind == ImageKind::kTicks) {
    __builtin_memcpy(to, reinterpret_cast<const std::uint8_t*>(ring_) + offset, count);
  } else {
    images_.read(kind, offset, to, count);
  }
}

void TickLog::begin(ImageKind kind) {
  if (!is_log(kind)) images_.begin(kind);
}

Taken TickLog::write(ImageKind kind, std::size_t offset, const std::uint8_t* from,
                     std::size_t count) {
  return is_log(kind) ? Taken::kNo : images_.write(kind, offset, from, count);
}

std::uint8_t TickLog::commit(ImageKind kind, std::uint32_t crc) {
  return is_log(kind) ? kWrongWindowCrc : images_.commit(kind, crc);
}

bool TickLog::is_log(ImageKind kind) {
  return kind == ImageKind::kState || kind == ImageKind::kTicks;
}

}  // namespace verp::app
