#pragma once
#include <cstdint>
#include <string>

#include "host/os/link/port.hpp"

struct gpio_v2_line_request;
struct gpio_v2_line_values;

namespace verp::link {

/// Like the system calls: negative and errno on failure. Tests replace them: their kernel has no
/// pins.
class GpioCalls {
 public:
  virtual ~GpioCalls() = default;
  virtual int open(const char* chip) = 0;
  virtual int request(int chip, gpio_v2_line_request& line) = 0;
  virtual int values(int line, gpio_v2_line_values& values) = 0;
};
GpioCalls& kernel_gpio_calls();

/// Where a stop button is: `gpio:/dev/gpiochip0,17`.
struct StopPlace {
  std::string chip;
  std::uint32_t line = 0;
};
/// Throws EndpointError.
StopPlace parse_stop(const std::string& words);

/// A stop button at a GPIO of Linux: a normally closed contact to ground, with the chip's pull-up.
/// An open circuit, a cut wire and a chip that is gone count as pressed.
class StopLine {
 public:
  /// Throws LinkError: no such chip, no permission, a line that another program has, no pull-up.
  explicit StopLine(const StopPlace& place, GpioCalls& calls = kernel_gpio_calls());

  /// Call it once a tick; it takes microseconds. Two open readings in a row count as pressed, one
  /// may be a spark. kReleased closed readings in a row end that.
  bool pressed();
  /// As the last pressed() said.
  bool is_pressed() const { return pressed_; }
  const std::string& name() const { return name_; }

 private:
  static constexpr int kPressed = 2, kReleased = 32;  ///< as firmware/app/panel.hpp
  bool reads_open();

  GpioCalls& calls_;
  const std::string name_;
  Descriptor line_;
  bool pressed_ = false;
  int changed_ = 0;  ///< readings in a row that differ
};

}  // namespace verp::link
