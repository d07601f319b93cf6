#include "common/protocol/canopen/robot_load.hpp"

#include <gtest/gtest.h>

#include "common/protocol/canopen/sdo.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::canopen::plan {
namespace {

constexpr BitRates kFast = {1'000'000, 1'000'000}, kSlow = {125'000, 125'000};
constexpr BitRates kFd = {1'000'000, 5'000'000};
constexpr std::uint32_t kPeriod_us = 10'000;

Params robot_of(std::uint8_t drives) {
  Params params = verp::test::make_robot();
  params.joint_count = drives;
  params.followers = 0;
  params.baud = 1'000'000;
  params.period_us = kPeriod_us;
  return params;
}
std::uint32_t bits(const Params& params, TickKind kind, bool fd = false) {
  return TickLoad(params, {.stuffing = Stuffing::kWorst, .fd = fd}).bits(kind).all();
}

TEST(RobotLoad, EachFurtherDriveLoadsTheBusMore) {
  for (const bool fd : {false, true}) {
    for (const TickKind kind : {TickKind::kSteady, TickKind::kChange}) {
      for (std::uint8_t drives = 1; drives <= verp::test::kJointCount; ++drives) {
        EXPECT_GT(bits(robot_of(drives), kind, fd),
                  bits(robot_of(static_cast<std::uint8_t>(drives - 1)), kind, fd))
            << "drive " << int{drives};
      }
    }
  }
}

TEST(RobotLoad, AChangeOfAllDrivesLoadsMoreThanASteadyTick) {
  const Params params = robot_of(verp::test::kJointCount);
  EXPECT_GT(bits(params, TickKind::kChange), bits(params, TickKind::kSteady));
}

TEST(RobotLoad, SensorsAddTheirAnswers) {
  Params bare = robot_of(12), full = bare;
  bare.imu.device_id = bare.feet.device_id[0] = bare.feet.device_id[1] = 0;
  full.imu.device_id = 120;
  full.feet.device_id[0] = 111;
  full.feet.device_id[1] = 112;
  EXPECT_GT(bits(full, TickKind::kSteady), bits(bare, TickKind::kSteady) + 4 * 47);
}

TEST(RobotLoad, ARobotIsRefusedWhereItsTicksDoNotFit) {
  const Params params = robot_of(verp::test::kJointCount);
  EXPECT_TRUE(has_room(params, false, kFast, kPeriod_us));
  EXPECT_FALSE(has_room(params, false, kSlow, kPeriod_us));
  EXPECT_FALSE(has_room(params, false, kFast, kPeriod_us / 4));
  EXPECT_TRUE(has_room(params, true, kFd, kPeriod_us / 2)) << "FD has room at 200 Hz";
}

TEST(RobotLoad, SaysHowManyDrivesFit) {
  const Params params = robot_of(verp::test::kJointCount);
  const auto fits = [](const BitRates& rates) {
    return [&rates](const Params& part) { return has_room(part, false, rates, kPeriod_us); };
  };
  EXPECT_EQ(drives_that_fit(params, fits(kFast)), verp::test::kJointCount);
  const int few = drives_that_fit(params, fits(kSlow));
  EXPECT_LT(few, verp::test::kJointCount);
  EXPECT_FALSE(fits(kSlow)(robot_of(static_cast<std::uint8_t>(few + 1))));
  EXPECT_EQ(drives_that_fit(params, [](const Params&) { return false; }), 0);
}

TEST(RobotLoad, PublishesOnlyWhereOrdersStillFit) {
  Params params = robot_of(6);
  EXPECT_TRUE(has_room_to_publish(params, false));
  EXPECT_TRUE(has_room_to_publish(params, true)) << "the IMU's counts have room, too";
  Params full = robot_of(verp::test::kJointCount);
  EXPECT_TRUE(has_room_to_publish(full, true)) << "21 drives at 100 Hz";
  full.period_us = 7'000;
  EXPECT_FALSE(has_room_to_publish(full, true)) << "21 drives at 143 Hz";
  params.baud = 125'000;
  EXPECT_FALSE(has_room_to_publish(params, false));
  params.baud = 0;
  EXPECT_FALSE(has_room_to_publish(params, true)) << "no baud rate";
  params.baud = 1'000'000;
  params.period_us = 0;
  EXPECT_FALSE(has_room_to_publish(params, true)) << "no period";
}

TEST(RobotLoad, ATickTakesAsLongAsItsBits) {
  const Params params = robot_of(verp::test::kJointCount);
  EXPECT_NEAR(tick_us(params), bits(params, TickKind::kSteady), 1) << "a bit takes 1 us";
}

TEST(SdoAbort, EachCodeHasWordsAndAnUnknownOneSaysSo) {
  EXPECT_STREQ(abort_text(Abort::kNoData), "no data");
  EXPECT_STREQ(abort_text(static_cast<Abort>(0x12345678)), "unknown abort code");
}

}  // namespace
}  // namespace verp::canopen::plan
