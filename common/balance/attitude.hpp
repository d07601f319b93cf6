#pragma once
#include "common/base/fields.hpp"
#include "common/math/linear.hpp"

/// Tilt and heading by a complementary filter: the gyro turns the estimate, the accelerometer pulls
/// it slowly to the vertical. Heading uses only the gyro. After power-up or a silence the estimate
/// starts as the mean of the accelerometer since then: a lying robot must not seem to stand.
namespace verp::balance {

struct AttitudeState {
  Xyz up_body{0, 0, 1};       ///< unit vector, body frame
  Xyz slow_up_body{0, 0, 1};  ///< for the heading, with a slower accelerometer
  float heading_rad = 0;      ///< left turn since power-up, in (-pi, pi]
  Xyz gyro_bias_rad_s;        ///< learnt while standing still
  float still_s = 0;          ///< time stood still, up to kBestKnown_s
  float mean_s = 0;           ///< averaging time of both, up to kHeadingTime_s
  Xyz slow_rad_s;             ///< gyro without trembling
  float shake_rad2_s2 = 0;    ///< mean square of trembling
  VERP_FIELDS(up_body, slow_up_body, heading_rad, gyro_bias_rad_s, still_s, mean_s, slow_rad_s,
              shake_rad2_s2)
};
VERP_PACKED(AttitudeState);

/// Time constant of the accelerometer: far longer than a step, whose accelerations average out.
inline constexpr float kAccelTime_s = 1.0F;
/// Time constant for the heading: an "up" that sways with each step would add degrees in a minute.
inline constexpr float kHeadingTime_s = 6.0F;
/// Still for this long: the gyro's bias is known.
inline constexpr float kCalibrated_s = 3.0F;
/// Still for this long: forget older readings.
inline constexpr float kBestKnown_s = 5.0F;

struct AttitudeIn {
  bool fresh = false;  ///< gyro and accelerometer are of this tick
  bool anew = false;   ///< discard the estimate
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};  ///< specific force: +g up at rest
  bool standing = false;          ///< stands still on both feet: may learn the bias
  float period_s = 0.01F;
};

struct AttitudeOut {
  float roll_rad = 0;   ///< about x, left side up positive
  float pitch_rad = 0;  ///< nose down positive
  float heading_rad = 0;
  float roll_rate_rad_s = 0;  ///< bias removed
  float pitch_rate_rad_s = 0;
  float up = 1;             ///< cosine of the tilt
  bool calibrated = false;  ///< the gyro's bias is learnt
};

AttitudeOut update(AttitudeState& state, const AttitudeIn& in);

}  // namespace verp::balance
