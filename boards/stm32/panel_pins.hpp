#pragma once
#include "boards/stm32/hardware.hpp"
#include "firmware/app/panel.hpp"

namespace verp::board {

/// The emergency stop and the buttons of board.hpp. The stop circuit joins its pin to ground while
/// all is well; a pull-up makes an open one read as pressed.
class PanelPins {
 public:
  static constexpr bool kHasStop = kEmergencyStop.exists();

  void open() {
    gpio_.input(kEmergencyStop, stm32::gpio::kPullUp);
    for (const Button& button : kButtons) {
      gpio_.input(button.pin, button.pressed_high ? stm32::gpio::kPullDown : stm32::gpio::kPullUp);
    }
  }
  app::PanelReading read() {
    app::PanelReading reading;
    reading.stop_pressed = kHasStop && gpio_.read(kEmergencyStop);
    for (int i = 0; i < app::kPanelButtons; ++i) {
      const Button& button = kButtons[i];
      reading.button_pressed[i] =
          button.pin.exists() && gpio_.read(button.pin) == button.pressed_high;
    }
    return reading;
  }

 private:
  stm32::Gpio<Io> gpio_;
};

}  // namespace verp::board
