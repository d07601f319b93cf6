#pragma once
#include "common/model/image.hpp"

namespace verp::control {

/// Angles of posture number `seed`, spread over each joint's range. `angle_rad` holds kMaxJoints.
void golden_posture(const Params& params, std::uint32_t seed, float* angle_rad);

/// Kinematics of that posture: the same bits on every core.
GoldenVector golden_vector(const Params& params, std::uint32_t seed);

/// Golden vectors that this core reproduces; kGoldenVectors if all is well.
int count_golden_matches(const ParamsImage& image);

}  // namespace verp::control
