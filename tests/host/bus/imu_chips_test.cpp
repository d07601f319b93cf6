#include <gtest/gtest.h>

#include "tests/contract/pc/imus.hpp"

// Drivers of IMUs at a PC, against register models. tests/contract/imu_test.cpp: what all Imus do.
namespace verp::test {
namespace {

using hal::ImuStatus;

template <class Rig>
class Bno055 : public ::testing::Test {
 protected:
  ~Bno055() override { EXPECT_EQ(rig.model.violations(), 0u) << "against the data sheet"; }
  /// Samples every 10 ms; the last status.
  ImuStatus measure_for(std::uint32_t time_us) {
    ImuStatus status = ImuStatus::kStale;
    const std::uint64_t end_us = rig.clock.now_us() + time_us;
    while (rig.clock.now_us() < end_us) {
      rig.model.measure({.gyro_count = {1, 2, 3}, .accel_count = {0, 0, 981}});
      status = rig.turn(10'000);
    }
    return status;
  }
  Rig rig;
};
using Ways = ::testing::Types<Bno055OnI2c, Bno055OnUart>;
TYPED_TEST_SUITE(Bno055, Ways);

TYPED_TEST(Bno055, GivesRatesAndAccelerationsOfItsOwnAxes) {
  this->rig.model.noisy = false;
  this->rig.model.measure({.gyro_count = {-1, 2000, -3000}, .accel_count = {-5, 60, -981}});
  hal::ImuSample sample;
  ASSERT_EQ(this->rig.read(sample), ImuStatus::kFresh);
  const std::int16_t gyro[] = {-1, 2000, -3000}, accel[] = {-5, 60, -981};
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(sample.gyro_count[axis], gyro[axis]);
    EXPECT_EQ(sample.accel_count[axis], accel[axis]);
  }
  EXPECT_EQ(this->rig.model.reg(1, 0x08), 0x0E) << "8 g, 62.5 Hz";
  EXPECT_EQ(this->rig.model.reg(1, 0x0A), 0x18) << "2000 deg/s, 47 Hz";
}

TYPED_TEST(Bno055, IsFoundAgainAfterADipOfItsSupply) {
  ASSERT_EQ(this->measure_for(100'000), ImuStatus::kFresh);
  this->rig.model.dip(this->rig.clock.now_us());
  EXPECT_EQ(this->measure_for(600'000), ImuStatus::kFault);
  EXPECT_FALSE(this->rig.model.measures());
  EXPECT_EQ(this->measure_for(200'000), ImuStatus::kFresh) << "set up anew, without a reset";
  EXPECT_EQ(this->rig.model.reg(0, 0x3B), 0) << "units";
}

TYPED_TEST(Bno055, ASampleOfALostModeIsNone) {
  ASSERT_EQ(this->measure_for(100'000), ImuStatus::kFresh);
  this->rig.model.dip(this->rig.clock.now_us());
  this->rig.clock.advance(700'000);  // nobody has looked meanwhile
  hal::ImuSample sample;
  this->rig.reader.read(sample);
  EXPECT_EQ(this->rig.turn(), ImuStatus::kFault);
  EXPECT_EQ(this->measure_for(100'000), ImuStatus::kFresh);
}

TYPED_TEST(Bno055, ThatFreezesIsAFaultAndIsReset) {
  ASSERT_EQ(this->measure_for(100'000), ImuStatus::kFresh);
  this->rig.model.frozen = true;
  EXPECT_EQ(this->measure_for(90'000), ImuStatus::kStale);
  bool failed = false;
  for (int i = 0; i < 5; ++i) failed = this->rig.turn(10'000) == ImuStatus::kFault || failed;
  EXPECT_TRUE(failed);
  this->rig.model.frozen = false;
  EXPECT_EQ(this->measure_for(1'000'000), ImuStatus::kFresh);
}

TYPED_TEST(Bno055, AnotherChipIsNeverTakenForOne) {
  this->rig.model.chip_id = 0x68;
  this->rig.model.dip(this->rig.clock.now_us());
  EXPECT_EQ(this->measure_for(2'000'000), ImuStatus::kFault);
}

TEST(Bno055Uart, ARefusalByABusyChipIsAskedAgain) {
  Bno055OnUart rig;
  rig.wire.port.overruns = 3;
  rig.measure(7);
  EXPECT_EQ(rig.reader.status(), ImuStatus::kFresh);
  rig.wire.port.overruns = 4;
  rig.measure(8);
  EXPECT_EQ(rig.reader.status(), ImuStatus::kFault);
  rig.measure(9);
  EXPECT_EQ(rig.reader.status(), ImuStatus::kFresh);
}

TEST(Bno055Uart, WaitsNoLongerThanARegisterBusMay) {
  Bno055OnUart rig;
  rig.model.silent = true;
  const std::uint64_t before_us = rig.clock.now_us();
  std::uint8_t data = 0;
  EXPECT_FALSE(rig.uart.read(0, &data, 1));
  EXPECT_LE(rig.clock.now_us() - before_us, hal::kRegisterMaxWait_us);
}

TEST(Icm42688, ReadsBothSensorsAndIsSetUpAgainAfterADip) {
  Icm42688Rig rig;
  rig.model.measure({-1, 2000, -3000}, {-5, 60, -8192});
  hal::ImuSample sample;
  ASSERT_EQ(rig.read(sample), ImuStatus::kFresh);
  const std::int16_t gyro[] = {-1, 2000, -3000}, accel[] = {-5, 60, -8192};
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(sample.gyro_count[axis], gyro[axis]);
    EXPECT_EQ(sample.accel_count[axis], accel[axis]);
  }
  EXPECT_EQ(rig.model.reg(0x4F), 0x0F) << "2000 deg/s, 500 Hz";
  EXPECT_EQ(rig.model.reg(0x50), 0x4F) << "4 g, 500 Hz";
  rig.model.dip(rig.clock.now_us());
  for (int i = 0; i < 40; ++i) {
    rig.model.measure({1, 2, 3}, {0, 0, 8192});
    rig.turn(5'000);
  }
  EXPECT_EQ(rig.read(sample), ImuStatus::kFresh);
  EXPECT_EQ(rig.model.reg(0x52), 0x66) << "low pass";
}

TEST(Mpu6050, ReadsBothSensorsAndIsSetUpAgainAfterADip) {
  Mpu6050Rig rig;
  rig.model.motion({-1, 2000, -3000}, {-5, 60, -8192});
  rig.model.frozen = false;
  rig.clock.advance(10'000);
  hal::ImuSample sample;
  ASSERT_EQ(rig.read(sample), ImuStatus::kFresh);
  EXPECT_EQ(sample.gyro_count[2], -3000);
  EXPECT_EQ(sample.accel_count[1], 60);
  EXPECT_EQ(rig.model.reg(0, 0x1C), 8) << "4 g";
  EXPECT_EQ(rig.model.reg(0, 0x1B), 0x18) << "2000 deg/s";
  rig.model.forget();
  EXPECT_EQ(rig.read(sample), ImuStatus::kFault);
  for (int i = 0; i < 60; ++i) {
    rig.clock.advance(5'000);
    rig.reader.turn();
  }
  EXPECT_EQ(rig.read(sample), ImuStatus::kFresh);
  EXPECT_EQ(rig.model.reg(0, 0x1C), 8);
}

TEST(ImuReader, AfterAPauseOldSamplesDoNotCount) {
  Bno055OnI2c rig;
  for (int i = 0; i < 100; ++i) rig.measure(1000);
  for (int i = 0; i < 64; ++i) rig.measure(10);
  hal::ImuSample sample;
  ASSERT_EQ(rig.read(sample), ImuStatus::kFresh);
  EXPECT_LT(sample.gyro_count[0], 500);
}

}  // namespace
}  // namespace verp::test
