#include "host/bus/shadow_loop.hpp"

#include <algorithm>
#include <utility>

namespace verp::bus {

ShadowLoop::ShadowLoop(const Params& params, Record record)
    : loop_(std::make_unique<Loop>(params, tape_, tape_, tape_)) {
  tape_.recorder = std::move(record);
}

ShadowLoop::~ShadowLoop() = default;

void ShadowLoop::sent(std::span<const std::uint8_t> frame) {
  next_.frames.emplace_back(frame.begin(), frame.end());
}

void ShadowLoop::damaged() {
  next_.comparable = false;
}

void ShadowLoop::ordered(const app::OperatorOrder& order) {
  next_.order = order;
}

void ShadowLoop::polled(std::span<const std::uint8_t> bytes, std::uint64_t now_us) {
  next_.bytes.assign(bytes.begin(), bytes.end());
  next_.now_us = now_us;
  tape_.polls.push_back(std::exchange(next_, {}));
}

void ShadowLoop::catch_up() {
  while (!tape_.polls.empty() && play()) {
    tape_.polls.erase(tape_.polls.begin(),
                      tape_.polls.begin() + static_cast<std::ptrdiff_t>(tape_.here.played));
    tape_.here.played = 0;
  }
}

// Where a tick ends can't be seen from its polls: after trouble, the next one begins with a poll
// that clears the line. So a tick is tried, and tried again once more is known.
bool ShadowLoop::play() {
  const Loop before(*loop_);
  const Tape::Mark mark = tape_.here;
  tape_.torn = false;
  if (tape_.ticking) {
    loop_->tick();
  } else {  // a controller tries to come up until it can
    const bool ready = loop_->bring_up().status == app::BringUpStatus::kReady;
    tape_.ticking = ready && !tape_.torn;
  }
  if (!tape_.torn) return true;
  loop_ = std::make_unique<Loop>(before);
  tape_.here = mark;
  return false;
}

bool ShadowLoop::Tape::send(const std::uint8_t* data, std::size_t size) {
  here.frames.emplace_back(data, data + size);
  return true;
}

std::size_t ShadowLoop::Tape::poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t) {
  torn = torn || here.played == polls.size();
  if (torn) return 0;
  const Poll& poll = polls[here.played++];
  if (difference.empty()) compare(poll);
  here.frames.clear();
  here.time_us = poll.now_us;
  if (poll.order) here.standing = *poll.order;
  const std::size_t count = std::min(capacity, poll.bytes.size());
  std::copy_n(poll.bytes.begin(), count, buffer);
  return count;
}

void ShadowLoop::Tape::compare(const Poll& poll) {
  const auto& frames = here.frames;
  if (!poll.comparable || poll.frames == frames) return;
  const std::string where =
      ticking ? "in tick " + std::to_string(tick) : std::string("in the bring-up");
  for (std::size_t i = 0; i < std::max(frames.size(), poll.frames.size()); ++i) {
    if (i < frames.size() && i < poll.frames.size() && frames[i] == poll.frames[i]) continue;
    difference = where + " the controller's frame " + std::to_string(i + 1) + " of " +
                 std::to_string(poll.frames.size()) + " is not the one this PC sends";
    return;
  }
}

app::OperatorOrder ShadowLoop::Tape::order(std::uint32_t) {
  const app::OperatorOrder order = here.standing;
  here.standing.flags = 0;
  return order;
}

void ShadowLoop::Tape::record(const TickRecord& record, const State& state,
                              const Outputs& outputs) {
  if (torn) return;
  tick = record.inputs.tick;
  if (recorder) recorder(record, state, outputs);
}

}  // namespace verp::bus
