#pragma once
#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Sets Params::arm and arm_rad_per_m: the first joint with a servo and an axis along y in left_arm
/// and right_arm, and the factor with which it cancels, in the stand pose, the legs' angular
/// momentum about the vertical. Robots without two arms and two legs get neither. `params` must
/// already contain joints and legs.
void find_arms(const Entity& entity, Params& params);

}  // namespace verp::model
