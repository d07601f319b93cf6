#pragma once
#include "common/base/fields.hpp"
#include "common/math/linear.hpp"

/// Tilt and heading from the IMU by a complementary filter: the gyro turns the estimate, the
/// accelerometer pulls it slowly to the vertical. Heading uses only the gyro.
/// After power-up or a silence the estimate starts as the mean of the accelerometer readings since,
/// until its time constant is reached. A lying robot must not seem to stand, and a robot just let
/// go reads more than gravity.
namespace verp::balance {

struct AttitudeState {
  Xyz up_body{0, 0, 1};       ///< unit vector in the body frame
  Xyz slow_up_body{0, 0, 1};  ///< for the heading, with a slower accelerometer
  float heading_rad = 0;      ///< left turn since power-up, in (-pi, pi]
  Xyz gyro_bias_rad_s;        ///< learnt while standing still
  float still_s = 0;          ///< time stood still, up to kBestKnown_s
  float mean_s = 0;           ///< averaging time of both, up to kHeadingTime_s
  Xyz slow_rad_s;             ///< gyro without trembling, to detect motion
  float shake_rad2_s2 = 0;    ///< mean square of the trembling
  VERP_FIELDS(up_body, slow_up_body, heading_rad, gyro_bias_rad_s, still_s, mean_s, slow_rad_s,
              shake_rad2_s2)
};
VERP_PACKED(AttitudeState);

/// Time constant of the accelerometer: far longer than a step, whose accelerations average out.
inline constexpr float kAccelTime_s = 1.0F;
/// The same for the heading: rates along an "up" that sways with each step would add up to degrees
/// in a minute.
inline constexpr float kHeadingTime_s = 6.0F;
/// Still for this long: the gyro's mean counts as bias.
inline constexpr float kCalibrated_s = 3.0F;
/// Still for this long: the mean forgets older readings.
inline constexpr float kBestKnown_s = 5.0F;

struct AttitudeIn {
  bool fresh = false;  ///< gyro and accelerometer are of this tick
  bool anew = false;   ///< discard the estimate: initial, or before a silence
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};  ///< specific force: +g up at rest
  bool standing = false;          ///< on both feet, not walking: may learn the bias
  float period_s = 0.01F;
};

struct AttitudeOut {
  float roll_rad = 0;   ///< of the body about x
  float pitch_rad = 0;  ///< about y, nose down positive
  float heading_rad = 0;
  float roll_rate_rad_s = 0;  ///< bias removed
  float pitch_rate_rad_s = 0;
  float up = 1;             ///< cosine of the tilt
  bool calibrated = false;  ///< the gyro's bias is learnt
};

AttitudeOut update(AttitudeState& state, const AttitudeIn& in);

}  // namespace verp::balance
