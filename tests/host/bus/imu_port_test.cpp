#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>

#include <atomic>
#include <cerrno>
#include <map>

#include "host/os/imu/imu_port.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/os/link/link_error.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/twin/imu/bno055_model.hpp"

// host/os/imu on an I2C bus whose kernel is the test.
namespace verp::imu {
namespace {

class FakeI2c final : public I2cCalls {
 public:
  int open(const char*) override {
    ++opened;
    errno = error;
    return error == 0 ? ::open("/dev/null", O_RDWR | O_CLOEXEC) : -1;
  }
  int transfer(int, i2c_rdwr_ioctl_data& messages) override {
    i2c_msg* part = messages.msgs;
    if (gone) return errno = ENODEV, -1;
    if (part->addr != address) return errno = ENXIO, -1;
    const std::uint64_t now_us = link::monotonic_ns() / 1000;
    const std::uint8_t at = part->buf[0];
    if (messages.nmsgs == 1 && part->len > 1) {
      return chip.write(at, part->buf + 1, part->len - 1u, now_us) ? 1 : (errno = EIO, -1);
    }
    chip.measure({.gyro_count = {7, 8, 9}, .accel_count = {0, 0, 981}});
    return chip.read(at, part[1].buf, part[1].len, now_us) ? 2 : (errno = EIO, -1);
  }

  Bno055Model chip;
  std::uint16_t address = 0x28;
  int error = 0, opened = 0;
  std::atomic<bool> gone = false;
};

const auto kNever = [] { return false; };

std::string refusal(const std::string& words, FakeI2c& bus) {
  try {
    ImuPort(parse_imu(words), kNever, bus);
  } catch (const link::LinkError& error) {
    return error.what();
  } catch (const link::EndpointError& error) {
    return error.what();
  }
  return "";
}

/// Reads every 5 ms until this status, at most for two seconds.
bool comes(ImuPort& port, hal::ImuStatus wanted) {
  hal::ImuSample sample;
  for (int i = 0; i < 400; ++i) {
    if (port.read(sample) == wanted) return true;
    link::sleep_until_ns(link::monotonic_ns() + 5'000'000);
  }
  return false;
}

TEST(ImuPort, MeasuresOnI2cAndFindsABusThatComesBack) {
  FakeI2c bus;
  ImuPort port(parse_imu("i2c:/dev/i2c-1,bno055"), kNever, bus);
  hal::ImuSample sample;
  ASSERT_EQ(port.read(sample), hal::ImuStatus::kFresh);
  EXPECT_EQ(sample.gyro_count[2], 9);
  port.start(41);
  EXPECT_TRUE(comes(port, hal::ImuStatus::kFresh));
  bus.gone = true;
  EXPECT_TRUE(comes(port, hal::ImuStatus::kFault));
  bus.gone = false;
  EXPECT_TRUE(comes(port, hal::ImuStatus::kFresh));
  EXPECT_GT(bus.opened, 1);
}

TEST(ImuPort, SaysWhatIsWrongAndHowToMendIt) {
  FakeI2c bus;
  bus.address = 0x29;
  EXPECT_NE(refusal("i2c:/dev/i2c-1,bno055", bus).find("--imu i2c:/dev/i2c-1,bno055,address=0x29"),
            std::string::npos);
  bus.address = 0x28;
  bus.chip.chip_id = 0x11;
  EXPECT_NE(refusal("i2c:/dev/i2c-1,bno055", bus).find("no such chip answers; check 3.3 V"),
            std::string::npos);
  bus.error = EACCES;
  EXPECT_NE(refusal("i2c:/dev/i2c-1,bno055", bus).find("usermod -aG i2c"), std::string::npos);
  bus.error = ENOENT;
  EXPECT_NE(refusal("i2c:/dev/i2c-1,bno055", bus).find("/dev/i2c-1: no such device"),
            std::string::npos);
}

TEST(ImuPlace, MountTellsWhereTheChipsAxesPoint) {
  const ImuPlace place = parse_imu("i2c:/dev/i2c-3,bno055,address=0x29,mount=-y:x:z");
  EXPECT_EQ(to_text(place), "bno055 on /dev/i2c-3, address 0x29");
  const std::array<float, 9> turned = {0, 1, 0, -1, 0, 0, 0, 0, 1};
  ASSERT_TRUE(place.body_imu);
  EXPECT_EQ(*place.body_imu, turned);
  EXPECT_FALSE(parse_imu("serial:/dev/ttyUSB0,bno055").body_imu);
}

TEST(ImuPlace, WhatCannotBeIsRefusedWithTheRightForm) {
  const std::map<std::string, std::string> cases = {
      {"usb:1,bno055", "i2c:/dev/i2c-1,CHIP"},
      {"i2c:/dev/i2c-1", "i2c:/dev/i2c-1,CHIP"},
      {"i2c:,bno055", "i2c:/dev/i2c-1,CHIP"},
      {"i2c:/dev/i2c-1,bno56", "choose one of: bno055"},
      {"i2c:/dev/i2c-1,bno055,address=0x50", "0x28 or 0x29"},
      {"serial:/dev/ttyUSB0,bno055,address=0x28", "'address=0x28' is unknown"},
      {"i2c:/dev/i2c-1,bno055,mount=y:x:z", "turn the sign of one axis"},
      {"i2c:/dev/i2c-1,bno055,mount=x:x:z", "mount=-y:x:z"},
      {"i2c:/dev/i2c-1,bno055,mount=x:y", "mount=-y:x:z"}};
  for (const auto& [words, said] : cases) {
    FakeI2c bus;
    EXPECT_NE(refusal(words, bus).find(said), std::string::npos) << refusal(words, bus);
  }
}

}  // namespace
}  // namespace verp::imu
