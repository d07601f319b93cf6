#pragma once
#include <algorithm>
#include <cmath>

#include "tests/unit/action/shelf.hpp"
#include "tests/unit/control/loop.hpp"

namespace verp::control::test {

/// A fall with the left arm at 1 rad; a rise in 0.9 s with both arms at 0.5 rad.
inline action::test::Shelf falling_shelf() {
  action::test::Shelf shelf;
  __builtin_memcpy(shelf.action[0].name, action::kGetUpFront, kNameLength);
  __builtin_memcpy(shelf.action[1].name, action::kFallSafe, kNameLength);
  for (const int joint : {kLeftArm, kRightArm}) {
    shelf.goal(0, joint, 0.5F);
    shelf.goal(1, joint, kRobot.joint[joint].stand_rad);
  }
  shelf.frame[0].pause_ms = 500;
  shelf.frame[2].pause_ms = 5000;
  shelf.goal(2, kLeftArm, 1.0F);
  return shelf;
}

inline const action::test::Shelf kFallingShelf = falling_shelf();

struct FallingLoop : Loop {
  explicit FallingLoop(bool with_actions = true) {
    if (with_actions) actions = kFallingShelf.library();
    command.request = Request::kStand;
  }
  void hold_up(std::int16_t x, std::int16_t z) {
    inputs.accel_count[0] = x;
    inputs.accel_count[2] = z;
  }
  /// Topples at 3 rad/s and stays down. Returns the tilt, rad, at which `mode` began; -1 if never.
  double topple(Mode mode) {
    constexpr double kRate_rad_s = 3, kGyro_rad_s = 0.00106, kOne = 8172;
    double tilt_rad = 0, entered_rad = -1;
    for (int i = 0; i < 60; ++i) {
      tilt_rad = std::min(1.57, tilt_rad + 0.01 * kRate_rad_s);
      const bool turns = tilt_rad < 1.57;
      inputs.gyro_count[1] = static_cast<std::int16_t>(turns ? kRate_rad_s / kGyro_rad_s : 0);
      hold_up(static_cast<std::int16_t>(-kOne * std::sin(tilt_rad)),
              static_cast<std::int16_t>(kOne * std::cos(tilt_rad)));
      tick();
      if (is_in(mode) && entered_rad < 0) entered_rad = tilt_rad;
    }
    return entered_rad;
  }
  bool has_torque() const { return outputs.torque_enable != 0; }
};

}  // namespace verp::control::test
