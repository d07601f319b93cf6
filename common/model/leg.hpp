#pragma once
#include "common/io/io.hpp"
#include "common/model/params.hpp"

/// A leg's angles among all joints'. An empty slot's angle is 0, and nothing is written for it.
namespace verp::model {

inline bool has(const LegParams& leg, int slot) {
  return leg.joint[slot] != kNoJoint;
}

extern const JointParams kRigid;  ///< its axis is 0, and so are its limits

/// In an empty slot: a joint that never turns, weighs nothing and lies where its parent does.
inline const JointParams& joint_of(const Params& params, const LegParams& leg, int slot) {
  return has(leg, slot) ? params.joint[leg.joint[slot]] : kRigid;
}

/// The joint that moves the foot.
inline std::uint8_t last_joint(const LegParams& leg) {
  return leg.joint[has(leg, kLegJoints - 1) ? kLegJoints - 1 : kLegJoints - 2];
}

/// One bit for each joint.
inline std::uint32_t joints_of(const LegParams& leg) {
  std::uint32_t joints = 0;
  for (int k = 0; k < kLegJoints; ++k) {
    if (has(leg, k)) joints |= std::uint32_t{1} << leg.joint[k];
  }
  return joints;
}

inline void read_leg(const LegParams& leg, const float* joint_rad, float* leg_rad) {
  for (int k = 0; k < kLegJoints; ++k) leg_rad[k] = has(leg, k) ? joint_rad[leg.joint[k]] : 0.0F;
}
inline void write_leg(const LegParams& leg, const float* leg_rad, float* joint_rad) {
  for (int k = 0; k < kLegJoints; ++k) {
    if (has(leg, k)) joint_rad[leg.joint[k]] = leg_rad[k];
  }
}

/// Angles by the encoders. False: not all are of this tick.
bool measure_leg(const Params& params, const LegParams& leg, const Inputs& inputs, float* leg_rad);

}  // namespace verp::model
