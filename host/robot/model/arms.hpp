#pragma once
#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Sets Params::arm and arm_rad_per_m. The joints are the first in left_arm and right_arm with an
/// axis along y and a servo. The factors make the arms, in the stand pose, cancel the legs' angular
/// momentum about the vertical. Robots without two arms and two legs have none. `params` must
/// already contain joints and legs.
void find_arms(const Entity& entity, Params& params);

}  // namespace verp::model
