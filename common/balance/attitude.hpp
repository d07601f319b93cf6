#pragma once
#include "common/base/fields.hpp"
#include "common/math/linear.hpp"

/// Body tilt and heading from the IMU by a complementary filter: the gyro turns the estimate, the
/// accelerometer pulls it slowly to the vertical. After power-up or a silence the estimate starts
/// at the first accelerometer reading and averages all readings until it reaches its normal time
/// constant. So a lying robot does not take itself for standing, and a robot just let go, which
/// reads more than gravity, recovers. Heading uses only the gyro.
namespace verp::balance {

struct AttitudeState {
  Xyz up_body{0, 0, 1};       ///< unit vector in the body frame
  Xyz slow_up_body{0, 0, 1};  ///< the same for the heading, with a slower accelerometer
  float heading_rad = 0;      ///< left turn since power-up, in (-pi, pi]
  Xyz gyro_bias_rad_s;        ///< learnt while standing still
  float still_s = 0;          ///< time of standing still, up to kBestKnown_s
  float mean_s = 0;           ///< averaging time of both "up" vectors, up to kHeadingTime_s
  Xyz slow_rad_s;             ///< gyro without trembling; tells motion from standstill
  float shake_rad2_s2 = 0;    ///< mean square of the trembling
  VERP_FIELDS(up_body, slow_up_body, heading_rad, gyro_bias_rad_s, still_s, mean_s, slow_rad_s,
              shake_rad2_s2)
};
VERP_PACKED(AttitudeState);

/// Time constant of the accelerometer: much longer than a step, so that the step's accelerations
/// average out.
inline constexpr float kAccelTime_s = 1.0F;
/// A step's accelerations leave a sway in "up", and rates along it would add up to degrees of turn
/// in a minute. So the heading uses a slower accelerometer.
inline constexpr float kHeadingTime_s = 6.0F;
/// After standing still this long, the gyro's mean counts as its bias.
inline constexpr float kCalibrated_s = 3.0F;
/// After standing still this long, the mean starts to forget older readings.
inline constexpr float kBestKnown_s = 5.0F;

struct AttitudeIn {
  bool fresh = false;  ///< gyro and accelerometer were read this tick
  bool anew = false;   ///< discard the estimate: it is the initial one or from before a silence
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};  ///< specific force: +g up at rest
  bool standing = false;          ///< on both feet, not walking: the bias may be learnt
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
