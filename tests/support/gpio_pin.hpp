#pragma once
#include <fcntl.h>
#include <linux/gpio.h>

#include <cerrno>

#include "host/os/link/stop_line.hpp"

namespace verp::test {

/// A GPIO chip with one pin that a test connects to ground, or leaves open.
class GpioPin final : public link::GpioCalls {
 public:
  int open(const char*) override { return fails(open_error) ? -1 : ::open("/dev/null", O_RDWR); }
  int request(int, gpio_v2_line_request& line) override {
    asked = line;
    line.fd = ::open("/dev/null", O_RDWR);
    return fails(request_error) ? -1 : 0;
  }
  int values(int, gpio_v2_line_values& values) override {
    values.bits = grounded ? 0 : values.mask;
    return fails(gone ? ENODEV : 0) ? -1 : 0;
  }

  bool grounded = true;
  bool gone = false;  ///< a chip at USB that was unplugged
  int open_error = 0, request_error = 0;
  gpio_v2_line_request asked{};

 private:
  static bool fails(int error) {
    errno = error;
    return error != 0;
  }
};

}  // namespace verp::test
