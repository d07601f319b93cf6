#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>

#include <atomic>
#include <cerrno>
#include <map>

#include "host/os/imu/imu_port.hpp"
#include "host/os/imu/mount.hpp"
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
    if (at == 0x75 && who_am_i != 0) return part[1].buf[0] = who_am_i, 2;
    chip.measure({.gyro_count = {7, 8, 9}, .accel_count = {0, 0, 981}});
    return chip.read(at, part[1].buf, part[1].len, now_us) ? 2 : (errno = EIO, -1);
  }

  Bno055Model chip;
  std::uint16_t address = 0x28;
  std::uint8_t who_am_i = 0;  ///< of another chip
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
  bus.address = 0x68;
  bus.chip.chip_id = 0x11;
  bus.who_am_i = 0x47;
  EXPECT_NE(refusal("i2c:/dev/i2c-1,mpu6050", bus)
                .find("is icm42688p; give --imu i2c:/dev/i2c-1,icm42688p,address=0x68"),
            std::string::npos);
  bus.address = 0x28;
  bus.who_am_i = 0;
  EXPECT_NE(refusal("i2c:/dev/i2c-1,bno055", bus).find("no such chip answers; check 3.3 V"),
            std::string::npos);
  bus.error = EACCES;
  EXPECT_NE(refusal("i2c:/dev/i2c-1,bno055", bus).find("usermod -aG i2c"), std::string::npos);
  bus.error = ENOENT;
  EXPECT_NE(refusal("i2c:/dev/i2c-1,bno055", bus).find("/dev/i2c-1: no such device"),
            std::string::npos);
}

/// A chip with this mounting feels the robot upright, and tilted forward by 30 degrees.
Mount mount_felt(const std::string& words) {
  const std::array<float, 9> body_imu = *parse_imu("i2c:/dev/i2c-1,bno055," + words).body_imu;
  const double poses[2][3] = {{0, 0, 9.8}, {-4.9, 0, 8.49}};
  std::array<double, 3> felt[2] = {};
  for (std::size_t pose = 0; pose < 2; ++pose) {
    for (std::size_t i = 0; i < 9; ++i) {
      felt[pose][i % 3] += static_cast<double>(body_imu[i]) * poses[pose][i / 3];
    }
  }
  return find_mount(felt[0], felt[1]);
}

TEST(Mount, IsFoundByTwoPosesOfTheRobot) {
  for (const std::string words : {"mount=x:y:z", "mount=-y:x:z", "mount=x:-y:-z", "mount=z:x:y",
                                  "mount=y:-z:-x", "mount=-z:-y:-x"}) {
    EXPECT_EQ(mount_felt(words).words, words);
    EXPECT_LT(mount_felt(words).askew_rad, 0.01);
  }
  EXPECT_EQ(find_mount({0, 0, 9.8}, {0, 0, 9.8}).words, "") << "not tilted";
  EXPECT_EQ(find_mount({0, 0, 0}, {0, 0, 9.8}).words, "") << "nothing felt";
  EXPECT_NEAR(find_mount({0, 0, 9.8}, {-4.2, 2.45, 8.49}).askew_rad, 0.53, 0.01)
      << "turned by 30 degrees";
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
