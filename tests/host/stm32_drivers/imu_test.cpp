#include <functional>

#include "hal/chip/invensense/ranges.hpp"
#include "tests/host/stm32_drivers/imu_driver.hpp"

namespace verp::hal::stm32::test {
namespace {

INSTANTIATE_TEST_SUITE_P(, MotionSensorDriver,
                         ::testing::Values(Which{Family::kF405, ImuKind::kMpu9250},
                                           Which{Family::kF746, ImuKind::kMpu9250},
                                           Which{Family::kF405, ImuKind::kIcm20648},
                                           Which{Family::kF746, ImuKind::kIcm20648}),
                         [](const ::testing::TestParamInfo<Which>& which) {
                           return std::string(which.param.kind == ImuKind::kMpu9250 ? "Mpu9250"
                                                                                    : "Icm20648") +
                                  (which.param.family == Family::kF405 ? "OnF405" : "OnF746");
                         });

TEST_P(MotionSensorDriver, FindsTheChipByItselfAndGivesItsCounts) {
  ASSERT_TRUE(board.starts());
  EXPECT_EQ(board.imu.faults(), 0u) << "coming up is no fault";
  EXPECT_EQ(board.sample.gyro_count[0], 1);
  EXPECT_EQ(board.sample.gyro_count[1], -2);
  EXPECT_EQ(board.sample.gyro_count[2], 32767);
  EXPECT_EQ(board.sample.accel_count[0], -32768);
  EXPECT_EQ(board.sample.accel_count[1], 5);
  EXPECT_EQ(board.sample.accel_count[2], 6);
}

// A new sample every 8 ms; a frozen chip gives no more.
TEST_P(MotionSensorDriver, GivesEachSampleOnceAndNewOnesInTime) {
  ASSERT_TRUE(board.starts());
  for (std::int16_t i = 0; i < 200; ++i) {
    board.device.motion({i, 0, 0}, {0, i, 0});
    board.rig.machine.advance(ms(8));
    const std::uint64_t last_us = board.sample.time_us;
    ASSERT_EQ(board.read(), ImuStatus::kFresh) << i;
    EXPECT_EQ(board.sample.gyro_count[0], i);
    EXPECT_EQ(board.sample.accel_count[1], i);
    EXPECT_GT(board.sample.time_us, last_us);
    board.device.frozen = true;
    board.read();  // perhaps one more sample
    EXPECT_EQ(board.read(), ImuStatus::kStale);
    board.device.frozen = false;
  }
  EXPECT_EQ(board.imu.faults(), 0u);
}

TEST_P(MotionSensorDriver, SilentForeignAndStuckChipsAreFaultsUntilTheyWorkAgain) {
  model::SpiModel& bus = board.rig.machine.spi(1);
  bool* const scripts[] = {&board.device.silent, &bus.miso_stuck_high, &bus.miso_stuck_low,
                           &bus.busy_stuck};
  for (bool* script : scripts) {
    ASSERT_TRUE(board.starts());
    const std::uint32_t faults = board.imu.faults();
    const ImuSample kept = board.sample;
    *script = true;
    for (std::uint32_t i = 1; i <= 20; ++i) {
      EXPECT_EQ(board.read(), ImuStatus::kFault);
      EXPECT_EQ(board.imu.faults(), faults + i);
      board.rig.machine.advance(ms(8));
    }
    EXPECT_EQ(board.sample.time_us, kept.time_us) << "only a fresh read changes the sample";
    *script = false;
  }
  board.device.who_am_i = 0x12;
  board.device.forget();
  EXPECT_EQ(board.read(), ImuStatus::kFault);
  EXPECT_EQ(board.read(), ImuStatus::kFault) << "another chip is not spoken to";
  board.device.who_am_i = -1;
  EXPECT_TRUE(board.starts());
}

TEST_P(MotionSensorDriver, ChipThatStopsSamplingIsAFaultAndIsStartedAnew) {
  ASSERT_TRUE(board.starts());
  board.device.frozen = true;
  bool failed = false;
  for (int tick = 0; tick < 20 && !failed; ++tick) {
    board.rig.machine.advance(ms(8));
    const ImuStatus status = board.read();
    EXPECT_TRUE(tick < 1 || status != ImuStatus::kFresh);
    failed = status == ImuStatus::kFault;
  }
  EXPECT_TRUE(failed) << "a second would be too long for a robot that walks";
  board.device.frozen = false;
  EXPECT_TRUE(board.starts());
}

// Wrong scales are worse than no data.
TEST_P(MotionSensorDriver, ChipThatLostItsSettingsIsNotBelieved) {
  ASSERT_TRUE(board.starts());
  board.device.forget();
  board.rig.machine.advance(ms(8));
  EXPECT_EQ(board.read(), ImuStatus::kFault);
  EXPECT_TRUE(board.starts());
}

/// Acts after the nth exchange or drops a write.
struct Meddler {
  bool exchange(const std::uint8_t* out, std::uint8_t* in, std::size_t size, std::uint32_t max_hz) {
    if (out[0] == lost_write) return true;
    const bool good = spi.exchange(out, in, size, max_hz);
    if (countdown-- == 0) then();
    return good;
  }
  Spi& spi;
  int countdown = -1;
  std::function<void()> then = [] {};
  int lost_write = -1;
};

TEST_P(MotionSensorDriver, SampleThatComesMeanwhileIsToldOnce) {
  Meddler bus{board.spi};
  invensense::MotionSensor<Meddler, Timer> imu(bus, board.rig.timer);
  ImuSample sample;
  for (int tick = 0; tick < 40; ++tick, pause(8'000)) imu.read(sample);
  board.device.frozen = true;
  imu.read(sample);
  board.device.frozen = false;
  number_samples();
  bus.then = [this] { pause(2'500); };
  for (int place = 0; place < 3; ++place) {
    pause(8'000);
    const int first_part = newest;
    bus.countdown = place;
    ASSERT_EQ(imu.read(sample), ImuStatus::kFresh);
    expect_up_to(first_part, sample);
    const int last = newest;
    EXPECT_GT(last, first_part);
    ASSERT_EQ(imu.read(sample), ImuStatus::kFresh);
    expect_up_to(last, sample);
  }
}

TEST_P(MotionSensorDriver, FifoThatStaysFullIsAFault) {
  Meddler bus{board.spi};
  invensense::MotionSensor<Meddler, Timer> imu(bus, board.rig.timer);
  ImuSample sample;
  for (int tick = 0; tick < 40; ++tick, pause(8'000)) imu.read(sample);
  bus.lost_write = GetParam().kind == ImuKind::kMpu9250 ? 0x6A : 0x68;
  pause(60'000);
  for (int tick = 0; tick < 20 && imu.faults() == 0; ++tick, pause(8'000)) {
    EXPECT_NE(imu.read(sample), ImuStatus::kFresh);
  }
  EXPECT_EQ(imu.faults(), 1u);
  bus.lost_write = -1;
  ImuStatus status = ImuStatus::kStale;
  for (int tick = 0; tick < 40; ++tick, pause(8'000)) status = imu.read(sample);
  EXPECT_EQ(status, ImuStatus::kFresh);
}

TEST_P(MotionSensorDriver, SettingThatDoesNotTakeIsAFault) {
  Meddler bus{board.spi};
  bus.lost_write = GetParam().kind == ImuKind::kMpu9250 ? 0x1B : 0x01;  // the gyroscope's scale
  invensense::MotionSensor<Meddler, Timer> imu(bus, board.rig.timer);
  ImuSample sample;
  for (int tick = 0; tick < 100; ++tick, board.rig.machine.advance(ms(8))) {
    EXPECT_NE(imu.read(sample), ImuStatus::kFresh);
  }
  EXPECT_GT(imu.faults(), 0u);
}

// Below half the rate of reads, so nothing aliases.
TEST(MotionSensorLowPass, IsThatOfTheTwin) {
  ImuRig mpu(Family::kF405, ImuKind::kMpu9250);
  ASSERT_TRUE(mpu.starts());
  EXPECT_EQ(mpu.device.reg(0, 0x1A) & 7, 4) << "20 Hz";
  EXPECT_EQ(mpu.device.reg(0, 0x1D) & 15, 4) << "21.2 Hz";
  ImuRig icm(Family::kF746, ImuKind::kIcm20648);
  ASSERT_TRUE(icm.starts());
  EXPECT_EQ(icm.device.reg(2, 0x01) & 0x39, 4 << 3 | 1) << "23.9 Hz";
  EXPECT_EQ(icm.device.reg(2, 0x14) & 0x39, 4 << 3 | 1) << "23.9 Hz";
}

TEST(MotionSensorRanges, AreSetInTheChip) {
  for (std::uint8_t gyro = 0; gyro < 4; ++gyro) {
    const std::uint8_t accel = static_cast<std::uint8_t>(3 - gyro);
    ImuRig mpu(Family::kF405, ImuKind::kMpu9250, {gyro, accel});
    ASSERT_TRUE(mpu.starts());
    EXPECT_EQ(mpu.device.reg(0, 0x1B) >> 3, gyro);
    EXPECT_EQ(mpu.device.reg(0, 0x1C) >> 3, accel);
    ImuRig icm(Family::kF746, ImuKind::kIcm20648, {gyro, accel});
    ASSERT_TRUE(icm.starts());
    EXPECT_EQ(icm.device.reg(2, 0x01) >> 1 & 3, gyro);
    EXPECT_EQ(icm.device.reg(2, 0x14) >> 1 & 3, accel);
    EXPECT_EQ(icm.device.reg(0, 0x7F), 0) << "data is in bank 0";
  }
}

TEST(MotionSensorRanges, AreThoseOfTheParamsOrNone) {
  constexpr float kRadPerDegree = 0.0174532925F;
  for (int gyro = 0; gyro < 4; ++gyro) {
    for (int accel = 0; accel < 4; ++accel) {
      const float gyro_scale = static_cast<float>(250 << gyro) * kRadPerDegree / 32768.0F;
      const float accel_scale = static_cast<float>(2 << accel) * 9.80665F / 32768.0F;
      invensense::Ranges ranges;
      ASSERT_TRUE(invensense::choose_ranges(gyro_scale, accel_scale, ranges));
      EXPECT_EQ(ranges.gyro, gyro);
      EXPECT_EQ(ranges.accel, accel);
      EXPECT_FALSE(invensense::choose_ranges(1.3F * gyro_scale, accel_scale, ranges));
      EXPECT_FALSE(invensense::choose_ranges(gyro_scale, 1.3F * accel_scale, ranges));
    }
  }
  invensense::Ranges ranges;
  EXPECT_FALSE(invensense::choose_ranges(0.0F, 0.0F, ranges));
}

}  // namespace
}  // namespace verp::hal::stm32::test
