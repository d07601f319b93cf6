#include "firmware/app/doubted_drives.hpp"

namespace verp::app {

void DoubtedDrives::silent_for(int slot, std::uint32_t time_us) {
  if (time_us < patience_us_) {
    silent_ &= ~node_bit(slot);
    return;
  }
  silent_ |= node_bit(slot);
  if (is_joint(slot)) doubted_ |= 1u << slot;
}

void DoubtedDrives::rebooted(int slot) {
  lost_ |= node_bit(slot);
  if (is_joint(slot)) doubted_ |= 1u << slot;
}

void DoubtedDrives::renewed(int slot) {
  lost_ &= ~node_bit(slot);
  silent_ &= ~node_bit(slot);
  if (is_joint(slot)) limp_ &= ~(1u << slot);
}

bool DoubtedDrives::counts(int joint, std::uint16_t statusword, bool torque) {
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

NodeMask DoubtedDrives::to_renew(bool torque, NodeMask present) const {
  const NodeMask joints = node_bit(kMaxJoints) - 1;
  return (lost_ | silent_) & present & (torque ? ~joints : ~NodeMask{0});
}

}  // namespace verp::app
