#pragma once
#include <cstdint>

#include "common/protocol/canopen/cia402.hpp"
#include "firmware/app/can_nodes.hpp"
#include "firmware/app/joint_rules.hpp"

namespace verp::app {

/// DoubtedServos (doubted_servos.hpp) for CAN: drives whose torque differs from the command, and
/// nodes that may have lost their set-up.
///
/// A drive is doubted after long silence or a boot-up message. It gets no more torque than it has,
/// and its position does not count, so the core holds and lowers the robot. If its statusword shows
/// that it holds torque as commanded and follows its target, it counts again. Otherwise (fault,
/// reboot, another mode of operation) it is set up again once the robot was released. Sensors are
/// set up again at once.
class DoubtedDrives {
 public:
  explicit DoubtedDrives(const Params& params) : patience_us_(doubt_us(params)) {}

  /// Bit j: joint j's drive is doubted.
  std::uint32_t all() const { return doubted_; }
  /// Doubted drives known to have no torque.
  std::uint32_t limp() const { return limp_; }

  void silent_for(int slot, std::uint32_t time_us);
  NodeMask silent() const { return silent_; }

  /// The node rebooted, or is only partly set up.
  void rebooted(int slot);
  void renewed(int slot);

  /// `torque`: commanded long enough to be obeyed. True: the drive's position counts.
  bool counts(int joint, std::uint16_t statusword, bool torque);

  /// Nodes to set up again, with or without `torque` wanted. A silent node may have missed its
  /// start.
  NodeMask to_renew(bool torque, NodeMask present) const;

 private:
  const std::uint32_t patience_us_;
  std::uint32_t doubted_ = 0;
  std::uint32_t limp_ = 0;
  NodeMask lost_ = 0;
  NodeMask silent_ = 0;
};

}  // namespace verp::app
