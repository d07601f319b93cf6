#include "host/twin/bus/realtime_server.hpp"

#include <algorithm>

namespace verp::bus {

void RealtimeServer::begin(std::uint64_t clock_us) {
  begun_ = true;
  offset_us_ = clock_us - bus_.now_us();
  bus_.set_real_time(true);
}

void RealtimeServer::let_go(std::uint64_t clock_us) {
  bus_.begin_time();
  begin(clock_us);
}

std::size_t RealtimeServer::room() const {
  return kPort_bytes - std::min(kPort_bytes, bus_.unsent());
}

RealtimeServer::Counters RealtimeServer::counters() const {
  Counters counters = counters_;
  counters.lost = bus_.lost_requests();
  return counters;
}

void RealtimeServer::turn(std::uint64_t clock_us, std::span<const std::uint8_t> heard,
                          std::vector<std::uint8_t>& answer) {
  counters_.bytes += heard.size();
  if (!begun_ && heard.empty()) return;
  if (!begun_) begin(clock_us);
  const std::uint64_t behind_us = clock_us - offset_us_ - bus_.now_us();
  if (behind_us > kMostBehind_us) {
    offset_us_ += behind_us - kMostBehind_us;
    counters_.skipped_us += behind_us - kMostBehind_us;
  }
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
