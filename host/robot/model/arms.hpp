#pragma once
#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Sets Params::arm and arm_rad_per_m: the first servo joint about y in left_arm and right_arm, and
/// the factor that cancels the legs' angular momentum about the vertical in the stand pose. Needs
/// two arms and two legs. `params` already contains joints and legs.
void find_arms(const Entity& entity, Params& params);

}  // namespace verp::model
