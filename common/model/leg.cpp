#include "common/model/leg.hpp"

#include "common/model/counts.hpp"

namespace verp::model {

constinit const JointParams kRigid{};

bool measure_leg(const Params& params, const LegParams& leg, const Inputs& inputs, float* leg_rad) {
  std::uint32_t fresh = 1;
  for (int k = 0; k < kLegJoints; ++k) {
    leg_rad[k] = 0.0F;
    if (!has(leg, k)) continue;
    const std::uint8_t j = leg.joint[k];
    fresh &= inputs.fresh >> j;
    leg_rad[k] = angle_of(params.joint[j], inputs.position_count[j]);
  }
  return fresh != 0;
}

}  // namespace verp::model
