#pragma once
#include "boards/stm32/wiring.hpp"
#include "common/protocol/controller_table.hpp"
#include "hal/chip/stm32/gpio.hpp"

namespace verp::board {

/// The switch of the servos' power, high is on, and the emergency stop beside it, which joins its
/// pin to ground while all is well: while that circuit is open, nothing switches the power on.
/// Either pin may not exist.
template <hal::stm32::Io Access>
class ServoPower {
 public:
  ServoPower(Pin power, Pin stop, Access io = {}) : gpio_(io), power_(power), stop_(stop) {}

  /// Off, as after every reset.
  void open() {
    gpio_.input(stop_, hal::stm32::gpio::kPullUp);
    gpio_.output(power_, false);
  }
  bool exists() const { return power_.exists(); }
  void set(bool on) {
    on_ = on && !gpio_.read(stop_);
    gpio_.output(power_, on_);
  }
  /// While no tick reads the stop: an open circuit takes the power at once.
  void watch() {
    if (on_ && gpio_.read(stop_)) set(false);
  }
  dxl::controller::ServoPower state() const {
    using State = dxl::controller::ServoPower;
    return !exists() ? State::kNotSwitched : on_ ? State::kOn : State::kOff;
  }

 private:
  hal::stm32::Gpio<Access> gpio_;
  const Pin power_, stop_;
  bool on_ = false;
};

}  // namespace verp::board
