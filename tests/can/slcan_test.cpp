#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "host/os/link/system_clock.hpp"
#include "tests/can/can_world.hpp"
#include "tests/can/serial_adapter.hpp"

namespace verp::link {
namespace {

using test::frame_of;
using test::poll_for;

class Adapter : public test::SerialAdapter {
 public:
  Adapter() { test::ip("link set " + name + " up"); }

  void say(const std::string& line) const {
    EXPECT_EQ(::write(end, line.data(), line.size()), static_cast<ssize_t>(line.size()));
  }
  std::vector<std::string> read_lines() {
    char piece[4096];
    for (ssize_t count = 0; (count = ::read(end, piece, sizeof piece)) > 0;) {
      unread_.append(piece, static_cast<std::size_t>(count));
    }
    std::vector<std::string> lines;
    for (std::size_t stop = 0; (stop = unread_.find('\r')) != std::string::npos;) {
      lines.push_back(unread_.substr(0, stop));
      unread_.erase(0, stop + 1);
    }
    return lines;
  }
  Endpoint endpoint() const { return parse_endpoint("can:" + name); }

 private:
  std::string unread_;
};

std::string line_of(const CanFrame& frame) {
  char text[64];
  std::snprintf(text, sizeof text, "t%03x%u%02x%02x%02x%02x", frame.id, frame.size, frame.data[0],
                frame.data[1], frame.data[2], frame.data[3]);
  return text;
}
std::string lower(std::string text) {
  for (char& each : text) {
    if (each >= 'A' && each <= 'F') each = static_cast<char>(each - 'A' + 'a');
  }
  return text;
}

/// Fills the queue while the adapter does not read; returns the number of frames.
unsigned jam(CanPort& port) {
  unsigned sent = 0;
  for (unsigned refused = 0; refused < 50;) {
    if (port.send(frame_of(0x700, sent))) {
      ++sent;
    } else {
      ++refused;
      CanFrame heard;
      EXPECT_FALSE(poll_for(port, heard, 2000));
    }
    EXPECT_LT(sent, 100'000u) << "the queue never fills";
    if (sent >= 100'000) break;
  }
  return sent;
}

TEST(Slcan, CarriesFramesBothWays) {
  Adapter adapter;
  CanPort port(adapter.endpoint());
  EXPECT_FALSE(port.interface().is_virtual);
  ASSERT_TRUE(port.send(frame_of(0x123, 0x44332211)));
  CanFrame heard;
  EXPECT_FALSE(port.poll(heard, 20'000));
  bool found = false;
  for (const std::string& each : adapter.read_lines()) {
    found = found || lower(each) == "t123411223344";
  }
  EXPECT_TRUE(found);
  adapter.say("t58021122\r");
  ASSERT_TRUE(poll_for(port, heard, 200'000));
  EXPECT_EQ(heard.id, 0x580u);
  EXPECT_EQ(heard.size, 2);
  EXPECT_EQ(heard.data[0] << 8 | heard.data[1], 0x1122);
}

TEST(Slcan, WaitsOutAFullQueue) {
  Adapter adapter;
  CanPort port(adapter.endpoint());
  const unsigned sent = jam(port);
  EXPECT_GT(sent, hal::kCanQueue);
  EXPECT_TRUE(port.connected());
  std::vector<std::string> lines;
  const std::uint64_t until_ns = monotonic_ns() + 20'000'000'000;
  while (lines.size() < sent && monotonic_ns() < until_ns) {
    CanFrame heard;
    ASSERT_FALSE(poll_for(port, heard, 2000));
    for (const std::string& each : adapter.read_lines()) {
      if (each[0] == 't') lines.push_back(lower(each));
    }
  }
  ASSERT_EQ(lines.size(), sent);
  for (unsigned i = 0; i < sent; ++i) ASSERT_EQ(lines[i], line_of(frame_of(0x700, i))) << i;
  EXPECT_EQ(port.errors().dropped, 0u);
}

TEST(Slcan, SendsTheBestOfWhatWaitsFirst) {
  Adapter adapter;
  CanPort port(adapter.endpoint());
  unsigned sent = 0;
  while (sent < 100'000 && port.send(frame_of(0x700, sent))) ++sent;
  ASSERT_LT(sent, 100'000u);
  std::vector<std::string> lines;
  bool sync_sent = false;
  const std::uint64_t until_ns = monotonic_ns() + 20'000'000'000;
  while (lines.size() < sent + 1 && monotonic_ns() < until_ns) {
    sync_sent = sync_sent || port.send(frame_of(0x080));
    CanFrame heard;
    ASSERT_FALSE(port.poll(heard, 0));
    for (const std::string& each : adapter.read_lines()) {
      if (each[0] == 't') lines.push_back(lower(each));
    }
  }
  ASSERT_EQ(lines.size(), sent + 1);
  EXPECT_NE(lines.back().substr(0, 4), "t080") << "it overtook nothing";
}

TEST(Slcan, DropsWhatWaitsAtABusOff) {
  Adapter adapter;
  CanPort port(adapter.endpoint());
  jam(port);
  adapter.say("sb256256\r");  // off the bus, error counters
  CanFrame heard;
  EXPECT_FALSE(poll_for(port, heard, 100'000));
  EXPECT_EQ(port.errors().bus_offs, 1u);
  EXPECT_GE(port.errors().dropped, hal::kCanQueue);
  EXPECT_FALSE(port.send(frame_of(1)));
  EXPECT_NE(advice(port.interface()), "") << "nothing brings it back by itself";
}

}  // namespace
}  // namespace verp::link
