#pragma once
#include <cstdint>

#include "common/safety/machine.hpp"

namespace verp::app {

/// Effect of an emergency stop on switched servo power. The core releases torque in the tick that
/// sees the stop, and the loop sends that for three ticks. Then the power goes off, for servos that
/// missed it and whatever the core decides: a category 0 stop of IEC 60204-1. A standing robot
/// falls.
///
/// Power returns after two manual actions: release the stop, and ask the robot to relax. The servos
/// have lost their settings by then, so the loop needs a new bring-up. A stop that cut the power
/// while the loop did not tick counts as pressed until the board's switch permits power again
/// (boards/stm32/servo_power.hpp).
class DrivePower {
 public:
  enum class Step : std::uint8_t { kOn, kOff, kAnew };

  static constexpr std::uint8_t kTorqueFirst = 3;

  /// `pressed`: a stop was pressed in this tick or still blocks the power; `mode`: the core's.
  Step after_tick(bool pressed, safety::Mode mode) {
    if (step_ == Step::kOn) {
      ticks_ = pressed ? static_cast<std::uint8_t>(ticks_ + 1) : std::uint8_t{0};
      if (ticks_ >= kTorqueFirst) step_ = Step::kOff;
    } else if (step_ == Step::kOff && !pressed && mode == safety::Mode::kRelaxed) {
      step_ = Step::kAnew;
    }
    return step_;
  }

 private:
  Step step_ = Step::kOn;
  std::uint8_t ticks_ = 0;
};

}  // namespace verp::app
