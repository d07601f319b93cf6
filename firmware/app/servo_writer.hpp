#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/protocol/control_table.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/schedule.hpp"

namespace verp::app {

/// The tick's second half: what the core wants of the servos, as Sync Writes. These have no reply,
/// so a change of anything but goals is sent in kRepeats ticks, and every servo's state again in
/// its turn: one lost frame neither leaves a limp robot stiff nor a walking one with a slack joint.
template <hal::FrameBus Bus>
class ServoWriter {
 public:
  ServoWriter(const Params& params, BusMaster<Bus>& master) : params_(params), master_(master) {}

  /// Strength and goals go out before torque, so that a servo never wakes up with old ones.
  /// `turn` is the joint whose turn it is.
  void send(const Outputs& outputs, int turn) {
    if (params_.joint_count == 0) return;
    const std::uint32_t wanted = outputs.torque_enable & all_joints();
    const std::uint16_t strength = strength_in(outputs.mode);
    if (wanted != 0 && (watchdog_clears_ > 0 || torque_ == 0)) clear_watchdogs();
    if (wanted != torque_ || (wanted != 0 && strength != strength_)) repeats_ = kRepeats;
    if (wanted != 0) strength_ = strength;
    torque_ = wanted;
    first_ = repeats_ > 0 ? 0 : turn;
    last_ = repeats_ > 0 ? params_.joint_count - 1 : turn;
    if (repeats_ > 0) --repeats_;
    if (wanted != 0) {
      send_to(dxl::address::kGoalPwm, 2, strength);
      send_goals(outputs);
    }
    send_to(dxl::address::kTorqueEnable, 1, 1);
    send_to(dxl::address::kBusWatchdog, 1, bus_watchdog_);
  }

  /// A servo's Bus Watchdog trips when it hears nothing for so long.
  std::uint32_t patience_us() const { return bus_watchdog_ * dxl::kBusWatchdogUnit_us; }
  /// Some servo has, or may have, heard nothing for longer.
  void expect_tripped() { watchdog_clears_ = kRepeats; }

 private:
  static constexpr std::uint8_t kRepeats = 3;

  std::uint32_t all_joints() const {
    return params_.joint_count >= kMaxJoints ? ~0u : (1u << params_.joint_count) - 1;
  }

  // On its way up a robot may lie against anything, a hand too: its servos push as hard as its
  // entity allows, and no harder.
  std::uint16_t strength_in(std::uint8_t mode) const {
    const bool rising = mode == static_cast<std::uint8_t>(safety::Mode::kRising);
    return static_cast<std::uint16_t>(rising ? dxl::kFullPwm * params_.rise_torque_percent / 100
                                             : dxl::kFullPwm);
  }

  // A servo whose watchdog has tripped takes no goals: cleared before them, and set again after.
  void clear_watchdogs() {
    first_ = 0;
    last_ = params_.joint_count - 1;
    send_to(dxl::address::kBusWatchdog, 1, 0);
    repeats_ = kRepeats;
    if (watchdog_clears_ > 0) --watchdog_clears_;
  }

  void send_goals(const Outputs& outputs) {
    dxl::Encoder encoder(master_.frame(), master_.capacity());
    dxl::begin_sync_write(encoder, dxl::address::kGoalPosition, 4);
    for (int j = 0; j < params_.joint_count; ++j) {
      if ((torque_ >> j & 1) == 0) continue;
      encoder.u8(params_.joint[j].servo_id);
      encoder.u32(static_cast<std::uint32_t>(outputs.goal_count[j]));
    }
    master_.send(encoder.finish());
  }

  // One register of the joints from first_ to last_: `value` where torque is on, 0 elsewhere.
  void send_to(std::uint16_t address, std::uint16_t bytes, std::uint16_t value) {
    dxl::Encoder encoder(master_.frame(), master_.capacity());
    dxl::begin_sync_write(encoder, address, bytes);
    for (int j = first_; j <= last_; ++j) {
      const std::uint16_t here = (torque_ >> j & 1) != 0 ? value : std::uint16_t{0};
      encoder.u8(params_.joint[j].servo_id);
      encoder.u8(static_cast<std::uint8_t>(here));
      if (bytes == 2) encoder.u8(static_cast<std::uint8_t>(here >> 8));
    }
    master_.send(encoder.finish());
  }

  const Params& params_;
  BusMaster<Bus>& master_;
  std::uint32_t torque_ = 0;    ///< as sent last
  std::uint16_t strength_ = 0;  ///< likewise
  std::uint8_t repeats_ = kRepeats;
  std::uint8_t watchdog_clears_ = 0;  ///< still to send
  int first_ = 0;                     ///< who is told
  int last_ = 0;
  const std::uint8_t bus_watchdog_ = bus_watchdog_units(params_);
};

}  // namespace verp::app
