#pragma once
#include "boards/stm32/hardware.hpp"
#include "common/math/convert.hpp"
#include "common/model/params.hpp"
#include "hal/contract/imu.hpp"

namespace verp::board {

/// For an emulator, which has no motion sensor: one that lies level and turns by 0.5 rad/s.
/// Alternative: boards/stm32/sensor/chip.
class SensorChip {
 public:
  explicit SensorChip(const ImuParams& imu) {
    motion_.gyro_count[2] =
        static_cast<std::int16_t>(math::to_int32(0.5F / imu.gyro_rad_s_per_count));
    motion_.accel_count[2] =
        static_cast<std::int16_t>(math::to_int32(9.80665F / imu.accel_m_s2_per_count));
  }

  bool open(const Start&) { return true; }
  hal::ImuStatus read(hal::ImuSample& sample) {
    sample = motion_;
    return hal::ImuStatus::kFresh;
  }

 private:
  hal::ImuSample motion_;
};

}  // namespace verp::board
