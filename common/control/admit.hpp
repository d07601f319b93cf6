#pragma once
#include "common/base/fields.hpp"
#include "common/io/io.hpp"
#include "common/math/linear.hpp"
#include "common/model/params.hpp"

/// First stage: converts raw counts to physical values, ages silent devices and checks the
/// operator's parameter write.
namespace verp {

/// Consecutive bad readings that alarm a servo. One may be noise. Each of 21 servos is read every
/// 0.2 s, so three take half a second: longer than a glitch, and too short for a hot servo to cool.
inline constexpr int kAlarmReadings = 3;
/// Consecutive low readings, of any servos, that mean a low supply: the servos share it. 0.2 s at
/// 10 ms outlasts the current peak of a step. A single servo with low voltage has a bad cable and
/// reports a hardware error.
inline constexpr std::uint8_t kSupplyReadings = 21;

/// Consecutive fresh readings with the same six counts that mean a frozen IMU, which counts as
/// silent. Noise moves the counts: of an ICM-20648 by 1.5 (gyro) and 9 (accelerometer) one sigma,
/// so two readings are equal once in five million. Even with all sigmas at a third of a count, this
/// many are equal once in 1e15. At 10 ms an IMU may update at 5 Hz.
inline constexpr std::uint8_t kFrozenReadings = 20;
/// Age of a device that was never heard: beyond every limit.
inline constexpr std::uint8_t kNeverHeard = 255;

/// Ages count control periods, including those without a tick: a stalled controller has heard
/// nothing.
struct AdmitState {
  std::uint8_t servo_age[kMaxJoints] = {};  ///< since the servo last reported, up to 255
  std::uint32_t tick = 0;                   ///< Inputs::tick of the last tick
  std::uint32_t operator_age = 0;           ///< since the last operator frame, saturating
  /// Bit j of both: consecutive readings of heat or an error of servo j. Gray code: (high, low) is
  /// 00, 01, 11, 10 for 0 to kAlarmReadings.
  std::uint32_t alarm_low = 0;
  std::uint32_t alarm_high = 0;
  std::int16_t imu_count[6] = {};  ///< gyro and accelerometer of the last fresh reading
  std::uint8_t imu_age = 0;        ///< up to 255
  std::uint8_t voltage_low = 0;    ///< consecutive low readings of any servo, up to 255
  std::uint8_t started = 0;        ///< 0 until start()
  std::uint8_t imu_alike = 0;  ///< fresh readings since imu_count changed, up to kFrozenReadings
  VERP_FIELDS(servo_age, tick, operator_age, alarm_low, alarm_high, imu_count, imu_age, voltage_low,
              started, imu_alike)
};
VERP_PACKED(AdmitState);

struct AdmitOut {
  std::uint32_t conditions = 0;  ///< safety::Condition bits that follow from the inputs alone
  std::uint32_t faults = 0;      ///< safety::Fault bits raised this tick
  bool imu_fresh = false;
  /// Fresh after stale_release_s: earlier readings mean nothing any more.
  bool imu_anew = false;
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};
  float vx_m_s = 0;
  float vy_m_s = 0;
  float wz_rad_s = 0;
  float head_pan_rad = 0;
  float head_tilt_rad = 0;
};

/// Call before the first tick with its inputs: marks every device as never heard.
void start(const Params& params, const Inputs& inputs, AdmitState& state);

/// Also applies the tick's parameter write to `tuning`.
AdmitOut admit(const Params& params, AdmitState& state, Tuning& tuning, const Inputs& inputs);

}  // namespace verp
