#pragma once
#include <cstdint>

#include "firmware/app/contracts.hpp"

/// What a person can touch on the robot itself: the emergency stop and buttons, debounced, one
/// reading a tick, put into that tick's Inputs beside the operator's order.
namespace verp::app {

/// A contact that bounces: it is open or closed once so many readings in a row have said so.
class Contact {
 public:
  /// `on` is what it counts as before that.
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
  std::uint8_t run_ = 0;  ///< readings in a row that say otherwise
};

inline constexpr int kPanelButtons = 2;

/// As the pins stand now. A stop circuit is closed when all is well: a cut wire reads as pressed.
struct PanelReading {
  bool stop_pressed = false;
  bool button_pressed[kPanelButtons] = {};
};

/// An OperatorLink that adds the panel to another's orders. read() gives the pins' PanelReading.
/// A stop counts as pressed until it was read released; where there is none it never is; buttons
/// are bits of the mailbox, button 0 the lowest.
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
  /// In the last order somebody held a stop pressed, here or at the link. False while a stop that
  /// reads released only counts as pressed because nobody knows yet.
  bool pressed() const { return pressed_; }

 private:
  /// A stop is taken on the second reading, as one may be a spark; it is over after a quarter of
  /// a second of 8 ms ticks.
  static constexpr std::uint8_t kPressed = 2, kReleased = 32, kButton = 4;

  Link& link_;
  Pins& pins_;
  Contact stop_;
  bool released_ = false;  ///< once since the start
  bool pressed_ = false;
  Contact button_[kPanelButtons] = {{false, kButton, kButton}, {false, kButton, kButton}};
};

}  // namespace verp::app
