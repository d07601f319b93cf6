#pragma once

/// Elementary functions in float32, by IEEE basic operations and square root only: the same bits on
/// every compiler, optimisation level and core (with toolchains/floating_point.cmake).
///
/// Total: no input is an error, and no NaN or infinity leaves. Angles are radians.
///
/// Worst errors, in units of the spacing of floats at the exact result. Measured by
/// `verp_exhaustive` over every float (atan2: 10^9 stratified pairs); its `--function NAME` repeats
/// any of them:
///
///     sin  0.917    cos  0.912    asin 0.871    acos 0.789    exp  0.906    atan2 1.646
///
/// Bounds that the tests enforce: 1, atan2 2. atan2 costs one division, asin and acos beyond 1/2
/// one and a square root; where both are wanted, sincos is cheaper than sin and cos; angles beyond
/// 64 rad take the long way.
namespace verp::math {

struct SinCos {
  float sin;
  float cos;
};

/// Any finite angle, however large, in [-1, 1]. NaN and infinities: sin 0, cos 1. sin(-0) is -0.
/// Odd and even bit for bit; sincos has the same bits as sin and cos.
SinCos sincos(float angle_rad);
float sin(float angle_rad);
float cos(float angle_rad);

/// Direction of (x, y) in [-kPi, kPi], with the quadrants, infinities and signed zeros of IEEE 754:
/// atan2(0, 0) is 0, atan2(0, -0) is kPi. Neither scale nor overflow matter. NaN in either gives 0.
float atan2(float y, float x);

/// Arguments beyond [-1, 1] are limited to it. NaN gives 0 for both. asin(-0) is -0.
float acos(float x);
float asin(float x);

/// e^x. Above 88.72283 kMaxFloat, below -103.9721 zero, subnormal in between as the bound says. NaN
/// gives 0.
float exp(float x);

}  // namespace verp::math
