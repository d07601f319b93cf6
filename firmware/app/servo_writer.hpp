#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/protocol/control_table.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/schedule.hpp"
#include "firmware/app/servo_ram.hpp"

namespace verp::app {

/// The tick's second half: what the core wants of the servos, as Sync Writes. These have no reply,
/// so a change of anything but goals is sent in kRepeats ticks, and every servo's state again in
/// its turn: one lost frame neither leaves a limp robot stiff nor a walking one with a slack joint.
/// Copied with its loop, so it holds no reference into it.
template <hal::FrameBus Bus>
class ServoWriter {
 public:
  explicit ServoWriter(const Params& params) : params_(params) {}

  /// What Goal PWM may be at most, of each joint: a servo refuses more.
  void set_full(const std::uint16_t (&full_pwm)[kMaxJoints]) {
    for (int j = 0; j < kMaxJoints; ++j) full_pwm_[j] = full_pwm[j];
  }
  /// Of that, in every mode; 1 to 100.
  void limit_torque(std::uint8_t percent) { most_percent_ = percent; }

  /// Strength and goals go out before torque, so that a servo never wakes up with old ones.
  /// `turn` is the joint whose turn it is.
  void send(BusMaster<Bus>& master, const Outputs& outputs, int turn) {
    if (params_.joint_count == 0) return;
    const std::uint32_t wanted = outputs.torque_enable & all_joints();
    const std::uint8_t strength = strength_in(outputs.mode);
    if (wanted != 0 && (watchdog_clears_ > 0 || torque_ == 0)) clear_watchdogs(master);
    if (wanted != torque_ || (wanted != 0 && strength != strength_)) repeats_ = kRepeats;
    if (wanted != 0) strength_ = strength;
    torque_ = wanted;
    const bool all = repeats_ > 0;
    first_ = all ? 0 : turn;
    last_ = all ? params_.joint_count - 1 : turn;
    if (all) --repeats_;
    if (!all && (returned_ != 0 || renewals_ > 0)) renew(master);
    if (wanted != 0) {
      send_strength(master);
      send_goals(master, outputs);
    }
    send_torque(master);
    send_to(master, dxl::address::kBusWatchdog, bus_watchdog_);
  }

  /// A servo's Bus Watchdog trips when it hears nothing for so long.
  std::uint32_t patience_us() const { return bus_watchdog_ * dxl::kBusWatchdogUnit_us; }
  /// Some servo has, or may have, heard nothing for longer.
  void expect_tripped() { watchdog_clears_ = kRepeats; }

  /// A servo that was silent for so long may have lost its power: it gets no torque any more (what
  /// it holds, it keeps) until it has answered and been given its gains and profile again. Three
  /// ticks of 10 ms: a bad line seldom takes as many in a row.
  static constexpr std::uint32_t kDoubt_us = 30'000;
  void doubt(int joint) {
    doubted_ |= 1u << joint;
    returned_ &= ~(1u << joint);
  }
  /// It answered.
  void heard(int joint) { returned_ |= doubted_ & 1u << joint; }

 private:
  static constexpr std::uint8_t kRepeats = 3;

  std::uint32_t all_joints() const {
    return params_.joint_count >= kMaxJoints ? ~0u : (1u << params_.joint_count) - 1;
  }

  // A few servos at a time and only when there is no more to say, as a tick has little room; each
  // as often as all that matters.
  void renew(BusMaster<Bus>& master) {
    if (renewals_ == 0) {
      batch_ = 0;
      std::size_t count = 0;
      for (int j = 0; j < params_.joint_count && count < kRenewedAtOnce; ++j) {
        if ((returned_ >> j & 1) == 0) continue;
        batch_ |= 1u << j;
        ++count;
      }
      renewals_ = kRepeats;
    }
    send_ram(master, dxl::address::kPositionDGain, &ServoRam::gains);
    send_ram(master, dxl::address::kProfileAcceleration, &ServoRam::motion);
    if (--renewals_ > 0) return;
    doubted_ &= ~(batch_ & returned_);
    returned_ &= ~batch_;
    if (returned_ == 0) repeats_ = kRepeats;
  }
  template <std::size_t bytes>
  void send_ram(BusMaster<Bus>& master, std::uint16_t address,
                std::uint8_t (ServoRam::*part)[bytes]) {
    dxl::Encoder encoder(master.frame(), master.capacity());
    dxl::begin_sync_write(encoder, address, bytes);
    for (int j = 0; j < params_.joint_count; ++j) {
      if ((batch_ >> j & 1) == 0) continue;
      encoder.u8(params_.joint[j].servo_id);
      const ServoRam ram(profile_of(params_, j));
      for (const std::uint8_t byte : ram.*part) encoder.u8(byte);
    }
    master.send(encoder.finish());
  }

  // On its way up a robot may lie against anything, a hand too: its servos push as hard as its
  // entity allows, and no harder.
  std::uint8_t strength_in(std::uint8_t mode) const {
    const bool rising = mode == static_cast<std::uint8_t>(safety::Mode::kRising);
    return rising && params_.rise_torque_percent < most_percent_ ? params_.rise_torque_percent
                                                                 : most_percent_;
  }

  // A servo whose watchdog has tripped takes no goals: cleared before them, and set again after.
  void clear_watchdogs(BusMaster<Bus>& master) {
    first_ = 0;
    last_ = params_.joint_count - 1;
    send_to(master, dxl::address::kBusWatchdog, 0);
    repeats_ = kRepeats;
    if (watchdog_clears_ > 0) --watchdog_clears_;
  }

  void send_goals(BusMaster<Bus>& master, const Outputs& outputs) {
    dxl::Encoder encoder(master.frame(), master.capacity());
    dxl::begin_sync_write(encoder, dxl::address::kGoalPosition, 4);
    for (int j = 0; j < params_.joint_count; ++j) {
      if ((torque_ >> j & 1) == 0) continue;
      encoder.u8(params_.joint[j].servo_id);
      encoder.u32(static_cast<std::uint32_t>(outputs.goal_count[j]));
    }
    master.send(encoder.finish());
  }

  void send_strength(BusMaster<Bus>& master) {
    dxl::Encoder encoder(master.frame(), master.capacity());
    dxl::begin_sync_write(encoder, dxl::address::kGoalPwm, 2);
    for (int j = first_; j <= last_; ++j) {
      const auto pwm = static_cast<std::uint16_t>(full_pwm_[j] * strength_ / 100);
      encoder.u8(params_.joint[j].servo_id);
      encoder.u8(static_cast<std::uint8_t>(pwm));
      encoder.u8(static_cast<std::uint8_t>(pwm >> 8));
    }
    master.send(encoder.finish());
  }

  // A doubted servo hears of no torque but its end.
  void send_torque(BusMaster<Bus>& master) {
    send_to(master, dxl::address::kTorqueEnable, 1, doubted_ & torque_);
  }

  // One register of the joints from first_ to last_ that are not left out: `value` where torque is
  // on, 0 elsewhere.
  void send_to(BusMaster<Bus>& master, std::uint16_t address, std::uint8_t value,
               std::uint32_t left_out = 0) {
    dxl::Encoder encoder(master.frame(), master.capacity());
    dxl::begin_sync_write(encoder, address, 1);
    int told = 0;
    for (int j = first_; j <= last_; ++j) {
      if ((left_out >> j & 1) != 0) continue;
      encoder.u8(params_.joint[j].servo_id);
      encoder.u8((torque_ >> j & 1) != 0 ? value : std::uint8_t{0});
      ++told;
    }
    if (told > 0) master.send(encoder.finish());
  }

  const Params& params_;
  std::uint16_t full_pwm_[kMaxJoints] = {};
  std::uint32_t torque_ = 0;   ///< as sent last
  std::uint8_t strength_ = 0;  ///< likewise, percent
  std::uint8_t most_percent_ = 100;
  std::uint8_t repeats_ = kRepeats;
  std::uint8_t watchdog_clears_ = 0;  ///< still to send
  std::uint8_t renewals_ = 0;         ///< likewise, of the gains and profiles of batch_
  std::uint32_t batch_ = 0;
  std::uint32_t doubted_ = 0;   ///< may have started anew
  std::uint32_t returned_ = 0;  ///< of these, those that answered since
  int first_ = 0;               ///< who is told
  int last_ = 0;
  const std::uint8_t bus_watchdog_ = bus_watchdog_units(params_);
};

}  // namespace verp::app
