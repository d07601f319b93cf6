#include "host/os/link/line_rate.hpp"

// The kernel's termios, with a numeric rate; it conflicts with the C library's header.
#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace verp::link {

bool set_line_rate(int descriptor, std::uint32_t baud) {
  termios2 settings{};
  if (::ioctl(descriptor, TCGETS2, &settings) != 0) return false;
  settings.c_cflag = (settings.c_cflag & ~static_cast<tcflag_t>(CBAUD)) | BOTHER;
  settings.c_ispeed = baud;
  settings.c_ospeed = baud;
  return ::ioctl(descriptor, TCSETS2, &settings) == 0;
}

std::uint32_t line_rate(int descriptor) {
  termios2 settings{};
  return ::ioctl(descriptor, TCGETS2, &settings) == 0 ? settings.c_ospeed : 0;
}

}  // namespace verp::link
