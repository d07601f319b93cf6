#pragma once
#include <cstdint>

#include "common/math/elementary.hpp"
#include "common/math/scalar.hpp"
#include "common/math/xyz.hpp"

/// The only file of common/ that includes Eigen.
///
/// Eigen sums in a documented order only without vectorisation, in every translation unit
/// (toolchains/floating_point.cmake). Not allowed in the core: AngleAxis, eulerAngles, slerp, 6x6
/// inverse() and products of 8 or more dimensions: they reach libm, malloc or a blocked product.
#ifndef EIGEN_DONT_VECTORIZE
#error \
    "build with EIGEN_DONT_VECTORIZE (toolchains/floating_point.cmake): vectorised sums have other bits"
#endif
#ifndef EIGEN_NO_MALLOC
#define EIGEN_NO_MALLOC
#endif
#ifndef EIGEN_NO_IO
#define EIGEN_NO_IO
#endif
#ifndef EIGEN_NO_DEBUG
#define EIGEN_NO_DEBUG  // no message strings in the firmware
#endif
#include <Eigen/Core>

namespace verp::math {

using Vec2 = Eigen::Matrix<float, 2, 1>;
using Vec3 = Eigen::Matrix<float, 3, 1>;
using Vec6 = Eigen::Matrix<float, 6, 1>;
using Mat3 = Eigen::Matrix<float, 3, 3>;
using Mat6 = Eigen::Matrix<float, 6, 6>;

inline Vec3 to_vec(const Xyz& v) {
  return {v.x, v.y, v.z};
}
inline Xyz to_xyz(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

inline bool is_finite(const Vec3& v) {
  return is_finite(v.x()) && is_finite(v.y()) && is_finite(v.z());
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

/// Not guarded against overflow beyond 1e19.
inline float norm(const Vec3& v) {
  return hypot(v.x(), v.y(), v.z());
}

/// v / |v|, or `fallback` if |v| is below 1e-12 or not finite.
inline Vec3 normalized_or(const Vec3& v, const Vec3& fallback) {
  const float length = norm(v);
  if (!(length > 1e-12F) || !is_finite(length)) return fallback;
  return v / length;
}

/// cross(v, w) == skew(v) * w.
inline Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0.0F, -v.z(), v.y(), v.z(), 0.0F, -v.x(), -v.y(), v.x(), 0.0F;
  return m;
}

/// Right-handed rotations about the frame's axes.
inline Mat3 rot_x(const SinCos& angle) {
  Mat3 m;
  m << 1.0F, 0.0F, 0.0F, 0.0F, angle.cos, -angle.sin, 0.0F, angle.sin, angle.cos;
  return m;
}
inline Mat3 rot_y(const SinCos& angle) {
  Mat3 m;
  m << angle.cos, 0.0F, angle.sin, 0.0F, 1.0F, 0.0F, -angle.sin, 0.0F, angle.cos;
  return m;
}
inline Mat3 rot_z(const SinCos& angle) {
  Mat3 m;
  m << angle.cos, -angle.sin, 0.0F, angle.sin, angle.cos, 0.0F, 0.0F, 0.0F, 1.0F;
  return m;
}
inline Mat3 rot_x(float angle_rad) {
  return rot_x(sincos(angle_rad));
}
inline Mat3 rot_y(float angle_rad) {
  return rot_y(sincos(angle_rad));
}
inline Mat3 rot_z(float angle_rad) {
  return rot_z(sincos(angle_rad));
}

/// Rodrigues. The caller normalises the axis.
Mat3 rotation(const Vec3& unit_axis, const SinCos& angle);
inline Mat3 rotation(const Vec3& unit_axis, float angle_rad) {
  return rotation(unit_axis, sincos(angle_rad));
}

/// Rz(yaw) Ry(pitch) Rx(roll): fixed-axis roll, pitch, yaw, as in URDF and SDF.
Mat3 rotation_rpy(float roll_rad, float pitch_rad, float yaw_rad);

/// Inverse of rotation_rpy, pitch in [-kHalfPi, kHalfPi]. Total. At pitch +-kHalfPi, roll is 0.
Vec3 roll_pitch_yaw(const Mat3& rotation);

/// Unit axis times angle in [0, kPi]. Total.
Vec3 rotation_vector(const Mat3& rotation);

/// Tag: leave uninitialised.
struct Unset {};

/// Frame B seen from A: rotates, then translates B coordinates into A.
struct Pose {
  Mat3 rotation;
  Vec3 position_m;

  Pose() : rotation(Mat3::Identity()), position_m(Vec3::Zero()) {}
  Pose(const Mat3& turned, const Vec3& moved_m) : rotation(turned), position_m(moved_m) {}
  /// Leaves both undefined, for arrays about to be written.
  explicit Pose(Unset) {}
};

/// a_T_c = a_T_b * b_T_c.
inline Pose compose(const Pose& a_b, const Pose& b_c) {
  return {a_b.rotation * b_c.rotation, a_b.position_m + a_b.rotation * b_c.position_m};
}
inline Pose operator*(const Pose& a_b, const Pose& b_c) {
  return compose(a_b, b_c);
}

/// b_T_a. The rotation must be orthonormal.
inline Pose inverse(const Pose& a_b) {
  const Mat3 transposed = a_b.rotation.transpose();
  return {transposed, -(transposed * a_b.position_m)};
}

/// A point of frame B in frame A.
inline Vec3 apply(const Pose& a_b, const Vec3& point_b_m) {
  return a_b.position_m + a_b.rotation * point_b_m;
}

/// Cholesky of A x = b; reads A's lower triangle. False with x = 0 if A is not numerically positive
/// definite or x not finite.
bool solve_spd(const Mat6& a, const Vec6& b, Vec6& x);

}  // namespace verp::math

namespace verp {
using math::Mat3;
using math::Mat6;
using math::Pose;
using math::Vec2;
using math::Vec3;
using math::Vec6;
}  // namespace verp
