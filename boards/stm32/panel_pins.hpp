#pragma once
#include "boards/stm32/wiring.hpp"
#include "firmware/app/panel.hpp"
#include "hal/chip/stm32/gpio.hpp"

namespace verp::board {

/// board.hpp's emergency stop and buttons. The stop circuit connects its pin to ground; a pull-up
/// makes an open circuit read as pressed.
template <hal::stm32::Io Access>
class PanelPins {
 public:
  PanelPins(Pin stop, const Button (&buttons)[app::kPanelButtons], Access io = {})
      : gpio_(io), stop_(stop), buttons_(buttons) {}

  void open() {
    gpio_.input(stop_, hal::stm32::gpio::kPullUp);
    for (const Button& button : buttons_) {
      gpio_.input(button.pin,
                  button.pressed_high ? hal::stm32::gpio::kPullDown : hal::stm32::gpio::kPullUp);
    }
  }
  app::PanelReading read() {
    app::PanelReading reading;
    reading.stop_pressed = gpio_.read(stop_);
    for (int i = 0; i < app::kPanelButtons; ++i) {
      const Button& button = buttons_[i];
      reading.button_pressed[i] =
          button.pin.exists() && gpio_.read(button.pin) == button.pressed_high;
    }
    return reading;
  }

 private:
  hal::stm32::Gpio<Access> gpio_;
  const Pin stop_;
  const Button (&buttons_)[app::kPanelButtons];
};

}  // namespace verp::board
