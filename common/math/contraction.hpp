#pragma once

namespace verp::math {

/// True if the core was compiled with fused multiply-add or for an x87: both keep what rounding the
/// product should remove. Call with a = 1 + 2^-13, rounded_square = 1 + 2^-12. In its own file, so
/// that no compiler folds it.
bool is_contracted(float a, float rounded_square);

}  // namespace verp::math
