#include "tests/hil/can_faults.hpp"

#include <utility>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/robot_plan.hpp"

namespace verp::test {
namespace {

constexpr std::uint32_t kMostBehind = 2;
constexpr std::uint64_t kMostBehind_us = 2000;  // also without a next frame

bool is_answer(const CanFrame& frame) {
  return canopen::is_canopen(frame) &&
         canopen::connection_of(frame.id).service == canopen::Service::kTpdo;
}

}  // namespace

void CanTrouble::decide() {
  decided_ = true;
  fate_ = Fate::kFine;
  if (chance(faults.lost)) {
    fate_ = Fate::kLost;
    ++damage_.lost;
  } else if (chance(faults.doubled)) {
    fate_ = Fate::kDoubled;
    ++damage_.doubled;
  } else if (chance(faults.overtaken)) {
    fate_ = Fate::kOvertaken;
    behind_ = static_cast<std::uint32_t>(1 + random_() % kMostBehind);
    ++damage_.overtaken;
  }
}

bool CanTrouble::inbound(const CanFrame& frame) {
  if (faults.down) {
    ++damage_.down;
    damage_.lost_answers += is_answer(frame) ? 1 : 0;
    return false;
  }
  if (faults.held_us > 0) {
    ++damage_.late;
    hold(frame, 0, faults.held_us, 0);
    return false;
  }
  if (!chance(faults.late)) return true;
  ++damage_.late;
  hold(frame, 0, 1 + random_() % faults.late_us, 0);
  return false;
}

bool CanTrouble::passes(const CanFrame& frame, std::uint8_t receiver) {
  if (!decided_) decide();
  if (fate_ == Fate::kOvertaken) {
    hold(frame, receiver, kMostBehind_us, behind_ + 1);  // the frame counts, too
    return false;
  }
  const bool missed = fate_ != Fate::kLost && chance(faults.missed);
  damage_.missed += missed ? 1 : 0;
  if (missed || fate_ == Fate::kLost) {
    if (receiver == 0 && is_answer(frame)) ++damage_.lost_answers;
    return false;
  }
  const bool again = fate_ != Fate::kDoubled && chance(faults.heard_twice);
  damage_.doubled += again ? 1 : 0;
  if (again || fate_ == Fate::kDoubled) hold(frame, receiver, 0);
  note_heard(frame, receiver);
  return receiver != 0 || inbound(frame);
}

void CanTrouble::note_heard(const CanFrame& frame, std::uint8_t receiver) {
  if (!canopen::is_canopen(frame)) return;
  const bool beats = frame.id == canopen::heartbeat_id(canopen::plan::kControllerNode);
  const bool orders = canopen::connection_of(frame.id).service == canopen::Service::kRpdo;
  if (beats || orders) ordered_us_[receiver] = now_us_;
}

void CanTrouble::passed(std::uint64_t now_us) {
  now_us_ = now_us;
  const bool a_frame = std::exchange(decided_, false);
  std::deque<Held> all = std::exchange(held_, {});
  std::deque<Held> still;
  for (Held& each : all) {
    const bool overtaken = a_frame && each.behind > 0 && --each.behind == 0;
    if (!overtaken && each.due_us > now_us) {
      still.push_back(each);
      continue;
    }
    if (each.receiver == 0 && faults.down) continue;
    note_heard(each.frame, each.receiver);
    bus_.bring(each.frame, each.receiver);
  }
  held_.insert(held_.begin(), still.begin(), still.end());
}

bool CanLine::send(const CanFrame& frame) {
  if (trouble.faults.down) {
    ++trouble.damage().down;
    return false;
  }
  return bus_.send(frame);
}

bool CanLine::poll(CanFrame& frame, std::uint32_t timeout_us) {
  return bus_.poll(frame, timeout_us);
}

}  // namespace verp::test
