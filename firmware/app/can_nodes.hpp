#pragma once
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/canopen/cob_id.hpp"

namespace verp::app {

/// Slots of a robot's nodes: joints by index, then IMU and feet. A set of slots is a mask.
inline constexpr int kImuNode = kMaxJoints;
inline constexpr int kFootNode = kImuNode + 1;
inline constexpr int kCanNodes = kFootNode + kFeet;
using NodeMask = std::uint64_t;

constexpr NodeMask node_bit(int slot) {
  return NodeMask{1} << slot;
}
constexpr bool is_joint(int slot) {
  return slot < kMaxJoints;
}
/// 0: no such node.
constexpr std::uint8_t node_id(const Params& params, int slot) {
  if (is_joint(slot)) return slot < params.servo_count() ? params.joint[slot].servo_id : 0;
  return slot == kImuNode ? params.imu.device_id : params.feet.device_id[slot - kFootNode];
}

class CanNodes {
 public:
  explicit CanNodes(const Params& params) {
    for (std::uint8_t& each : slot_) each = kNone;
    for (int slot = 0; slot < kCanNodes; ++slot) {
      const std::uint8_t id = node_id(params, slot);
      if (canopen::is_node(id)) slot_[id] = static_cast<std::uint8_t>(slot);
    }
  }
  /// -1: not the robot's.
  int slot_of(std::uint8_t node) const {
    const std::uint8_t slot = canopen::is_node(node) ? slot_[node] : kNone;
    return slot == kNone ? -1 : slot;
  }

 private:
  static constexpr std::uint8_t kNone = 0xFF;
  std::uint8_t slot_[canopen::kMaxNode + 1];
};

}  // namespace verp::app
