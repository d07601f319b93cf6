#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/protocol/canopen/emcy.hpp"
#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/sync.hpp"
#include "firmware/app/answer_watch.hpp"
#include "firmware/app/can_master.hpp"
#include "firmware/app/can_schedule.hpp"
#include "firmware/app/canopen_bring_up.hpp"
#include "firmware/app/doubted_drives.hpp"
#include "firmware/app/drive_efforts.hpp"
#include "firmware/app/drive_telemetry.hpp"
#include "firmware/app/drive_writer.hpp"
#include "firmware/app/node_renewal.hpp"
#include "firmware/app/sensed_counts.hpp"
#include "firmware/app/sync_repair.hpp"
#include "firmware/app/sync_round.hpp"

/// The ServoBinding (contracts.hpp) for CANopen and CiA 402: drives, IMU and feet on one CanBus
/// (common/protocol/canopen/robot_plan.hpp).
namespace verp::app {

template <hal::CanBus Bus>
class CanopenServos {
 public:
  CanopenServos(const Params& params, Bus& bus)
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

  BringUpReport bring_up() {
    const BringUpReport report = CanopenBringUp<Bus>(params_, master_).run();
    writer_.set_full(report.full_strength);
    telemetry_.set_foreign(report.foreign_drives);
    return report;
  }
  void limit_torque(std::uint8_t percent) { writer_.limit_torque(percent); }

  /// Runs all SYNCs of the tick; keeps the sensors' answers for read_sensors().
  void read_positions(Inputs& inputs) {
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
    count_silence();
  }
  std::uint64_t now_us() const { return began_us_; }
  /// Drives report a missing heartbeat in their statusword.
  void heard_nothing_for(std::uint64_t) {}

  void read_sensors(Inputs& inputs, bool imu) {
    telemetry_.put(inputs);
    sensed_.put(inputs, imu, present_);
  }

  void send(const Outputs& outputs) {
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

  const BusCounters& counters() const { return master_.counters; }
  std::uint32_t damaged() const { return master_.errors().errors; }
  std::uint32_t noise() const {
    const hal::CanErrors errors = master_.errors();
    return errors.overruns + errors.dropped;
  }
  const JointEffort* efforts() const { return efforts_.efforts(); }

 private:
  static constexpr int kMostWaiting = 64;   ///< frames before a tick; bounds a flooded bus
  static constexpr int kMostInWindow = 64;  ///< after each SYNC
  /// SDO requests in a tick; each may extend a window for a silent node.
  static constexpr std::uint8_t kHurries = 3;
  static constexpr std::uint8_t kProbeTicks = 8;       ///< ticks between waits for silent nodes
  static constexpr std::uint16_t kLongSilence = 5000;  ///< ticks; the count stops here
  static_assert(most_sent(kMaxJoints) <= hal::kCanQueue);

  // Drops stale frames: those after the last tick. Waiting frames cost no time; those
  // that arrive while ours wait for the wire do.
  void forget_stale(Inputs& inputs) {
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

  // A flooded bus delays the SYNC and so its timeout: frames of this tick may use up the time of
  // all SYNCs, no more. True if none came although there was room.
  bool listen(Inputs& inputs) {
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

  void take(const CanFrame& frame, Inputs& inputs) {
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

  // False: not an answer to this tick's SYNCs.
  bool take_answer(const CanFrame& frame, int slot, unsigned number, Inputs& inputs) {
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
  void take_drive(const CanFrame& frame, int joint, Answer worth, Inputs& inputs) {
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
  bool take_response(const CanFrame& frame, int slot) {
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
  void take_emergency(const CanFrame& frame, int slot) {
    canopen::Emergency emergency;
    if (!canopen::decode_emcy(frame, emergency) || emergency.code == 0) return;
    ++master_.counters.errors;
    if (is_joint(slot)) telemetry_.hurry(slot);
  }
  void take_heartbeat(const CanFrame& frame, int slot) {
    std::uint8_t node = 0;
    canopen::NmtState state{};
    if (!canopen::decode_heartbeat(frame, node, state)) return;
    if (state != canopen::NmtState::kInitialising) return;
    renewal_.rebooted(slot);
    repair_.cancel(slot);
    doubts_.rebooted(slot);
  }
  /// Undoubted nodes that answer another SYNC.
  NodeMask astray() const {
    NodeMask mask = answers_.astray() & answers_.answered();
    if ((mask & node_bit(AnswerWatch::kImuSecond)) != 0) mask |= node_bit(kImuNode);
    return mask & ~doubts_.silent() & ~NodeMask{doubts_.all()} & present_;
  }

  void renew() {
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

  // The IMU is as silent as the worse of its two frames.
  void count_silence() {
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

  const Params& params_;
  CanNodes nodes_;
  CanMaster<Bus> master_;
  const std::uint8_t groups_;
  SyncRound round_{groups_};
  canopen::HeartbeatProducer heartbeat_{canopen::plan::kControllerNode};
  AnswerWatch answers_;
  DriveWriter<Bus> writer_{params_};
  DoubtedDrives doubts_{params_};
  NodeRenewal renewal_{params_};
  DriveTelemetry telemetry_{params_};
  DriveEfforts efforts_{params_};
  SyncRepair repair_{params_};
  SensedCounts sensed_;
  NodeMask present_ = 0;
  NodeMask given_up_ = 0;
  std::uint16_t silent_ticks_[AnswerWatch::kSources] = {};
  std::uint64_t began_us_ = 0;
  std::uint32_t heard_us_ = 0;
  std::uint32_t patience_us_ = 0;  ///< limit for all SYNCs of a tick
  std::uint8_t window_ = 0;        ///< last SYNC sent; 0: none
  std::uint8_t probe_ = 0;
  std::uint8_t hurries_ = 0;
  bool torque_ = false;
};

}  // namespace verp::app
