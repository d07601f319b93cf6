#pragma once
#include "common/base/fields.hpp"
#include "common/io/io.hpp"
#include "common/math/linear.hpp"
#include "common/model/params.hpp"

/// First stage: raw counts become physical values, silence gets an age, an operator's parameter
/// write is checked.
namespace verp {

/// A servo is alarmed when this many readings of its own in a row were bad. One is noise. A servo
/// is read once in a round of all, 0.2 s for 21: three are half a second, in which no glitch lasts
/// and no hot one cools down.
inline constexpr int kAlarmReadings = 3;
/// The supply is low when so many readings in a row were, whichever servos they are of: they share
/// it. 0.2 s at 10 ms: the current of a step's peak is over by then. A servo that alone sees too
/// little has a bad cable, and reports it as a hardware error.
inline constexpr std::uint8_t kSupplyReadings = 21;

/// An IMU whose six counts are the same in this many fresh readings in a row repeats itself, and is
/// silent. Noise moves a count: of an ICM-20648 by 1.5 (gyro) and 9 (accelerometer) one sigma, so
/// that two readings are alike once in five million. This many are alike by chance once in 1e15
/// even where all sigmas are a third of a count; at 10 ms an IMU may renew itself at 5 Hz.
inline constexpr std::uint8_t kFrozenReadings = 20;
/// Age of what was never heard: older than any patience.
inline constexpr std::uint8_t kNeverHeard = 255;

/// Ages count control periods, those without a tick too: a controller that stood still has heard
/// nothing.
struct AdmitState {
  std::uint8_t servo_age[kMaxJoints] = {};  ///< since the servo last reported, up to 255
  std::uint32_t tick = 0;                   ///< Inputs::tick, as of the last tick
  std::uint32_t operator_age = 0;           ///< since the last operator frame, saturating
  /// Bit j of both: how often in a row servo j's telemetry told of heat or an error. Gray code:
  /// (high, low) is 00, 01, 11, 10 for 0 to kAlarmReadings.
  std::uint32_t alarm_low = 0;
  std::uint32_t alarm_high = 0;
  std::int16_t imu_count[6] = {};  ///< gyro and accelerometer of the last fresh reading
  std::uint8_t imu_age = 0;        ///< up to 255
  std::uint8_t voltage_low = 0;    ///< telemetry readings in a row, of whatever servo, up to 255
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
  /// Fresh after stale_release_s: what was sensed before it says nothing any more.
  bool imu_anew = false;
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};
  float vx_m_s = 0;
  float vy_m_s = 0;
  float wz_rad_s = 0;
  float head_pan_rad = 0;
  float head_tilt_rad = 0;
};

/// Before the first tick, whose inputs these are: no device was heard yet, and no period went by.
void start(const Params& params, const Inputs& inputs, AdmitState& state);

/// Also applies the tick's parameter write to `tuning`.
AdmitOut admit(const Params& params, AdmitState& state, Tuning& tuning, const Inputs& inputs);

}  // namespace verp
