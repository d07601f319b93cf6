#pragma once
#include "boards/stm32/hardware.hpp"
#include "common/model/params.hpp"
#include "hal/chip/invensense/motion_sensor.hpp"
#include "hal/chip/invensense/ranges.hpp"
#include "hal/chip/stm32/spi_master.hpp"

namespace verp::board {

/// The motion sensor on kSensorImu, uncalibrated. Alternative: boards/stm32/sensor/turning.
class SensorChip {
 public:
  explicit SensorChip(const ImuParams& imu)
      : fits_(hal::invensense::choose_ranges(imu.gyro_rad_s_per_count, imu.accel_m_s2_per_count,
                                             ranges_)) {}

  /// False: the chip lacks the scales of the robot's IMU.
  bool open(const Start& start) {
    spi_.open(kSensorImu.on_apb2 ? start.clocks.apb2_hz : start.clocks.apb1_hz);
    return fits_;
  }
  hal::ImuStatus read(hal::ImuSample& sample) { return sensor_.read(sample); }

 private:
  using Spi = stm32::SpiMaster<Io, Timer>;

  hal::invensense::Ranges ranges_;
  bool fits_;
  Spi spi_{kFamily, kSensorImu.wiring, timer};
  hal::invensense::MotionSensor<Spi, Timer> sensor_{spi_, timer, ranges_};
};

}  // namespace verp::board
