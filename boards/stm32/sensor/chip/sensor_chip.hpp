#pragma once
#include "boards/stm32/hardware.hpp"
#include "common/model/params.hpp"
#include "firmware/app/sensor_registers.hpp"
#include "hal/chip/invensense/motion_sensor.hpp"
#include "hal/chip/invensense/ranges.hpp"
#include "hal/chip/stm32/spi_master.hpp"

namespace verp::board {

/// The motion sensor on kSensorImu, uncalibrated. Alternatives: boards/stm32/sensor/foot, turning.
class SensorChip {
 public:
  static constexpr std::uint16_t kModel = dxl::kModelImu;
  /// Half the chip's sample period: one sample a read, and none is lost.
  static constexpr std::uint64_t kSample_us = 1'000;
  static constexpr bool kWaits = true;  ///< for the bytes, up to 0.1 ms

  explicit SensorChip(const Params& params)
      : id_(params.imu.device_id),
        fits_(hal::invensense::choose_ranges(params.imu.gyro_rad_s_per_count,
                                             params.imu.accel_m_s2_per_count, ranges_)) {}

  /// False: the chip lacks the scales of the robot's IMU.
  bool open(const Start& start) {
    spi_.open(kSensorImu.on_apb2 ? start.clocks.apb2_hz : start.clocks.apb1_hz);
    return fits_;
  }
  std::uint8_t id() const { return id_; }
  void sample(app::SensorRegisters& registers) {
    hal::ImuSample sample;
    if (sensor_.read(sample) == hal::ImuStatus::kFresh) registers.add(sample);
  }

 private:
  using Spi = stm32::SpiMaster<Io, Timer>;

  std::uint8_t id_;
  hal::invensense::Ranges ranges_;
  bool fits_;
  Spi spi_{kFamily, kSensorImu.wiring, timer};
  hal::invensense::MotionSensor<Spi, Timer> sensor_{spi_, timer, ranges_};
};

}  // namespace verp::board
