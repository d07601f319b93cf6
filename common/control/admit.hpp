#pragma once
#include "common/base/fields.hpp"
#include "common/io/io.hpp"
#include "common/math/linear.hpp"
#include "common/model/params.hpp"
#include "common/safety/trust.hpp"

namespace verp {

/// Bad readings in a row that alarm a servo. Each of 21 servos is read every 0.2 s: in half a
/// second no glitch lasts and no hot servo cools.
inline constexpr int kAlarmReadings = 3;
/// Low readings in a row, of any servos, that mean a low supply: all servos share it. 0.2 s at 10
/// ms outlasts a step's current peak. A single low servo has a bad cable and reports a hardware
/// error.
inline constexpr std::uint8_t kSupplyReadings = 21;

/// Equal fresh readings in a row that mean a frozen IMU. Noise moves an ICM-20648's counts by 1.5
/// (gyro) and 9 (accelerometer) one sigma: this many are equal once in 1e15, even with all sigmas a
/// third of a count. At 10 ms an IMU may update at 5 Hz.
inline constexpr std::uint8_t kFrozenReadings = 20;
/// Age of a device never heard: beyond every limit.
inline constexpr std::uint8_t kNeverHeard = 255;

/// Ages count all control periods, also those without a tick.
struct AdmitState {
  std::uint8_t servo_age[kMaxJoints] = {};  ///< since the servo last reported, up to 255
  std::uint32_t tick = 0;                   ///< Inputs::tick of the last tick
  std::uint32_t operator_age = 0;           ///< since the last order, saturating
  /// Bit j of both: readings in a row of servo j with heat or an error. Gray code (high, low): 00,
  /// 01, 11, 10 for 0 to kAlarmReadings.
  std::uint32_t alarm_low = 0;
  std::uint32_t alarm_high = 0;
  std::int16_t imu_count[6] = {};  ///< last fresh gyro and accelerometer
  std::uint8_t imu_age = 0;        ///< up to 255
  std::uint8_t voltage_low = 0;    ///< low readings in a row, up to 255
  std::uint8_t started = 0;        ///< 0 until start()
  std::uint8_t imu_alike = 0;      ///< fresh unchanged readings, up to kFrozenReadings
  VERP_FIELDS(servo_age, tick, operator_age, alarm_low, alarm_high, imu_count, imu_age, voltage_low,
              started, imu_alike)
};
VERP_PACKED(AdmitState);

struct AdmitOut {
  std::uint32_t conditions = 0;  ///< safety::Condition, from the inputs alone
  std::uint32_t faults = 0;      ///< safety::Fault, of this tick
  bool imu_fresh = false;
  /// After a silence of stale_release_s: forget earlier readings.
  bool imu_anew = false;
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};
  float vx_m_s = 0;
  float vy_m_s = 0;
  float wz_rad_s = 0;
  float head_pan_rad = 0;
  float head_tilt_rad = 0;
};

/// Call before the first tick, with its inputs: no device was heard yet.
void start(const Params& params, const Inputs& inputs, AdmitState& state);

/// Applies a parameter write to `tuning`. A device in doubt counts as silent.
AdmitOut admit(const Params& params, AdmitState& state, Tuning& tuning, const Inputs& inputs,
               const safety::Doubts& doubts = {});

}  // namespace verp
