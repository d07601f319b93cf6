#pragma once
#include <cstdint>

#include "common/base/can_frame.hpp"
#include "firmware/app/can_nodes.hpp"

namespace verp::can {

/// Finds out whether somebody else plays a node of the twin's robot on the interface: the robot
/// itself, or another twin. Its answers beside ours would be the controller's Inputs.
///
/// It is given what others sent. The fifth heartbeat, TPDO or SDO answer of one node, as they are
/// on a robot's bus, is proof: of random frames three look like that now and then, five hardly ever
/// (tests/host/can/other_nodes_test.cpp).
class OtherNodes {
 public:
  explicit OtherNodes(const Params& params) : nodes_(params) {}

  void take(const CanFrame& frame);
  /// The first that was found; 0: none.
  std::uint8_t found() const { return found_; }

 private:
  static constexpr std::uint8_t kSigns = 5;

  app::CanNodes nodes_;
  std::uint8_t signs_[app::kCanNodes] = {};
  std::uint8_t found_ = 0;
};

}  // namespace verp::can
