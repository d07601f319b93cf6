#pragma once

namespace verp::math {

/// True if this file, and with it the core, was compiled with fused multiply-add, or for an
/// x87: `a * a - rounded_square` then keeps what rounding the product should have taken. Call with
/// a = 1 + 2^-13 and 1 + 2^-12: the answer is made of run-time values, in a file of its own, so
/// that no compiler knows it beforehand.
bool is_contracted(float a, float rounded_square);

}  // namespace verp::math
