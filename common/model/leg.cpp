#include "common/model/leg.hpp"

#include "common/model/counts.hpp"

namespace verp::model {
namespace {

constexpr JointParams kRigid{};  // its axis is 0, and so are its limits

}  // namespace

const JointParams& joint_of(const Params& params, const LegParams& leg, int slot) {
  return has(leg, slot) ? params.joint[leg.joint[slot]] : kRigid;
}

std::uint32_t joints_of(const LegParams& leg) {
  std::uint32_t joints = 0;
  for (int k = 0; k < kLegJoints; ++k) {
    if (has(leg, k)) joints |= std::uint32_t{1} << leg.joint[k];
  }
  return joints;
}

void read_leg(const LegParams& leg, const float* joint_rad, float* leg_rad) {
  for (int k = 0; k < kLegJoints; ++k) leg_rad[k] = has(leg, k) ? joint_rad[leg.joint[k]] : 0.0F;
}

void write_leg(const LegParams& leg, const float* leg_rad, float* joint_rad) {
  for (int k = 0; k < kLegJoints; ++k) {
    if (has(leg, k)) joint_rad[leg.joint[k]] = leg_rad[k];
  }
}

bool measure_leg(const Params& params, const LegParams& leg, const Inputs& inputs, float* leg_rad) {
  for (int k = 0; k < kLegJoints; ++k) {
    leg_rad[k] = has(leg, k)
                     ? angle_of(params.joint[leg.joint[k]], inputs.position_count[leg.joint[k]])
                     : 0.0F;
  }
  const std::uint32_t joints = joints_of(leg);
  return (inputs.fresh & joints) == joints;
}

}  // namespace verp::model
