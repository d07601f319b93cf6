#include "firmware/app/canopen_servos.hpp"

namespace verp::app {

CanopenServos::CanopenServos(const Params& params, hal::CanBus& bus)
    : params_(params), nodes_(params), master_(bus), groups_(canopen::plan::sync_groups(params)) {
  for (int slot = 0; slot < kCanNodes; ++slot) {
    if (!canopen::is_node(node_id(params, slot))) continue;
    present_ |= node_bit(slot);
    answers_.plan(slot, is_joint(slot) ? canopen::plan::group_of_joint(slot) : groups_);
  }
  if ((present_ & node_bit(kImuNode)) != 0) answers_.plan(AnswerWatch::kImuSecond, groups_);
  for (std::uint8_t group = 1; group <= groups_; ++group) {
    patience_us_ += window_us(params, group);
  }
  heartbeat_.set_period_ms(canopen::plan::heartbeat_ms(params));
}

BringUpReport CanopenServos::bring_up() {
  const BringUpReport report = app::bring_up(params_, master_);
  writer_.set_full(report.full_strength);
  telemetry_.set_foreign(report.foreign_drives);
  return report;
}

void CanopenServos::read_positions(Inputs& inputs) {
  answers_.begin();
  if (params_.servo_count() == 0) answers_.prompt();  // no drive could show it
  forget_stale(inputs);
  sensed_.begin();
  hurries_ = kHurries;
  began_us_ = 0;
  round_.begin();
  for (window_ = 1; window_ <= groups_;) {
    master_.send(canopen::sync_frame(window_));
    const bool quiet = listen(inputs);
    if (began_us_ == 0) began_us_ = master_.now_us();
    window_ = round_.after(window_, answers_, quiet);
  }
  judge_boots();
  count_silence();
}

void CanopenServos::read_sensors(Inputs& inputs, bool imu) {
  telemetry_.put(inputs);
  sensed_.put(inputs, imu, present_);
}

void CanopenServos::send(const Outputs& outputs) {
  writer_.send(master_, outputs, doubts_.all(), doubts_.limp());
  torque_ = outputs.torque_enable != 0;
  const bool stopped = renewal_.stop_one(master_);  // instead of a telemetry request
  renew();
  CanFrame frame;
  bool missed = false;
  NodeMask busy = renewal_.slot() < 0 ? 0 : node_bit(renewal_.slot());
  if (busy == 0) repair_.run(master_, astray());
  if (repair_.slot() >= 0) busy |= node_bit(repair_.slot());
  if (!answers_.all_owe()) busy |= doubts_.silent();  // else any node's answer is useful
  if (!stopped && telemetry_.next(frame, busy, missed)) master_.send(frame);
  if (missed) ++master_.counters.timeouts;
  // One of heartbeat and effort request, so that a tick's frames find room.
  const bool beat = heartbeat_.next(master_.now_us(), canopen::NmtState::kOperational, frame);
  if (beat || efforts_.next(frame, busy | telemetry_.asked())) master_.send(frame);
}

std::uint32_t CanopenServos::noise() const {
  const hal::CanErrors errors = master_.errors();
  return errors.overruns + errors.dropped;
}

void CanopenServos::forget_stale(Inputs& inputs) {
  window_ = 0;
  CanFrame frame;
  const std::uint64_t since_us = master_.now_us();
  heard_us_ = 0;
  for (int i = 0; i < kMostWaiting && heard_us_ <= patience_us_ / 2; ++i) {
    if (!master_.take_waiting(frame)) break;
    take(frame, inputs);
    heard_us_ = static_cast<std::uint32_t>(master_.now_us() - since_us);
  }
}

bool CanopenServos::listen(Inputs& inputs) {
  const std::uint32_t timeout = window_us(params_, window_);
  const std::uint32_t over_us = heard_us_ + timeout;
  CanFrame frame;
  for (int i = 0; i < kMostInWindow && answers_.due(window_, given_up_) != 0; ++i) {
    const bool patient = heard_us_ < patience_us_;
    if (!patient || !master_.receive(frame, timeout)) {
      const bool quiet = patient && heard_us_ + kReactionUs <= over_us;
      ++master_.counters.timeouts;
      if (heard_us_ < over_us) heard_us_ = over_us;
      return quiet;
    }
    take(frame, inputs);
    heard_us_ += can_frames_us(frame.size, 1, params_.baud);
  }
  return false;
}

void CanopenServos::take(const CanFrame& frame, Inputs& inputs) {
  using canopen::Service;
  const canopen::Connection from =
      canopen::is_canopen(frame) ? canopen::connection_of(frame.id) : canopen::Connection{};
  const int slot = nodes_.slot_of(from.node);
  bool wanted = slot >= 0;
  if (wanted && from.service == Service::kTpdo) {
    wanted = take_answer(frame, slot, from.number, inputs);
  } else if (wanted && from.service == Service::kSdoResponse) {
    wanted = take_response(frame, slot);
  } else if (wanted && from.service == Service::kEmcy) {
    take_emergency(frame, slot);
  } else if (wanted && from.service == Service::kHeartbeat) {
    take_heartbeat(frame, slot);
  } else {
    wanted = false;
  }
  if (!wanted) ++master_.counters.strays;
}

bool CanopenServos::take_answer(const CanFrame& frame, int slot, unsigned number, Inputs& inputs) {
  const bool second = slot == kImuNode && number == 2;
  if (number != 1 && !second) return false;
  const std::uint8_t least = is_joint(slot)     ? canopen::plan::kDriveAnswerBytes
                             : slot == kImuNode ? canopen::plan::kImuAnswerBytes
                                                : canopen::plan::kFootAnswerBytes;
  if (frame.size < least) return false;
  const int source = second ? AnswerWatch::kImuSecond : slot;
  if (window_ == 0) {
    answers_.take_late(source, groups_);
    return false;
  }
  silent_ticks_[source] = 0;
  const Answer worth = answers_.take(source, window_);
  if (is_joint(slot)) take_drive(frame, slot, worth, inputs);
  if (!is_joint(slot) && !sensed_.take(frame, source, worth)) answers_.spoil(source);
  return worth == Answer::kFresh;
}

void CanopenServos::take_drive(const CanFrame& frame, int joint, Answer worth, Inputs& inputs) {
  const auto status = static_cast<std::uint16_t>(canopen::get_le(frame.data, 2));
  const canopen::cia402::State state = canopen::cia402::state_of(status);
  writer_.note(joint, state);
  const auto position = static_cast<std::int32_t>(canopen::get_le(frame.data + 2, 4));
  if (worth == Answer::kAgain && position != inputs.position_count[joint]) {
    answers_.spoil(joint);
    inputs.fresh &= ~(1u << joint);
  }
  const bool counts = doubts_.counts(joint, status, writer_.has_torque(joint));
  if (!counts || worth != Answer::kFresh) return;
  inputs.position_count[joint] = position;
  inputs.fresh |= 1u << joint;
}

bool CanopenServos::take_response(const CanFrame& frame, int slot) {
  if (slot == repair_.slot()) {
    if (!repair_.receive(master_, frame)) return true;
    answers_.restore(slot);
    if (slot == kImuNode) answers_.restore(AnswerWatch::kImuSecond);
  } else if (slot == renewal_.slot()) {
    renewal_.receive(frame, master_.now_us());
    if (torque_ || hurries_ == 0) return true;
    --hurries_;
    renewal_.proceed(master_);
  } else {
    if (!is_joint(slot)) return false;
    if (efforts_.receive(slot, frame)) return true;  // may be ticks old: no proof of a prompt bus
    if (!telemetry_.receive(slot, frame)) return false;
    if (window_ <= 1) answers_.prompt();
  }
  return true;
}

void CanopenServos::take_emergency(const CanFrame& frame, int slot) {
  canopen::Emergency emergency;
  if (!canopen::decode_emcy(frame, emergency) || emergency.code == 0) return;
  ++master_.counters.errors;
  if (is_joint(slot)) telemetry_.hurry(slot);
}

void CanopenServos::take_heartbeat(const CanFrame& frame, int slot) {
  std::uint8_t node = 0;
  canopen::NmtState state{};
  if (!canopen::decode_heartbeat(frame, node, state)) return;
  if (state != canopen::NmtState::kInitialising) return;
  if (is_joint(slot)) {
    booted_ |= node_bit(slot);
  } else {
    believe_boot(slot);
  }
}

void CanopenServos::believe_boot(int slot) {
  renewal_.rebooted(slot);
  repair_.cancel(slot);
  doubts_.rebooted(slot);
}

void CanopenServos::judge_boots() {
  const NodeMask answered = answers_.answered();
  for (int joint = 0; joint < kMaxJoints; ++joint) {
    if ((booted_before_ & ~answered & node_bit(joint)) != 0) believe_boot(joint);
  }
  booted_before_ = booted_;
  booted_ = 0;
}

NodeMask CanopenServos::astray() const {
  NodeMask mask = answers_.astray() & answers_.answered();
  if ((mask & node_bit(AnswerWatch::kImuSecond)) != 0) mask |= node_bit(kImuNode);
  return mask & ~doubts_.silent() & ~NodeMask{doubts_.all()} & present_;
}

void CanopenServos::renew() {
  const int renewed = renewal_.run(master_, doubts_.to_renew(torque_, present_));
  repair_.cancel(renewal_.slot());                              // answers belong to the renewal
  if (renewal_.slot() >= 0) doubts_.rebooted(renewal_.slot());  // a partial renewal is not enough
  if (renewed < 0) return;
  doubts_.renewed(renewed);
  silent_ticks_[renewed] = 0;
  answers_.restore(renewed);
  if (renewed == kImuNode) silent_ticks_[AnswerWatch::kImuSecond] = 0;
  if (renewed == kImuNode) answers_.restore(AnswerWatch::kImuSecond);
  given_up_ = 0;
}

void CanopenServos::count_silence() {
  const NodeMask answered = answers_.answered();
  for (int source = 0; source < AnswerWatch::kSources; ++source) {
    if ((answers_.planned() >> source & 1) == 0) continue;
    if ((answered >> source & 1) == 0 && silent_ticks_[source] < kLongSilence) {
      ++silent_ticks_[source];
    }
    const int slot = source == AnswerWatch::kImuSecond ? kImuNode : source;
    if (source == kImuNode) continue;
    std::uint32_t ticks = silent_ticks_[source];
    if (slot == kImuNode && silent_ticks_[kImuNode] > ticks) ticks = silent_ticks_[kImuNode];
    doubts_.silent_for(slot, ticks * params_.period_us);
  }
  probe_ = probe_ + 1 < kProbeTicks ? static_cast<std::uint8_t>(probe_ + 1) : std::uint8_t{0};
  given_up_ = doubts_.silent();
  if ((given_up_ & node_bit(kImuNode)) != 0) given_up_ |= node_bit(AnswerWatch::kImuSecond);
  if (probe_ == 0 || (answers_.planned() & ~given_up_) == 0) given_up_ = 0;
}

}  // namespace verp::app
