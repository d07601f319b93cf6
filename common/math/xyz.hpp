#pragma once
#include "common/base/fields.hpp"

namespace verp::math {

/// A vector as it is stored, hashed and put into images. Arithmetic is in Vec3
/// (common/math/linear.hpp); this header keeps Eigen out of plain data.
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
