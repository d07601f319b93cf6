#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "host/os/link/can_port.hpp"
#include "tests/contract/pc/can_sockets.hpp"

/// Runs as root inside tests/support/with-can.
namespace verp::test {

inline void ip(const std::string& arguments) {
  ASSERT_EQ(std::system(("ip " + arguments).c_str()), 0) << arguments;
}

class OwnVcan {
 public:
  explicit OwnVcan(std::string interface = "vcan7") : name(std::move(interface)) { make(); }
  ~OwnVcan() {
    if (there_) ip("link del " + name);
  }
  OwnVcan(const OwnVcan&) = delete;
  OwnVcan& operator=(const OwnVcan&) = delete;

  void make() {
    ip("link add " + name + " type vcan");
    there_ = true;
    up();
  }
  void remove() {
    ip("link del " + name);
    there_ = false;
  }
  void up() const { ip("link set " + name + " up"); }
  void down() const { ip("link set " + name + " down"); }
  link::Endpoint endpoint() const { return link::parse_endpoint("can:" + name); }

  const std::string name;

 private:
  bool there_ = false;
};

inline CanFrame frame_of(std::uint32_t id, unsigned number = 0) {
  CanFrame frame;
  frame.id = id;
  frame.size = 4;
  for (unsigned i = 0; i < 4; ++i) frame.data[i] = static_cast<std::uint8_t>(number >> 8 * i);
  return frame;
}

/// From now, not from the last frame sent.
inline bool poll_for(link::CanPort& port, CanFrame& frame, std::uint32_t time_us) {
  return port.poll(frame, static_cast<std::uint32_t>(port.now_us()) + time_us);
}

/// No frame may be for us.
inline void settle(link::CanPort& port) {
  CanFrame frame;
  EXPECT_FALSE(poll_for(port, frame, 30'000));
}

}  // namespace verp::test
