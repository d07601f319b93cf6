#include "host/os/link/stop_line.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>

#include "host/os/link/endpoint.hpp"
#include "host/os/link/link_error.hpp"

// The kernel's own interface: libgpiod's calls differ between Debian 12 and 13.
namespace verp::link {
namespace {

using Kind = LinkError::Kind;

class KernelGpioCalls final : public GpioCalls {
 public:
  int open(const char* chip) override { return ::open(chip, O_RDWR | O_CLOEXEC); }
  int request(int chip, gpio_v2_line_request& line) override {
    return ::ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &line);
  }
  int values(int line, gpio_v2_line_values& values) override {
    return ::ioctl(line, GPIO_V2_LINE_GET_VALUES_IOCTL, &values);
  }
};

[[noreturn]] void refuse_chip(const std::string& chip, int error) {
  if (error == EACCES || error == EPERM) {
    throw LinkError(Kind::kPermission, chip +
                                           ": no permission; join the group that may: sudo "
                                           "usermod -aG gpio $USER, then log in again");
  }
  throw LinkError(Kind::kNoDevice,
                  fmt::format("{}: {}; `gpiodetect` (package gpiod) lists the chips", chip,
                              error == ENOENT ? "no such device" : std::strerror(error)));
}

[[noreturn]] void refuse_line(const StopPlace& place, int error) {
  if (error == EBUSY) {
    throw LinkError(Kind::kBusy,
                    fmt::format("line {} of {}: another program has it; `gpioinfo` (package gpiod) "
                                "names it",
                                place.line, place.chip));
  }
  throw LinkError(
      Kind::kUnsuitable,
      fmt::format("line {} of {}: {}; give a line that can be an input with a pull-up: `gpioinfo` "
                  "(package gpiod) lists them",
                  place.line, place.chip,
                  error == ENOTTY ? "that is no GPIO chip" : std::strerror(error)));
}

int request(const StopPlace& place, GpioCalls& calls) {
  const Descriptor chip(calls.open(place.chip.c_str()));
  if (chip.get() < 0) refuse_chip(place.chip, errno);
  gpio_v2_line_request line{};
  line.offsets[0] = place.line;
  line.num_lines = 1;
  line.config.flags = GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_BIAS_PULL_UP;
  std::strncpy(line.consumer, "verp stop", sizeof line.consumer - 1);
  if (calls.request(chip.get(), line) < 0) refuse_line(place, errno);
  return line.fd;
}

}  // namespace

GpioCalls& kernel_gpio_calls() {
  static KernelGpioCalls calls;
  return calls;
}

StopPlace parse_stop(const std::string& words) {
  constexpr std::string_view kKind = "gpio:";
  const std::size_t comma = words.rfind(',');
  StopPlace place;
  if (words.starts_with(kKind) && comma != std::string::npos && comma > kKind.size()) {
    place.chip = words.substr(kKind.size(), comma - kKind.size());
    const char* end = words.data() + words.size();
    const auto read = std::from_chars(words.data() + comma + 1, end, place.line);
    if (read.ec == std::errc{} && read.ptr == end && place.chip.starts_with('/')) return place;
  }
  throw EndpointError(
      fmt::format("'{}' is no stop button; write gpio:/dev/gpiochip0,17: chip and line", words));
}

StopLine::StopLine(const StopPlace& place, GpioCalls& calls)
    : calls_(calls),
      name_(fmt::format("gpio:{},{}", place.chip, place.line)),
      line_(request(place, calls)) {
  pressed_ = reads_open();
}

bool StopLine::reads_open() {
  gpio_v2_line_values values{};
  values.mask = 1;
  return calls_.values(line_.get(), values) < 0 || (values.bits & 1) != 0;
}

bool StopLine::pressed() {
  changed_ = reads_open() == pressed_ ? 0 : changed_ + 1;
  if (changed_ >= (pressed_ ? kReleased : kPressed)) {
    pressed_ = !pressed_;
    changed_ = 0;
  }
  return pressed_;
}

}  // namespace verp::link
