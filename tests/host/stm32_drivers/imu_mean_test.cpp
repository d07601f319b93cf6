#include <cmath>

#include "tests/host/stm32_drivers/imu_driver.hpp"

namespace verp::hal::stm32::test {
namespace {

TEST_P(MotionSensorDriver, RoundsToTheNearest) {
  ASSERT_TRUE(board.starts());
  int count = 0, ones = 0;
  board.device.before_sample = [&] {
    const std::int16_t x = count < ones ? 1 : 0;
    const auto y = static_cast<std::int16_t>(-x);
    board.device.motion({x, y, 32767}, {y, x, -32768});
    ++count;
  };
  for (ones = 0; ones < 8; ++ones) {
    read_alone();
    count = 0;
    pause(13'000);
    const int taken = count;
    ASSERT_EQ(read_alone(), ImuStatus::kFresh);
    const long mean = std::lround(static_cast<double>(ones < taken ? ones : taken) / taken);
    EXPECT_EQ(board.sample.gyro_count[0], mean) << ones << " of " << taken;
    EXPECT_EQ(board.sample.gyro_count[1], -mean) << ones << " of " << taken;
    EXPECT_EQ(board.sample.gyro_count[2], 32767);
    EXPECT_EQ(board.sample.accel_count[0], -mean);
    EXPECT_EQ(board.sample.accel_count[1], mean);
    EXPECT_EQ(board.sample.accel_count[2], -32768);
  }
}

TEST_P(MotionSensorDriver, MissesNothingWithinTheLongestPeriod) {
  ASSERT_TRUE(board.starts());
  read_alone();
  number_samples();
  for (int tick = 0; tick < 50; ++tick) {
    pause(kImuMostPause_us);
    const int last = newest;
    ASSERT_EQ(read_alone(), ImuStatus::kFresh);
    expect_up_to(last, board.sample);
  }
}

// The FIFO's data is old, but the chip works: no fault.
TEST_P(MotionSensorDriver, WhatCameInALongPauseIsDropped) {
  ASSERT_TRUE(board.starts());
  read_alone();
  number_samples();
  constexpr std::uint64_t kPauses_us[] = {30'000, 76'000, 85'000,   86'000,
                                          87'000, 99'000, 2'000'000};
  for (const std::uint64_t pause_us : kPauses_us) {
    pause(pause_us);
    told = newest;
    ASSERT_EQ(read_alone(), ImuStatus::kStale) << pause_us;
    pause(10'000);
    const int last = newest;
    ASSERT_EQ(read_alone(), ImuStatus::kFresh) << pause_us;
    expect_up_to(last, board.sample);
  }
  EXPECT_EQ(board.imu.faults(), 0u);
}

// The driver reads the size during a write and reports the whole sample.
TEST_P(MotionSensorDriver, SampleThatIsBeingWrittenIsAwaited) {
  ASSERT_TRUE(board.starts());
  read_alone();
  number_samples();
  for (std::size_t torn = 1; torn < 12; ++torn) {
    pause(8'000);
    for (const int before = newest; newest == before;) pause(10);
    board.device.torn = torn;
    board.rig.machine.advance(us(2'000));  // the next transfer brings the due one
    const int last = newest + 1;
    ASSERT_EQ(board.read(), ImuStatus::kFresh) << torn;
    expect_up_to(last, board.sample);
    board.device.torn = 0;
  }
  EXPECT_EQ(board.imu.faults(), 0u);
}

// Its bytes belong to another axis.
TEST_P(MotionSensorDriver, FifoOutOfStepIsNotBelieved) {
  ASSERT_TRUE(board.starts());
  read_alone();
  number_samples();
  for (std::size_t lost = 1; lost < 12; ++lost) {
    pause(8'000);
    board.device.slip(lost);
    told = newest;
    EXPECT_EQ(read_alone(), ImuStatus::kStale) << lost;
    pause(8'000);
    const int last = newest;
    ASSERT_EQ(read_alone(), ImuStatus::kFresh) << lost;
    expect_up_to(last, board.sample);
  }
  EXPECT_EQ(board.imu.faults(), 0u);
  for (int tick = 0; tick < 20 && board.imu.faults() == 0; ++tick) {
    pause(8'000);
    board.device.slip(1);
    EXPECT_NE(read_alone(), ImuStatus::kFresh);
  }
  EXPECT_EQ(board.imu.faults(), 1u) << "always out of step";
  EXPECT_TRUE(board.starts());
}

}  // namespace
}  // namespace verp::hal::stm32::test
