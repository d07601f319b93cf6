#pragma once

namespace verp::math {

/// True if this file, and so the core, was compiled with fused multiply-add or for an x87: `a * a -
/// rounded_square` then keeps the part that rounding should have removed. Call with a = 1 + 2^-13
/// and rounded_square = 1 + 2^-12. The function has a file of its own so that no compiler can fold
/// the answer.
bool is_contracted(float a, float rounded_square);

}  // namespace verp::math
