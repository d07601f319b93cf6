#include "common/math/linear.hpp"

namespace verp::math {

Mat3 rotation(const Vec3& unit_axis, const SinCos& angle) {
  const float x = unit_axis.x();
  const float y = unit_axis.y();
  const float z = unit_axis.z();
  const float s = angle.sin;
  const float c = angle.cos;
  const float v = 1.0F - c;
  Mat3 m;
  m << c + (x * x) * v, (x * y) * v - z * s, (x * z) * v + y * s,  //
      (x * y) * v + z * s, c + (y * y) * v, (y * z) * v - x * s,   //
      (x * z) * v - y * s, (y * z) * v + x * s, c + (z * z) * v;
  return m;
}

Mat3 rotation_rpy(float roll_rad, float pitch_rad, float yaw_rad) {
  const SinCos r = sincos(roll_rad);
  const SinCos p = sincos(pitch_rad);
  const SinCos y = sincos(yaw_rad);
  const float sp_sr = p.sin * r.sin;
  const float sp_cr = p.sin * r.cos;
  Mat3 m;
  m << y.cos * p.cos, y.cos * sp_sr - y.sin * r.cos, y.cos * sp_cr + y.sin * r.sin,  //
      y.sin * p.cos, y.sin * sp_sr + y.cos * r.cos, y.sin * sp_cr - y.cos * r.sin,   //
      -p.sin, p.cos * r.sin, p.cos * r.cos;
  return m;
}

Vec3 roll_pitch_yaw(const Mat3& rotation) {
  const float level = hypot(rotation(0, 0), rotation(1, 0));  // cos(pitch)
  const float pitch = atan2(-rotation(2, 0), level);
  if (!(level > 1e-6F)) {
    return {0.0F, pitch, atan2(-rotation(0, 1), rotation(1, 1))};
  }
  return {atan2(rotation(2, 1), rotation(2, 2)), pitch, atan2(rotation(1, 0), rotation(0, 0))};
}

Vec3 rotation_vector(const Mat3& rotation) {
  const Vec3 twice_axis_sin = {rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                               rotation(1, 0) - rotation(0, 1)};
  const float twice_sin = norm(twice_axis_sin);
  const float twice_cos = (rotation(0, 0) + (rotation(1, 1) + rotation(2, 2))) - 1.0F;
  const float angle = atan2(twice_sin, twice_cos);
  if (!is_finite(twice_sin) || !is_finite(twice_cos)) return Vec3::Zero();
  if (twice_cos > -1.9F) {
    // angle / (2 sin angle) tends to 1/2.
    const float scale = twice_sin > 2e-3F ? angle / twice_sin : 0.5F;
    return twice_axis_sin * scale;
  }
  // Near half a turn the sine is too small: R + R^T + (1 - trace) I = 2 (1 - cos) axis axis^T.
  int column = 0;
  for (int i = 1; i < 3; ++i) {
    if (rotation(i, i) > rotation(column, column)) column = i;
  }
  Vec3 axis = rotation.col(column) + rotation.row(column).transpose();
  axis(column) -= twice_cos;
  axis = normalized_or(axis, Vec3::UnitX());
  return axis.dot(twice_axis_sin) < 0.0F ? Vec3(axis * -angle) : Vec3(axis * angle);
}

bool solve_spd(const Mat6& a, const Vec6& b, Vec6& x) {
  Mat6 l = a;  // becomes L of A = L L^T; diagonal: reciprocals
  x.setZero();
  for (int j = 0; j < 6; ++j) {
    for (int i = j; i < 6; ++i) {
      float sum = l(i, j);
      for (int k = 0; k < j; ++k) sum -= l(i, k) * l(j, k);
      l(i, j) = sum;
    }
    // A smaller pivot is rounding error.
    if (!(l(j, j) > 1e-7F * a(j, j)) || !is_finite(l(j, j))) return false;
    l(j, j) = 1.0F / sqrt(l(j, j));
    for (int i = j + 1; i < 6; ++i) l(i, j) *= l(j, j);
  }
  Vec6 solution = b;
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) solution(i) -= l(i, k) * solution(k);
    solution(i) *= l(i, i);
  }
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) solution(i) -= l(k, i) * solution(k);
    solution(i) *= l(i, i);
  }
  for (int i = 0; i < 6; ++i) {
    if (!is_finite(solution(i))) return false;
  }
  x = solution;
  return true;
}

}  // namespace verp::math
