#pragma once
#include "common/base/fields.hpp"
#include "common/math/linear.hpp"

/// Body tilt and heading from the IMU: the gyro turns the estimate, the accelerometer pulls it
/// slowly to the vertical (complementary filter). Where there is no estimate yet, or none any more,
/// it begins as the accelerometer's first reading, and is the mean of all until it is as slow as
/// ever: a robot that lies must not believe that it stands, and one that was just let go reads
/// more than gravity. Heading has the gyro only.
namespace verp::balance {

struct AttitudeState {
  Xyz up_body{0, 0, 1};       ///< direction of "up" in the body frame, unit
  Xyz slow_up_body{0, 0, 1};  ///< the same, for the heading: the accelerometer moves it slower
  float heading_rad = 0;      ///< turned to the left since power-up, in (-pi, pi]
  Xyz gyro_bias_rad_s;        ///< learnt while standing still
  float still_s = 0;          ///< how long the robot has stood still, up to kBestKnown_s
  float mean_s = 0;         ///< of how long both are the accelerometer's mean, up to kHeadingTime_s
  Xyz slow_rad_s;           ///< the gyro without trembling: what tells motion from standstill
  float shake_rad2_s2 = 0;  ///< mean square of the trembling
  VERP_FIELDS(up_body, slow_up_body, heading_rad, gyro_bias_rad_s, still_s, mean_s, slow_rad_s,
              shake_rad2_s2)
};
VERP_PACKED(AttitudeState);

/// The accelerometer's share: slower than a step by far, so that its accelerations average out.
inline constexpr float kAccelTime_s = 1.0F;
/// What a step's accelerations leave in "up" sways with the body, and a rate seen along it would
/// add up to a turn: degrees in a minute. For the heading the accelerometer is slower still.
inline constexpr float kHeadingTime_s = 6.0F;
/// This long still, and the mean of the gyro is taken for its bias.
inline constexpr float kCalibrated_s = 3.0F;
/// This long still, and it is known as well as it will be: the mean forgets what is older.
inline constexpr float kBestKnown_s = 5.0F;

struct AttitudeIn {
  bool fresh = false;  ///< gyro and accelerometer are of this tick
  bool anew = false;   ///< the estimate is of before a silence, or the initial one: not to be used
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};  ///< specific force: +g up when still
  bool standing = false;          ///< on both feet, not walking: the bias may be learnt
  float period_s = 0.01F;
};

struct AttitudeOut {
  float roll_rad = 0;   ///< body, about x
  float pitch_rad = 0;  ///< about y, nose down positive
  float heading_rad = 0;
  float roll_rate_rad_s = 0;  ///< bias removed
  float pitch_rate_rad_s = 0;
  float up = 1;             ///< cosine of the tilt
  bool calibrated = false;  ///< the gyro's bias has been learnt
};

AttitudeOut update(AttitudeState& state, const AttitudeIn& in);

}  // namespace verp::balance
