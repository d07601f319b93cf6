#pragma once
#include "common/io/io.hpp"
#include "common/model/params.hpp"

/// A leg's angles among all joints'. An empty slot's angle is 0, and nothing is written for it.
namespace verp::model {

inline bool has(const LegParams& leg, int slot) {
  return leg.joint[slot] != kNoJoint;
}

/// In an empty slot: a joint that never turns, weighs nothing and lies where its parent does.
const JointParams& joint_of(const Params& params, const LegParams& leg, int slot);

/// The joint that moves the foot.
inline std::uint8_t last_joint(const LegParams& leg) {
  return leg.joint[has(leg, kLegJoints - 1) ? kLegJoints - 1 : kLegJoints - 2];
}

/// One bit for each joint.
std::uint32_t joints_of(const LegParams& leg);

void read_leg(const LegParams& leg, const float* joint_rad, float* leg_rad);
void write_leg(const LegParams& leg, const float* leg_rad, float* joint_rad);

/// Angles by the encoders. False: not all are of this tick.
bool measure_leg(const Params& params, const LegParams& leg, const Inputs& inputs, float* leg_rad);

}  // namespace verp::model
