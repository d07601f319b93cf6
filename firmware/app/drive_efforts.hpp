#pragma once
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo.hpp"
#include "firmware/app/can_nodes.hpp"
#include "firmware/app/joint_effort.hpp"

namespace verp::app {

/// Velocity (606Ch) and torque (6077h) of each drive, for observers: one SDO upload every
/// kEffortTicks ticks, first all velocities, then all torques. In TPDOs they would load the bus
/// beyond 70 % (21 drives at 125 Hz).
class DriveEfforts {
 public:
  explicit DriveEfforts(const Params& params) : params_(params) {}

  /// The next request; false: none is due. Skips drives in `busy`.
  bool next(CanFrame& frame, NodeMask busy);

  /// Takes an SDO response; false: not to the last request.
  bool receive(int joint, const CanFrame& frame);

  /// kMaxJoints elements.
  const JointEffort* efforts() const { return efforts_; }

 private:
  bool choose(NodeMask busy);
  canopen::Address object() const;
  void take(std::uint32_t value);

  const Params& params_;
  JointEffort efforts_[kMaxJoints];
  int joint_ = -1;
  std::uint8_t ticks_ = 0;
  bool torques_ = true;
  bool asked_ = false;
};

}  // namespace verp::app
