#pragma once
#include "boards/stm32/hardware.hpp"
#include "common/math/convert.hpp"
#include "common/model/params.hpp"
#include "firmware/app/sensor_registers.hpp"

namespace verp::board {

/// For an emulator, which has no motion sensor: one that lies level and turns by 0.5 rad/s.
/// Alternatives: boards/stm32/sensor/chip, foot.
class SensorChip {
 public:
  static constexpr std::uint16_t kModel = dxl::kModelImu;
  /// Half the chip's sample period: one sample a read, and none is lost.
  static constexpr std::uint64_t kSample_us = 1'000;
  static constexpr bool kWaits = true;  ///< for the bytes, up to 0.1 ms

  explicit SensorChip(const Params& params) : id_(params.imu.device_id) {
    motion_.gyro_count[2] =
        static_cast<std::int16_t>(math::to_int32(0.5F / params.imu.gyro_rad_s_per_count));
    motion_.accel_count[2] =
        static_cast<std::int16_t>(math::to_int32(9.80665F / params.imu.accel_m_s2_per_count));
  }

  bool open(const Start&) { return true; }
  std::uint8_t id() const { return id_; }
  void sample(app::SensorRegisters& registers) { registers.add(motion_); }

 private:
  std::uint8_t id_;
  hal::ImuSample motion_;
};

}  // namespace verp::board
