#include "common/math/contraction.hpp"

namespace verp::math {

bool is_contracted(float a, float rounded_square) {
  return a * a - rounded_square != 0.0F;
}

}  // namespace verp::math
