#include "host/twin/can/realtime_server.hpp"

#include <algorithm>

namespace verp::can {

void RealtimeServer::hear(std::span<const ReceivedFrame> frames, std::uint64_t clock_us,
                          std::vector<CanFrame>& answer) {
  if (frames.empty()) return;
  if (!begun_) {
    begun_ = true;
    offset_us_ = frames.front().came_us - bus_.now_us();
    in_step_since_us_ = frames.front().came_us;
    bus_.set_real_time(true);
  }
  skip(clock_us);
  const std::uint64_t least_us = clock_us - std::min(clock_us, kMostBehind_us / 2);
  for (const ReceivedFrame& each : frames) {
    go_on(std::clamp(each.came_us, least_us, clock_us), answer);
    ++counters_.frames;
    if (!bus_.send(each.frame)) ++counters_.dropped;
  }
}

void RealtimeServer::turn(std::uint64_t clock_us, std::vector<CanFrame>& answer) {
  if (!begun_) return;
  skip(clock_us);
  go_on(clock_us, answer);
}

void RealtimeServer::skip(std::uint64_t clock_us) {
  const std::uint64_t behind_us = due_us(clock_us) - bus_.now_us();
  if (behind_us > kMostBehind_us) {
    offset_us_ += behind_us - kMostBehind_us;
    counters_.skipped_us += behind_us - kMostBehind_us;
    in_step_since_us_ = clock_us;
  } else if (clock_us > in_step_since_us_ + kKeepsUp_us) {
    kept_up_ = true;
  }
}

void RealtimeServer::go_on(std::uint64_t clock_us, std::vector<CanFrame>& answer) {
  const std::uint64_t until_us = due_us(clock_us);
  CanFrame frame;
  while (bus_.bring_until(until_us, frame)) answer.push_back(frame);
}

std::uint64_t RealtimeServer::due_us(std::uint64_t clock_us) const {
  return std::max(clock_us, offset_us_ + bus_.now_us()) - offset_us_;
}

void RealtimeServer::finished(std::uint64_t clock_us) {
  if (!begun_) return;
  const std::uint64_t late_us = due_us(clock_us) - bus_.now_us();
  counters_.late += late_us > kLate_us ? 1 : 0;
  counters_.worst_late_us = std::max(counters_.worst_late_us, late_us);
}

}  // namespace verp::can
