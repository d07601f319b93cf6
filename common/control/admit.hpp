#pragma once
#include "common/base/fields.hpp"
#include "common/io/io.hpp"
#include "common/math/linear.hpp"
#include "common/model/params.hpp"

/// First stage: raw counts become physical values, silence gets an age, an operator's parameter
/// write is checked.
namespace verp {

struct AdmitState {
  std::uint8_t servo_age[kMaxJoints] = {};  ///< ticks since the servo last reported, up to 255
  std::uint32_t operator_age = 0;           ///< ticks since the last operator frame, saturating
  std::uint8_t imu_age = 0;                 ///< ticks, up to 255
  std::uint8_t power_bad = 0;               ///< bad telemetry readings in a row, up to 255
  std::uint16_t reserved = 0;
  VERP_FIELDS(servo_age, operator_age, imu_age, power_bad, reserved)
};
VERP_PACKED(AdmitState);

struct AdmitOut {
  std::uint32_t conditions = 0;  ///< safety::Condition bits that follow from the inputs alone
  std::uint32_t faults = 0;      ///< safety::Fault bits raised this tick
  bool imu_fresh = false;
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};
  float vx_m_s = 0;
  float vy_m_s = 0;
  float wz_rad_s = 0;
  float head_pan_rad = 0;
  float head_tilt_rad = 0;
};

/// Also applies the tick's parameter write to `tuning`.
AdmitOut admit(const Params& params, AdmitState& state, Tuning& tuning, const Inputs& inputs);

}  // namespace verp
