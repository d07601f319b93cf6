#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace verp::test {

/// A serial adapter (slcan) on a pseudo-terminal: an interface of the kernel's CAN drivers, with a
/// bit rate and a queue, neither of which a vcan has. It is down at first.
class SerialAdapter {
 public:
  SerialAdapter() : end(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    EXPECT_EQ(::grantpt(end) | ::unlockpt(end), 0);
    slave_ = ::open(::ptsname(end), O_RDWR | O_NOCTTY);
    termios raw{};
    ::tcgetattr(slave_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave_, TCSANOW, &raw);
    const int slcan = 17;  // N_SLCAN of linux/tty.h
    EXPECT_EQ(::ioctl(slave_, TIOCSETD, &slcan), 0) << "is the module slcan there?";
    ifreq request{};
    EXPECT_EQ(::ioctl(slave_, SIOCGIFNAME, &request), 0);
    name = static_cast<const char*>(request.ifr_name);
  }
  ~SerialAdapter() {
    ::close(end);  // a hangup: the interface goes
    ::close(slave_);
  }
  SerialAdapter(const SerialAdapter&) = delete;
  SerialAdapter& operator=(const SerialAdapter&) = delete;

  std::string name;  ///< the interface's
  const int end;     ///< what the adapter's firmware reads and writes; it never waits

 private:
  int slave_ = -1;
};

}  // namespace verp::test
