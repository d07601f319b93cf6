#pragma once

/// Elementary functions in float32, by IEEE basic operations and square root only: the same bits on
/// every compiler, optimisation level and core (with toolchains/floating_point.cmake).
///
/// Total: no input is an error, and no NaN or infinity leaves. Angles are radians.
namespace verp::math {

struct SinCos {
  float sin;
  float cos;
};

/// Any finite angle. NaN and infinities: sin 0, cos 1. sin(-0) is -0.
SinCos sincos(float angle_rad);
float sin(float angle_rad);
float cos(float angle_rad);

/// Direction of (x, y) in [-kPi, kPi], with the quadrants, infinities and signed zeros of IEEE 754;
/// atan2(0, 0) is 0. NaN in either gives 0.
float atan2(float y, float x);

/// Arguments beyond [-1, 1] are limited to it; NaN gives acos 0, asin 0.
float acos(float x);
float asin(float x);

/// e^x. Beyond the range of float: kMaxFloat, or 0. NaN gives 0.
float exp(float x);

}  // namespace verp::math
