#include "host/os/imu/mount.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace verp::imu {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// a - by * b
Vector less(const Vector& a, double by, const Vector& b) {
  return {a[0] - by * b[0], a[1] - by * b[1], a[2] - by * b[2]};
}
Vector unit(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

}  // namespace

// At rest an accelerometer feels upward. Tilted forward, the world's up is behind the robot's own.
Mount find_mount(const Vector& upright, const Vector& forward) {
  constexpr double kLeastTilt = 0.17;  // sine of 10 degrees
  if (dot(upright, upright) < 1 || dot(forward, forward) < 1) return {};
  const Vector up = unit(upright), tilted = unit(forward);
  const Vector back = less(tilted, dot(tilted, up), up);
  if (std::sqrt(dot(back, back)) < kLeastTilt || dot(tilted, up) < 0) return {};
  const Vector behind = unit(back);
  const Vector ahead = {-behind[0], -behind[1], -behind[2]};
  const Vector body[] = {ahead, cross(up, ahead), up};  // the body's axes in the chip's
  Mount mount{"mount=", 0};
  unsigned taken = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t most = 0;
    for (std::size_t row = 1; row < 3; ++row) {
      if (std::abs(body[row][axis]) > std::abs(body[most][axis])) most = row;
    }
    taken |= 1u << most;
    mount.askew_rad =
        std::max(mount.askew_rad, std::acos(std::min(1.0, std::abs(body[most][axis]))));
    mount.words += std::string(axis > 0 ? ":" : "") + (body[most][axis] < 0 ? "-" : "") +
                   std::string(1, "xyz"[most]);
  }
  return taken == 7 ? mount : Mount{};
}

}  // namespace verp::imu
