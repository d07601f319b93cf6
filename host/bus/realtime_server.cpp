#include "host/bus/realtime_server.hpp"

#include <algorithm>

namespace verp::bus {

void RealtimeServer::begin(std::uint64_t clock_us) {
  begun_ = true;
  offset_us_ = clock_us - bus_.now_us();
  bus_.set_real_time(true);
}

void RealtimeServer::turn(std::uint64_t clock_us, std::span<const std::uint8_t> heard,
                          std::vector<std::uint8_t>& answer) {
  counters_.bytes += heard.size();
  for (std::size_t i = 0; i < heard.size() && !begun_; ++i) {
    if (line_.push(heard[i])) begin(clock_us);
  }
  if (!begun_) return;
  std::uint8_t piece[hal::kMaxFrame];
  const auto bring = [&] {
    for (std::size_t count = sizeof piece; count == sizeof piece;) {
      count = bus_.bring_until(clock_us - offset_us_, piece, sizeof piece);
      answer.insert(answer.end(), piece, piece + count);
    }
  };
  bring();
  while (!heard.empty()) {
    const std::size_t size = std::min(heard.size(), hal::kMaxFrame);
    bus_.send(heard.data(), size);
    heard = heard.subspan(size);
  }
  bring();
}

void RealtimeServer::finished(std::uint64_t clock_us) {
  if (!begun_) return;
  const std::uint64_t due_us = clock_us - offset_us_;
  const std::uint64_t late_us = due_us > bus_.now_us() ? due_us - bus_.now_us() : 0;
  counters_.late += late_us > kLate_us ? 1 : 0;
  counters_.worst_late_us = std::max(counters_.worst_late_us, late_us);
}

}  // namespace verp::bus
