#pragma once
#include "common/base/fields.hpp"

namespace verp::math {

/// A vector as stored, hashed and put into images, without Eigen. For arithmetic see
/// common/math/linear.hpp.
struct Xyz {
  float x = 0;
  float y = 0;
  float z = 0;
  VERP_FIELDS(x, y, z)
};
VERP_PACKED(Xyz);

}  // namespace verp::math

namespace verp {
using math::Xyz;
}
