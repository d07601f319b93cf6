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
/// set_full()'s value.
class ServoWriter : public JointStrength {
 public:
  using JointStrength::JointStrength;

  /// Sends strength and goals in kRepeats ticks, torque in the last of these: whichever frame is
  /// lost, no servo gets torque with old goals, a wrong strength or a tripped Bus Watchdog. `turn`:
  /// the joint whose state is repeated; `doubted` servos are sent only torque off.
  void send(BusMaster& master, const Outputs& outputs, int turn, std::uint32_t doubted);

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
  void clear_watchdogs(BusMaster& master);
  void send_goals(BusMaster& master, const Outputs& outputs);
  void send_strength(BusMaster& master);

  // Writes a register of joints first_ to last_, except `left_out`: `value` where torque is on,
  // else 0.
  void send_to(BusMaster& master, std::uint16_t address, std::uint8_t value,
               std::uint32_t left_out = 0);

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
