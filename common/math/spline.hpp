#pragma once

/// Curves by the parameter u in [0, 1]. In a segment of duration T, u = t / T and the speed is
/// derivative / T. The caller limits u.
namespace verp::math {

struct CurvePoint {
  float value;
  float derivative;  ///< d value / d u
  float second = 0;  ///< d^2 value / d u^2, if computed
};

/// Cubic from (0, p0) to (1, p1) with slopes m0 and m1. Both ends are exact.
constexpr CurvePoint hermite(float p0, float m0, float p1, float m1, float u) {
  const float rise = p1 - p0;
  const float a = m0 - rise;  // u (1-u) [a (1-u) - b u] is added to the chord
  const float b = m1 - rise;
  const float v = 1.0F - u;
  const float bump = a * v - b * u;
  const float chord = u < 0.5F ? p0 + u * rise : p1 - v * rise;
  return {chord + (u * v) * bump, rise + ((v - u) * bump - (u * v) * (a + b))};
}

/// Quintic from 0 to 1, velocity and acceleration zero at both ends: 10 u^3 - 15 u^4 + 6 u^5.
constexpr CurvePoint minimum_jerk(float u) {
  const float uu = u * u;
  const float v = 1.0F - u;
  return {(uu * u) * (10.0F - u * (15.0F - 6.0F * u)), (30.0F * uu) * (v * v),
          (60.0F * u) * (v * (v - u))};
}

/// 3 u^2 - 2 u^3: velocity zero at both ends. Peak speed 1.5 times the mean; minimum jerk has
/// 1.875.
constexpr CurvePoint smooth_step(float u) {
  const float v = 1.0F - u;
  return {(u * u) * (3.0F - 2.0F * u), 6.0F * (u * v), 6.0F * (v - u)};
}

/// Minimum jerk from p0 to p1, the end within one rounding.
constexpr CurvePoint minimum_jerk(float p0, float p1, float u) {
  const CurvePoint unit = minimum_jerk(u);
  return {p0 + (p1 - p0) * unit.value, (p1 - p0) * unit.derivative};
}

/// Quintic with slopes m0, m1 and zero second derivatives at the ends, which are exact.
constexpr CurvePoint quintic(float p0, float m0, float p1, float m1, float u) {
  const float rise = p1 - p0;
  const float a = m0 - rise;  // slopes relative to the chord
  const float b = m1 - rise;
  const float uu = u * u;
  const float fa = u + (uu * u) * (-6.0F + u * (8.0F - 3.0F * u));
  const float fb = (uu * u) * (-4.0F + u * (7.0F - 3.0F * u));
  const float ga = 1.0F + uu * (-18.0F + u * (32.0F - 15.0F * u));
  const float gb = uu * (-12.0F + u * (28.0F - 15.0F * u));
  const float chord = u < 0.5F ? p0 + u * rise : p1 - (1.0F - u) * rise;
  return {chord + (a * fa + b * fb), rise + (a * ga + b * gb)};
}

/// Height of a swing foot: 16 u^2 (1 - u)^2; velocity zero at both ends, 1 at u = 1/2.
constexpr CurvePoint swing_lift(float u) {
  const float v = 1.0F - u;
  const float uv = 4.0F * (u * v);
  return {uv * uv, (8.0F * uv) * (v - u), 32.0F - 48.0F * uv};
}

}  // namespace verp::math
