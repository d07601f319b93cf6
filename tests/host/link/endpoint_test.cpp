#include "host/os/link/endpoint.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace verp::link {
namespace {

using Kind = Endpoint::Kind;

std::string refusal(const std::string& text) {
  try {
    parse_endpoint(text);
  } catch (const EndpointError& error) {
    return error.what();
  }
  return "";
}

TEST(Endpoint, ReadsWhatTheManualSays) {
  EXPECT_EQ(parse_endpoint("serial:/dev/ttyUSB0@1000000"),
            (Endpoint{Kind::kSerial, "/dev/ttyUSB0", 1'000'000, 0}));
  EXPECT_EQ(parse_endpoint("serial:/dev/ttyACM0"),
            (Endpoint{Kind::kSerial, "/dev/ttyACM0", kDefaultBaud, 0}));
  EXPECT_EQ(parse_endpoint("serial:/dev/by@path@57600"),
            (Endpoint{Kind::kSerial, "/dev/by@path", 57'600, 0}));
  EXPECT_EQ(parse_endpoint("pty:"), (Endpoint{Kind::kPty, "", 0, 0}));
  EXPECT_EQ(parse_endpoint("pty:/tmp/robot"), (Endpoint{Kind::kPty, "/tmp/robot", 0, 0}));
  EXPECT_EQ(parse_endpoint("tcp:robot.local:6000"), (Endpoint{Kind::kTcp, "robot.local", 0, 6000}));
  EXPECT_EQ(parse_endpoint("tcp:[::1]:6000"), (Endpoint{Kind::kTcp, "::1", 0, 6000}));
  EXPECT_EQ(parse_endpoint("tcp-listen:0"), (Endpoint{Kind::kTcpListen, "127.0.0.1", 0, 0}));
  EXPECT_EQ(parse_endpoint("tcp-listen:0.0.0.0:6000"),
            (Endpoint{Kind::kTcpListen, "0.0.0.0", 0, 6000}));
  EXPECT_EQ(parse_endpoint("unix:/tmp/a:b"), (Endpoint{Kind::kUnix, "/tmp/a:b", 0, 0}));
  EXPECT_EQ(parse_endpoint("unix-listen:s"), (Endpoint{Kind::kUnixListen, "s", 0, 0}));
  EXPECT_EQ(parse_endpoint("can:vcan0"), (Endpoint{Kind::kCan, "vcan0", 0, 0}));
  EXPECT_EQ(parse_endpoint("can:can-of-fifteen!"), (Endpoint{Kind::kCan, "can-of-fifteen!", 0, 0}));
}

TEST(Endpoint, IsWrittenAsItIsRead) {
  for (const char* text :
       {"serial:/dev/ttyUSB0@2000000", "pty:", "pty:/tmp/robot", "tcp:host:6000", "tcp:[fe80::1]:1",
        "tcp-listen:127.0.0.1:0", "tcp:host:6000,token=/a,b", "tcp-listen:0.0.0.0:1,token=t",
        "unix:/run/a", "unix-listen:b", "can:can0"}) {
    EXPECT_EQ(to_text(parse_endpoint(text)), text);
  }
}

TEST(Endpoint, RefusesWithARemedy) {
  const struct {
    const char* text;
    const char* says;
  } cases[] = {
      {"", "begins with none of"},
      {"ttyUSB0", "begins with none of"},
      {"usb:/dev/ttyUSB0", "begins with none of"},
      {"SERIAL:/dev/ttyUSB0", "begins with none of"},
      {"SERIAL:/dev/ttyUSB0", "write serial:/dev/ttyUSB0"},
      {"CAN:vcan0", "write can:vcan0"},
      {"Tcp-Listen:6000", "write tcp-listen:6000"},
      {"CAN", "write for example serial:"},
      {"/dev/ttyUSB0", "write serial:/dev/ttyUSB0@2000000"},
      {"serial:", "names no device"},
      {"serial:@115200", "names no device"},
      {"serial:ttyUSB0", "begins with '/'"},
      {"serial:/dev/ttyUSB0@", "rate"},
      {"serial:/dev/ttyUSB0@fast", "rate"},
      {"serial:/dev/ttyUSB0@-9600", "rate"},
      {"serial:/dev/ttyUSB0@2000000.0", "rate"},
      {"serial:/dev/ttyUSB0@99", "rate"},
      {"serial:/dev/ttyUSB0@99999999999999999999", "rate"},
      {"tcp:", "needs a host and a port"},
      {"tcp:6000", "needs a host and a port"},
      {"tcp::6000", "names no host"},
      {"tcp:host:", "port"},
      {"tcp:host:0", "port"},
      {"tcp:host:65536", "port"},
      {"tcp:host:http", "port"},
      {"tcp:::1:6000", "brackets"},
      {"tcp-listen:", "port"},
      {"tcp-listen:abc", "port"},
      {"tcp:host:6000,token=", "names no file"},
      {"unix:", "names no path"},
      {"unix-listen:", "names no path"},
      {"can:", "names no interface"},
      {"can:can0@1000000", "bit rate is the interface's"},
      {"can:/dev/serial/by-id/adapter", "slcand -o -s8 /dev/serial/by-id/adapter can0"},
      {"can:can0/", "no such names"},
      {"can:sixteen-letters!", "15 characters"},
  };
  for (const auto& [text, says] : cases) {
    const std::string why = refusal(text);
    EXPECT_NE(why.find(says), std::string::npos) << text << ": " << why;
    EXPECT_NE(why.find("write "), std::string::npos) << why;
    EXPECT_EQ(why.find('\n'), std::string::npos);
  }
  EXPECT_NE(refusal("unix:/" + std::string(107, 'a')).find("107 characters"), std::string::npos);
  EXPECT_EQ(refusal("unix:/" + std::string(106, 'a')), "");
}

// Any text gives an endpoint that parses to itself, or an EndpointError.
TEST(Endpoint, IsTotal) {
  std::mt19937 random(1);
  const std::string letters = "serialptcunx-:/@[].0129 \t";
  for (int i = 0; i < 100'000; ++i) {
    const char* heads[] = {"", "serial:/", "tcp:", "tcp-listen:", "unix:", "pty:", "can:"};
    std::string text = heads[random() % 7];
    for (std::size_t n = random() % 12; n > 0; --n) text += letters[random() % letters.size()];
    try {
      const Endpoint endpoint = parse_endpoint(text);
      ASSERT_EQ(parse_endpoint(to_text(endpoint)), endpoint) << text;
    } catch (const EndpointError&) {
    }
  }
}

}  // namespace
}  // namespace verp::link
