#pragma once
#include <cstdint>

#include "firmware/app/contracts.hpp"

/// Emergency stop and buttons on the robot, debounced with one reading a tick, merged into the
/// operator's order.
namespace verp::app {

/// Changes after `to_on` or `to_off` such readings in a row.
class Contact {
 public:
  /// `on`: the initial state.
  constexpr Contact(bool on, std::uint8_t to_on, std::uint8_t to_off)
      : on_(on), to_on_(to_on), to_off_(to_off) {}
  bool update(bool reads_on) {
    run_ = reads_on == on_ ? std::uint8_t{0} : static_cast<std::uint8_t>(run_ + 1);
    if (run_ >= (on_ ? to_off_ : to_on_)) {
      on_ = !on_;
      run_ = 0;
    }
    return on_;
  }
  bool on() const { return on_; }

 private:
  bool on_;
  std::uint8_t to_on_, to_off_;
  std::uint8_t run_ = 0;
};

inline constexpr int kPanelButtons = 2;

/// The stop circuit is normally closed, so a cut wire reads as pressed.
struct PanelReading {
  bool stop_pressed = false;
  bool button_pressed[kPanelButtons] = {};
};

/// Adds the panel to another OperatorLink's orders. Pins::read() returns a PanelReading. A stop
/// counts as pressed until it was read released; without a stop it never is. Buttons are mailbox
/// bits, button 0 the lowest.
template <OperatorLink Link, class Pins>
class WithPanel {
 public:
  WithPanel(Link& link, Pins& pins, bool has_stop)
      : link_(link), pins_(pins), stop_(has_stop, kPressed, kReleased) {}

  OperatorOrder order(std::uint32_t tick) {
    OperatorOrder order = link_.order(tick);
    const bool from_link = (order.flags & kEmergencyStop) != 0;
    const PanelReading reading = pins_.read();
    if (stop_.update(reading.stop_pressed)) order.flags |= kEmergencyStop;
    released_ = released_ || !stop_.on();
    pressed_ =
        (order.flags & kEmergencyStop) != 0 && (from_link || released_ || reading.stop_pressed);
    for (int i = 0; i < kPanelButtons; ++i) {
      const auto bit = static_cast<std::uint16_t>(1u << i);
      if (button_[i].update(reading.button_pressed[i])) order.mailbox |= bit;
    }
    return order;
  }
  /// True if panel or link held a stop pressed in the last order. False for a stop that reads
  /// released but is not settled.
  bool pressed() const { return pressed_; }

 private:
  /// A stop counts at the second reading, because one may be a spark. It ends after a quarter of a
  /// second at 8 ms.
  static constexpr std::uint8_t kPressed = 2, kReleased = 32, kButton = 4;

  Link& link_;
  Pins& pins_;
  Contact stop_;
  bool released_ = false;
  bool pressed_ = false;
  Contact button_[kPanelButtons] = {{false, kButton, kButton}, {false, kButton, kButton}};
};

}  // namespace verp::app
