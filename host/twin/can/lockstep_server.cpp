#include "host/twin/can/lockstep_server.hpp"

#include <algorithm>
#include <utility>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/frame.hpp"
#include "common/protocol/canopen/robot_plan.hpp"

namespace verp::can {
namespace {

/// The twin's clock uses lower ids (firmware/app/operator_node.hpp).
bool is_of_controller_node(const CanFrame& frame) {
  namespace plan = canopen::plan;
  if (!canopen::is_canopen(frame)) return false;
  if (plan::is_to_controllers_sdo(frame.id) || plan::is_of_controllers_sdo(frame.id)) return true;
  const canopen::Connection at = canopen::connection_of(frame.id);
  if (at.node != canopen::plan::kControllerNode) return false;
  using canopen::Service;
  return at.service == Service::kTpdo || at.service == Service::kRpdo ||
         at.service == Service::kSdoRequest || at.service == Service::kSdoResponse;
}

bool may_be_of_controller(const CanFrame& frame) {
  if (!canopen::is_canopen(frame)) return false;
  const canopen::Connection on = canopen::connection_of(frame.id);
  switch (on.service) {
    case canopen::Service::kNmt:
    case canopen::Service::kSync:
    case canopen::Service::kRpdo:
    case canopen::Service::kSdoRequest:
      return true;
    default:  // the controller's own answers as a node
      return on.node == canopen::plan::kControllerNode;
  }
}

}  // namespace

LockstepServer::LockstepServer(const Params& params, VirtualCan& bus, LockstepHooks hooks)
    : LockstepSession(params), bus_(bus), hooks_(std::move(hooks)) {}

void LockstepServer::take(const CanFrame& frame, std::vector<CanFrame>& answer) {
  constexpr std::size_t kMostHeld = 4 * hal::kCanQueue;  // if a controller never asks
  lockstep::CanAdvance request;
  if (lockstep::take_message(frame, lockstep::kCanAdvanceId, request)) {
    return advance(request, answer);
  }
  std::uint8_t upright = 0;
  if (lockstep::take_message(frame, lockstep::kCanSetUprightId, upright) && upright == 1) {
    const bool done = hooks_.set_upright && hooks_.set_upright();
    answer.push_back(lockstep::can_message(lockstep::kCanSetUprightReplyId,
                                           static_cast<std::uint8_t>(done ? 0 : 1)));
    return;
  }
  if (hello_.take(frame)) return hello(hello_.hello, answer);
  if (is_of_controller_node(frame)) return;
  if (!lockstep::is_clock_frame(frame) && frames_.size() < kMostHeld) frames_.push_back(frame);
}

std::vector<CanFrame> LockstepServer::unannounced() {
  return greeted() ? std::vector<CanFrame>{} : std::exchange(frames_, {});
}

void LockstepServer::hello(const lockstep::Hello& hello, std::vector<CanFrame>& answer) {
  frames_.clear();
  const Meeting meeting = meet(hello, hooks_);
  if (meeting.begins) enclosed_.clear();
  answer.push_back(lockstep::can_message(lockstep::kCanHelloReplyId,
                                         lockstep::HelloReply{.verdict = meeting.verdict}));
}

bool LockstepServer::is_whole(const lockstep::CanAdvance& advance) const {
  std::uint16_t sum = 0;
  for (const CanFrame& each : frames_) {
    sum = static_cast<std::uint16_t>(sum + lockstep::sum_of(each));
  }
  return static_cast<std::uint8_t>(frames_.size()) == advance.sent && sum == advance.sent_sum;
}

bool LockstepServer::make_whole(const lockstep::CanAdvance& advance) {
  if (is_whole(advance)) return true;
  std::erase_if(frames_, [](const CanFrame& each) { return !may_be_of_controller(each); });
  return is_whole(advance);
}

// A SYNC ends the frames between two polls; by priority it may have overtaken goals.
bool LockstepServer::send_frames(bool whole) {
  std::stable_partition(frames_.begin(), frames_.end(), [](const CanFrame& each) {
    return each.extended || each.id != canopen::kSyncId;
  });
  bool begins = false;
  for (const CanFrame& each : std::exchange(frames_, {})) {
    if (VirtualCan::begins_tick(each)) {
      if (begins) continue;  // duplicated on its way
      if (hooks_.tick_ends && !hooks_.tick_ends()) return false;
      begins = true;
    }
    bus_.send(each);
    if (whole && hooks_.sent) hooks_.sent(each);
  }
  if (begins && hooks_.tick_begins) hooks_.tick_begins(bus_.tick());
  return true;
}

void LockstepServer::enclose(const CanFrame& frame) {
  constexpr std::size_t kMostEnclosed = 4;  // a client waits for its answer, or aborts
  if (enclosed_.size() == kMostEnclosed) enclosed_.pop_front();
  enclosed_.push_back(frame);
}

std::size_t LockstepServer::bring_enclosed(std::vector<CanFrame>& answer) {
  if (enclosed_.empty()) return 0;
  answer.push_back(enclosed_.front());
  enclosed_.pop_front();
  return lockstep::room_of(answer.back());
}

void LockstepServer::bring_burst(std::uint32_t timeout_us, std::size_t room) {
  CanFrame frame;
  if (!bus_.poll(frame, timeout_us)) return;
  room += lockstep::room_of(frame);
  last_.push_back(frame);
  for (const CanFrame* next = bus_.next_unread(); next != nullptr; next = bus_.next_unread()) {
    room += lockstep::room_of(*next);
    if (room > lockstep::kBurstRoom || last_.size() == lockstep::kMaxBurst) return;
    bus_.poll(frame, timeout_us);
    last_.push_back(frame);
  }
}

void LockstepServer::advance(const lockstep::CanAdvance& advance, std::vector<CanFrame>& answer) {
  lockstep::CanAdvanced status{.sequence = advance.sequence};
  if (!greeted()) {
    frames_.clear();
    status.flags_count = lockstep::kNotGreeted;
    answer.push_back(lockstep::can_message(lockstep::kCanAdvancedId, status));
    return;
  }
  if (asks_again(advance.sequence)) {
    // The controller sends a repeat alone, so other frames with it are not its own.
    frames_.clear();
    answer.insert(answer.end(), last_.begin(), last_.end());
    return;
  }
  const bool whole = make_whole(advance);
  if (!whole) {
    note_damage(hooks_);
    status.flags_count |= lockstep::kFrameDamaged;
  }
  last_.clear();
  stopped_ = stopped_ || !send_frames(whole);
  if (!stopped_) bring_burst(advance.timeout_us, bring_enclosed(answer));
  for (const CanFrame& each : last_) {
    status.burst_sum = static_cast<std::uint16_t>(status.burst_sum + lockstep::sum_of(each));
  }
  if (!stopped_ && hooks_.polled) hooks_.polled(last_, bus_.now_us());
  if (stopped_) status.flags_count |= lockstep::kStop;
  status.flags_count |= static_cast<std::uint8_t>(last_.size() << lockstep::kCanCountShift);
  status.now_low_us = static_cast<std::uint32_t>(bus_.now_us());
  last_.push_back(lockstep::can_message(lockstep::kCanAdvancedId, status));
  note_answer(advance.sequence);
  answer.insert(answer.end(), last_.begin(), last_.end());
}

}  // namespace verp::can
