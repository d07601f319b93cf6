#pragma once
#include <cmath>
#include <numbers>

namespace verp::brain {

struct Point {
  double x = 0, y = 0;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
};

inline double length(Point p) {
  return std::hypot(p.x, p.y);
}
inline double distance(Point a, Point b) {
  return length(b - a);
}
inline double direction_rad(Point p) {
  return std::atan2(p.y, p.x);
}
inline Point turned(Point p, double by_rad) {
  const double c = std::cos(by_rad), s = std::sin(by_rad);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}
/// To [-pi, pi].
inline double wrapped(double angle_rad) {
  return std::remainder(angle_rad, 2 * std::numbers::pi);
}

/// Position and heading on the floor; or a frame.
struct Pose {
  Point at_m;
  double yaw_rad = 0;
};

/// Converts a point from the frame `pose` to its parent frame, and back.
inline Point out_of(const Pose& pose, Point inside) {
  return pose.at_m + turned(inside, pose.yaw_rad);
}
inline Point into(const Pose& pose, Point outside) {
  return turned(outside - pose.at_m, -pose.yaw_rad);
}
inline Pose out_of(const Pose& pose, const Pose& inside) {
  return {out_of(pose, inside.at_m), wrapped(pose.yaw_rad + inside.yaw_rad)};
}
inline Pose into(const Pose& pose, const Pose& outside) {
  return {into(pose, outside.at_m), wrapped(outside.yaw_rad - pose.yaw_rad)};
}

inline double within(double value, double most) {
  return value > most ? most : value < -most ? -most : value;
}

}  // namespace verp::brain
