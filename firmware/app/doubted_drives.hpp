#pragma once
#include <cstdint>

#include "common/protocol/canopen/cia402.hpp"
#include "firmware/app/can_nodes.hpp"
#include "firmware/app/joint_rules.hpp"

namespace verp::app {

/// Drives whose torque is not what they were told to have, and nodes that may have lost what they
/// were set up with: doubted_servos.hpp on CAN.
///
/// A drive that was silent for long, or has sent a boot-up message, is told of no more torque than
/// it has, and its position does not count, by which the core holds and lets the robot down as for
/// one that is gone. Its statusword tells what it is: one that holds torque as it was told to, and
/// follows its target, has kept all, and counts again. One that does not, for a fault, because it
/// has rebooted or because somebody gave it another mode of operation, is set up again once the
/// robot has been let go, and counts from then on. Sensors are set up at once.
class DoubtedDrives {
 public:
  explicit DoubtedDrives(const Params& params) : patience_us_(doubt_us(params)) {}

  /// Bit j: joint j's.
  std::uint32_t all() const { return doubted_; }
  /// Of these, those known to have no torque.
  std::uint32_t limp() const { return limp_; }

  /// It did not answer for so long.
  void silent_for(int slot, std::uint32_t time_us) {
    if (time_us < patience_us_) {
      silent_ &= ~node_bit(slot);
      return;
    }
    silent_ |= node_bit(slot);
    if (is_joint(slot)) doubted_ |= 1u << slot;
  }
  /// Those that are not waited for.
  NodeMask silent() const { return silent_; }

  /// Its boot-up message came, or half of it is set up.
  void rebooted(int slot) {
    lost_ |= node_bit(slot);
    if (is_joint(slot)) doubted_ |= 1u << slot;
  }
  /// It is set up and has been started.
  void renewed(int slot) {
    lost_ &= ~node_bit(slot);
    silent_ &= ~node_bit(slot);
    if (is_joint(slot)) limp_ &= ~(1u << slot);
  }

  /// A drive answered with this statusword. `torque`: it was told to have torque, and had the time
  /// to obey. True if its position counts.
  bool counts(int joint, std::uint16_t statusword, bool torque) {
    using canopen::cia402::State;
    const State state = canopen::cia402::state_of(statusword);
    const std::uint32_t bit = 1u << joint;
    const bool enabled = state == State::kOperationEnabled;
    const bool follows = enabled && (statusword & canopen::cia402::kFollowsCommand) != 0;
    const bool faulty = state == State::kFault || state == State::kFaultReactionActive;
    if (torque ? !follows && state != State::kQuickStopActive : faulty) {
      doubted_ |= bit;
      if (!enabled) limp_ |= bit;
      lost_ |= bit;
    } else if (torque || (lost_ & bit) == 0) {
      doubted_ &= ~bit;
      limp_ &= ~bit;
      lost_ &= ~NodeMask{bit};
    }
    return (doubted_ & bit) == 0;
  }

  /// Nodes to be set up again, in a tick in which the robot is to have `torque`, or not. One that
  /// is silent may only have missed its start.
  NodeMask to_renew(bool torque, NodeMask present) const {
    const NodeMask joints = node_bit(kMaxJoints) - 1;
    return (lost_ | silent_) & present & (torque ? ~joints : ~NodeMask{0});
  }

 private:
  const std::uint32_t patience_us_;
  std::uint32_t doubted_ = 0;
  std::uint32_t limp_ = 0;
  NodeMask lost_ = 0;  ///< to be set up again
  NodeMask silent_ = 0;
};

}  // namespace verp::app
