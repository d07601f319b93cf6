#include "common/model/leg.hpp"

#include "common/model/counts.hpp"

namespace verp::model {

constinit const JointParams kRigid{};

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
