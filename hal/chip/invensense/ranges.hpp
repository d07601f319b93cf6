#pragma once
#include <cstdint>

#include "hal/chip/invensense/registers.hpp"

namespace verp::hal::invensense {

namespace detail {
/// The step within 2 % of `wanted`, of `steps` that double from `finest`; -1: none.
constexpr int nearest_step(float wanted, float finest, int steps) {
  float step = finest;
  for (int i = 0; i < steps; ++i, step *= 2.0F) {
    if (wanted > 0.98F * step && wanted < 1.02F * step) return i;
  }
  return -1;
}
}  // namespace detail

/// The robot's full scales. False: the chip lacks them, so it is not the robot's sensor. Finest on
/// both chips: 250 deg/s (in rad/s) and 2 g (in m/s^2) over 32768 counts.
constexpr bool choose_ranges(float gyro_rad_s_per_count, float accel_m_s2_per_count,
                             Ranges& ranges) {
  constexpr float kGyroFinest = 4.36332313F / 32768.0F;
  constexpr float kAccelFinest = 2.0F * 9.80665F / 32768.0F;
  constexpr int kSteps = 4;
  const int gyro = detail::nearest_step(gyro_rad_s_per_count, kGyroFinest, kSteps);
  const int accel = detail::nearest_step(accel_m_s2_per_count, kAccelFinest, kSteps);
  if (gyro < 0 || accel < 0) return false;
  ranges = {static_cast<std::uint8_t>(gyro), static_cast<std::uint8_t>(accel)};
  return true;
}

}  // namespace verp::hal::invensense
