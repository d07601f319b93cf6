#include "host/run/session/suspicions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace verp::session {
namespace {

/// A chip's scale is right within 3 % (ICM-20648, DS-000179); the mean of a walk was within 3 %.
constexpr double kOff = 0.1;
constexpr float kMean_ticks = 100;
/// The core learns up to 2.9 degrees of each sole (balance/zeros.cpp). Zero errors of the joints
/// make less, even if all of them are at their limit and lean both soles to one side.
constexpr double kLean_rad = 0.045;

}  // namespace

void Suspicions::tick(const Params& params, const Inputs& inputs, const State& state) {
  const balance::LegZero &left = state.zeros.leg[0], &right = state.zeros.leg[1];
  roll_rad_ = (left.roll_rad + right.roll_rad) / 2;
  pitch_rad_ = (left.pitch_rad + right.pitch_rad) / 2;
  if ((inputs.flags & kImuFresh) == 0 || (inputs.flags & kImuAssumed) != 0) return;
  float square = 0;
  for (const std::int16_t count : inputs.accel_count) {
    const float accel = params.imu.accel_m_s2_per_count * static_cast<float>(count);
    square += accel * accel;
  }
  const float share = gravity_m_s2_ > 0 ? 1 / kMean_ticks : 1;
  gravity_m_s2_ += (std::sqrt(square) - gravity_m_s2_) * share;
}

std::string Suspicions::text(double gravity_m_s2, bool level) const {
  if (gravity_m_s2_ > 0 && std::abs(gravity_m_s2_ - gravity_m_s2) > kOff * gravity_m_s2) {
    return fmt::format(
        "the accelerometer feels {:.1f} m/s2 where gravity is {:.1f}: does it count in g, or in "
        "another range? mend the IMU's type in the robot's file",
        gravity_m_s2_, gravity_m_s2);
  }
  const double lean_rad = std::max(std::abs(roll_rad_), std::abs(pitch_rad_));
  if (!level || lean_rad < kLean_rad) return "";
  return fmt::format(
      "by the IMU both soles lean by {:.1f} degrees or more ({}): the IMU is askew on its bracket, "
      "or the floor slopes; mend its pose in the robot's file",
      lean_rad * 180 / std::numbers::pi,
      std::abs(roll_rad_) > std::abs(pitch_rad_) ? "to a side" : "fore or aft");
}

}  // namespace verp::session
