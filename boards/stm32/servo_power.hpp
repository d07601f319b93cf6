#pragma once
#include "boards/stm32/wiring.hpp"
#include "common/protocol/controller_table.hpp"
#include "firmware/app/drive_power.hpp"
#include "hal/chip/stm32/gpio.hpp"

namespace verp::board {

/// The servo power switch (high is on) and the emergency stop, whose circuit connects its pin to
/// ground. While that is open, power stays off. Power that a stop cut or prevented returns only
/// after permit(), whether or not a loop ticks. Either pin may be missing.
template <hal::stm32::Io Access>
class ServoPower {
 public:
  ServoPower(Pin power, Pin stop, Access io = {}) : gpio_(io), power_(power), stop_(stop) {}

  /// Starts with power off, as after every reset.
  void open() {
    gpio_.input(stop_, hal::stm32::gpio::kPullUp);
    gpio_.output(power_, false);
  }
  bool exists() const { return power_.exists(); }
  void set(bool on) {
    if (on && gpio_.read(stop_)) taken_ = true;
    on_ = on && !taken_;
    gpio_.output(power_, on_);
  }
  /// Call while no tick reads the stop: an open circuit cuts the power at once.
  void watch() {
    if (on_ && gpio_.read(stop_)) take();
  }
  /// Call after each tick of a loop that drives servos: kAnew asks for a new bring-up.
  app::DrivePower::Step after_tick(app::DrivePower& drive, bool pressed, safety::Mode mode) {
    const auto step = drive.after_tick(pressed || taken(), mode);
    if (step == app::DrivePower::Step::kOff && on_) take();
    return exists() ? step : app::DrivePower::Step::kOn;
  }
  /// Call regularly. `relax_asked`: `request` 0 was written since the last call; ignored while the
  /// circuit is open.
  void permit(bool relax_asked) {
    if (relax_asked && !gpio_.read(stop_)) taken_ = false;
    if (!on_ && gpio_.read(stop_)) taken_ = true;
  }
  /// A stop cut the power, and permit() has not allowed it again.
  bool taken() const { return exists() && taken_; }
  dxl::controller::ServoPower state() const {
    using State = dxl::controller::ServoPower;
    return !exists() ? State::kNotSwitched : on_ ? State::kOn : State::kOff;
  }

 private:
  void take() {
    taken_ = true;
    set(false);
  }

  hal::stm32::Gpio<Access> gpio_;
  const Pin power_, stop_;
  bool on_ = false;
  bool taken_ = false;
};

}  // namespace verp::board
