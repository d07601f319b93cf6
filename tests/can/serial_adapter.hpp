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

/// slcan on a pseudo-terminal, with a bit rate and a queue, which vcan lacks. It starts down.
class SerialAdapter {
 public:
  SerialAdapter() : end(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    EXPECT_EQ(::grantpt(end) | ::unlockpt(end), 0);
    slave_ = ::open(::ptsname(end), O_RDWR | O_NOCTTY);
    termios raw{};
    ::tcgetattr(slave_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave_, TCSANOW, &raw);
    const int slcan = 17;  // of linux/tty.h
    EXPECT_EQ(::ioctl(slave_, TIOCSETD, &slcan), 0) << "is the module slcan there?";
    ifreq request{};
    EXPECT_EQ(::ioctl(slave_, SIOCGIFNAME, &request), 0);
    name = static_cast<const char*>(request.ifr_name);
  }
  ~SerialAdapter() {
    ::close(end);  // removes the interface
    ::close(slave_);
  }
  SerialAdapter(const SerialAdapter&) = delete;
  SerialAdapter& operator=(const SerialAdapter&) = delete;

  std::string name;
  const int end;  ///< the adapter's end; it never waits

 private:
  int slave_ = -1;
};

}  // namespace verp::test
