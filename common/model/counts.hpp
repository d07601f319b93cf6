#pragma once
#include "common/math/convert.hpp"
#include "common/model/params.hpp"

namespace verp::model {

/// 0 for a joint without a scale.
inline float angle_of(const JointParams& joint, std::int32_t count) {
  if (joint.counts_per_rad == 0.0F) return 0.0F;
  return (math::to_float(count) - joint.zero_count) / joint.counts_per_rad;
}

/// Rounds and saturates; NaN gives 0.
inline std::int32_t count_of(const JointParams& joint, float angle_rad) {
  return math::to_int32(joint.zero_count + joint.counts_per_rad * angle_rad);
}

}  // namespace verp::model
