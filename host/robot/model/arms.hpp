#pragma once
#include "common/model/params.hpp"
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// The joints that swing left_arm and right_arm fore and aft (the first of each with an axis along
/// y that has a servo), and by how much they have to, in the stand pose, to turn about the vertical
/// against the legs: Params::arm and arm_rad_per_m. Robots without two arms or two legs have none.
/// `params` has its joints and legs already.
void find_arms(const Entity& entity, Params& params);

}  // namespace verp::model
