#pragma once

/// float32 functions from IEEE basic operations and square root only: the same bits on every
/// compiler, optimisation level and core (toolchains/floating_point.cmake). Total: no result is NaN
/// or infinite. Angles are radians.
///
/// Worst errors in ulp over every float (atan2: 10^9 stratified pairs), by `verp_exhaustive
/// --function NAME`:
///
///     sin  0.917    cos  0.912    asin 0.871    acos 0.789    exp  0.906    atan2 1.646
///
/// The tests enforce 1 ulp, and 2 for atan2. Angles beyond 64 rad are slow.
namespace verp::math {

struct SinCos {
  float sin;
  float cos;
};

/// In [-1, 1] for any finite angle. NaN and infinities: sin 0, cos 1. sin(-0) is -0. sin is odd,
/// cos even; sincos has the same bits.
SinCos sincos(float angle_rad);
float sin(float angle_rad);
float cos(float angle_rad);

/// In [-kPi, kPi], with IEEE 754's quadrants, infinities and signed zeros: atan2(0, 0) is 0,
/// atan2(0, -0) is kPi. NaN gives 0.
float atan2(float y, float x);

/// Arguments are clamped to [-1, 1]; NaN gives 0; asin(-0) is -0.
float acos(float x);
float asin(float x);

/// kMaxFloat above 88.72283, zero below -103.9721; the bound holds for subnormals. NaN gives 0.
float exp(float x);

}  // namespace verp::math
