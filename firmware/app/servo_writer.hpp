#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/protocol/control_table.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/joint_rules.hpp"
#include "firmware/app/schedule.hpp"

namespace verp::app {

/// The core's outputs as Sync Writes. These have no reply, so every change except goals is sent in
/// kRepeats ticks, and each servo's state again in turn: one lost frame leaves no limp robot stiff
/// and no walking one with a slack joint. Strength is Goal PWM; a servo refuses more than
/// set_full()'s value. It is copied with its loop and holds no reference into it.
template <hal::FrameBus Bus>
class ServoWriter : public JointStrength {
 public:
  using JointStrength::JointStrength;

  /// Sends strength and goals in kRepeats ticks, torque in the last of these: whichever frame is
  /// lost, no servo gets torque with old goals, a wrong strength or a tripped Bus Watchdog. `turn`:
  /// the joint whose state is repeated; `doubted` servos are sent only torque off.
  void send(BusMaster<Bus>& master, const Outputs& outputs, int turn, std::uint32_t doubted) {
    if (params_.servo_count() == 0) return;
    const std::uint32_t wanted = outputs.torque_enable & all_joints(params_);
    const std::uint8_t strength = percent_in(outputs.mode);
    if (wanted != 0 && (watchdog_clears_ > 0 || torque_ == 0)) clear_watchdogs(master);
    if ((wanted & ~wanted_) != 0) {
      early_ = kRepeats - 1;
    } else if (early_ > 0) {
      --early_;
    }
    const std::uint32_t torque = early_ > 0 ? torque_ & wanted : wanted;
    if (torque != torque_ || wanted != wanted_ || (wanted != 0 && strength != strength_)) {
      repeats_ = kRepeats;
    }
    if (wanted != 0) strength_ = strength;
    torque_ = torque;
    wanted_ = wanted;
    told_all_ = repeats_ > 0;
    first_ = told_all_ ? 0 : turn;
    last_ = told_all_ ? params_.servo_count() - 1 : turn;
    if (told_all_) --repeats_;
    if (wanted != 0) {
      send_strength(master);
      send_goals(master, outputs);
    }
    send_to(master, dxl::address::kTorqueEnable, 1, doubted & torque_);
    send_to(master, dxl::address::kBusWatchdog, bus_watchdog_);
  }

  /// Silence after which a servo's Bus Watchdog trips.
  std::uint32_t patience_us() const { return bus_watchdog_ * dxl::kBusWatchdogUnit_us; }
  /// Every servo was sent torque often enough to have received it.
  bool has_torque() const { return torque_ != 0 && !told_all_; }
  /// The last tick wrote to all servos; otherwise the bus has room.
  bool told_all() const { return told_all_; }
  /// A servo may have received nothing for longer than patience_us().
  void expect_tripped() { watchdog_clears_ = kRepeats; }

 private:
  static constexpr std::uint8_t kRepeats = 3;

  // A servo with a tripped watchdog ignores goals: clear it before them, set it again after.
  void clear_watchdogs(BusMaster<Bus>& master) {
    first_ = 0;
    last_ = params_.servo_count() - 1;
    send_to(master, dxl::address::kBusWatchdog, 0);
    repeats_ = kRepeats;
    if (watchdog_clears_ > 0) --watchdog_clears_;
  }

  void send_goals(BusMaster<Bus>& master, const Outputs& outputs) {
    dxl::Encoder encoder(master.frame(), master.capacity());
    dxl::begin_sync_write(encoder, dxl::address::kGoalPosition, 4);
    for (int j = 0; j < params_.servo_count(); ++j) {
      if ((wanted_ >> j & 1) == 0) continue;
      encoder.u8(params_.joint[j].servo_id);
      encoder.u32(static_cast<std::uint32_t>(outputs.goal_count[j]));
    }
    master.send(encoder.finish());
  }

  void send_strength(BusMaster<Bus>& master) {
    dxl::Encoder encoder(master.frame(), master.capacity());
    dxl::begin_sync_write(encoder, dxl::address::kGoalPwm, 2);
    for (int j = first_; j <= last_; ++j) {
      const std::uint16_t pwm = strength_of(j, strength_);
      encoder.u8(params_.joint[j].servo_id);
      encoder.u8(static_cast<std::uint8_t>(pwm));
      encoder.u8(static_cast<std::uint8_t>(pwm >> 8));
    }
    master.send(encoder.finish());
  }

  // Writes a register of joints first_ to last_, except `left_out`: `value` where torque is on,
  // else 0.
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

  std::uint32_t torque_ = 0;   ///< last sent
  std::uint32_t wanted_ = 0;   ///< joints that get goals; torque_ follows
  std::uint8_t strength_ = 0;  ///< last sent, percent
  std::uint8_t early_ = 0;     ///< ticks before torque
  std::uint8_t repeats_ = kRepeats;
  std::uint8_t watchdog_clears_ = 0;
  bool told_all_ = false;
  int first_ = 0;
  int last_ = 0;
  const std::uint8_t bus_watchdog_ = bus_watchdog_units(params_);
};

}  // namespace verp::app
