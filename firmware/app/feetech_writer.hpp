#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "firmware/app/feetech_master.hpp"
#include "firmware/app/joint_rules.hpp"

namespace verp::app {

/// The core's outputs as Sync Writes, which have no reply. Torque, acceleration and goal of a servo
/// travel in one packet every tick: whichever packet is lost, no servo gets torque with an old
/// goal. Strength (Torque Limit) is sent in kRepeats ticks before torque and after each change, and
/// again in turn; so is torque off.
class FeetechWriter : public JointStrength {
 public:
  using JointStrength::JointStrength;

  /// `turn`: the joint whose strength is repeated. Nothing gives `doubted` servos torque.
  void send(FeetechMaster& master, const Outputs& outputs, int turn, std::uint32_t doubted);
  /// The last tick wrote to all servos; otherwise the bus has room.
  bool told_all() const { return told_all_; }
  /// Every servo was sent torque often enough to have received it.
  bool has_torque() const { return torque_ != 0 && !told_all_; }

 private:
  static constexpr std::uint8_t kRepeats = 3;

  void send_strength(FeetechMaster& master);
  void send_goals(FeetechMaster& master, const Outputs& outputs, std::uint32_t joints);
  void send_off(FeetechMaster& master);

  std::uint32_t torque_ = 0;   ///< joints that get goals
  std::uint32_t wanted_ = 0;   ///< torque_ follows
  std::uint8_t strength_ = 0;  ///< last sent, percent
  std::uint8_t early_ = 0;     ///< ticks before torque
  std::uint8_t repeats_ = kRepeats;
  bool told_all_ = false;
  int first_ = 0;
  int last_ = 0;
};

}  // namespace verp::app
