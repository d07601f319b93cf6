#include "tests/host/stm32_drivers/imu_driver.hpp"

// Too slow for an emulated board, which leaves this file out (boards/mps2/images.cmake).
namespace verp::hal::stm32::test {
namespace {

// Reads may fall anywhere against the chip's clock.
TEST_P(MotionSensorDriver, TellsEverySampleOnce) {
  ASSERT_TRUE(board.starts());
  read_alone();
  number_samples();
  for (int i = 0; i < 3000; ++i) {
    const ImuSample before = board.sample;
    if (board.read() == ImuStatus::kFresh) {
      const int last = board.sample.gyro_count[0] - (told + 1);
      EXPECT_LE(told + 1, last);
      EXPECT_LE(last, newest);
      expect_up_to(last, board.sample);
    } else {
      EXPECT_EQ(board.sample.gyro_count[0], before.gyro_count[0]);
    }
    pause(static_cast<std::uint64_t>(7 * i % 3331));
  }
  EXPECT_GT(told, 2000);
  pause(4'000);
  const int last = newest;
  read_alone();
  expect_up_to(last, board.sample);
  EXPECT_EQ(board.imu.faults(), 0u);
}

// Each jolt lies between two reads.
TEST_P(MotionSensorDriver, JoltsBetweenReadsAddUpToTheTurn) {
  ASSERT_TRUE(board.starts());
  const double period_us = GetParam().kind == ImuKind::kMpu9250 ? 2000 : 2e6 / 1125;
  int since_read = 0;
  double turn = 0, read_turn = 0;
  board.device.before_sample = [&] {
    const bool jolt = since_read == 1 || since_read == 2;
    const auto rate = static_cast<std::int16_t>(jolt ? 1000 : -20);
    board.device.motion({0, 0, rate}, {0, 0, 0});
    ++since_read;
    turn += period_us * rate;
  };
  pause(10'000);
  board.read();
  turn = since_read = 0;
  for (int tick = 0; tick < 100; ++tick) {
    const std::uint64_t last_us = board.sample.time_us;
    pause(10'000);
    since_read = 0;
    ASSERT_EQ(board.read(), ImuStatus::kFresh);
    const auto passed_us = static_cast<double>(board.sample.time_us - last_us);
    read_turn += passed_us * board.sample.gyro_count[2];
  }
  EXPECT_NEAR(read_turn, turn, 0.03 * turn);
  EXPECT_GT(turn, 100 * 3000 * period_us / 2);
}

}  // namespace
}  // namespace verp::hal::stm32::test
