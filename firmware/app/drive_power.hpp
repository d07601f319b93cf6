#pragma once
#include <cstdint>

#include "common/safety/machine.hpp"

namespace verp::app {

/// What an emergency stop does to the servos' power, on a board that switches it. The core lets go
/// of torque in the tick that sees the stop, and the loop says so in three ticks; then the power
/// goes, so that a servo lets go which did not hear, and whatever the core makes of the stop. It is
/// a stop of category 0 of IEC 60204-1: a robot that stands falls. Power comes back only when two
/// things were done by hand: the stop released, and the robot asked to relax. The servos have then
/// forgotten their settings, so the loop must be brought up anew. A stop that took the power while
/// nothing ticked counts as pressed until the board's switch permits it again
/// (boards/stm32/servo_power.hpp).
class DrivePower {
 public:
  enum class Step : std::uint8_t { kOn, kOff, kAnew };

  /// As many ticks as torque off is sent in.
  static constexpr std::uint8_t kTorqueFirst = 3;

  /// After each tick: whether a stop was pressed in it or still keeps the power away, and what the
  /// core made of it.
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
  std::uint8_t ticks_ = 0;  ///< in a row with the stop pressed
};

}  // namespace verp::app
