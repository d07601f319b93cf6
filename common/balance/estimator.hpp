#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/whole_body.hpp"

/// Where the body and the centre of mass are and how fast they move, from what the robot feels. The
/// legs tell how the body moves over the soles that carry, in proportion to the weight on each, so
/// that nothing jumps where one foot takes over from the other; the accelerometer tells what the
/// encoders are too coarse for. Nothing here steers: it observes.
///
/// Frame: *odometry*. z is up, 0 the ground under the soles that carry; x and y begin under the
/// body, turned as it was at power-up, and drift as the gyro and the soles do: a millimetre in a
/// step, which is what odometry is.
namespace verp::balance {

struct EstimatorState {
  /// AttitudeState's, without what the body's own motion and the accelerometer's offset leaned it
  /// by
  Xyz up_body{0, 0, 1};
  Xyz body_m;  ///< the body frame's origin
  Xyz body_velocity_m_s;
  Xyz ahead_m;                  ///< by how much the legs have the body ahead of body_m
  Xyz sole_from_body_m[kFeet];  ///< middle of each sole, odometry axes
  Xyz com_from_body_m;          ///< odometry axes
  Xyz com_velocity_m_s;         ///< over the ground
  gait::Xy slow_m_s;            ///< mean of the body's velocity: what the attitude forgets
  Xyz uneven;         ///< of the soles' up, beside the attitude's: its mean where the robot stood
  float stood_s = 0;  ///< over how long that is a mean, up to kUnevenTime_s
  float left = 0.5F;  ///< share of the weight on the left foot
  std::uint8_t feet_silent = 255;  ///< ticks since the soles' cells told something, up to 255
  std::uint8_t blind = 255;        ///< ticks since a leg last told how the body moves, up to 255
  std::uint8_t grounded = 0;       ///< 1: the soles' cells bear weight
  std::uint8_t begun = 0;          ///< 0 until the first tick with masses
  VERP_FIELDS(up_body, body_m, body_velocity_m_s, ahead_m, sole_from_body_m, com_from_body_m,
              com_velocity_m_s, slow_m_s, uneven, stood_s, left, feet_silent, blind, grounded,
              begun)
};
VERP_PACKED(EstimatorState);

/// The soles' up is remembered for so long: a robot that stands in many places knows it better.
inline constexpr float kUnevenTime_s = 8.0F;

struct EstimatorIn {
  const gait::Lump* lump = nullptr;  ///< all that the legs carry
  const AttitudeState* attitude = nullptr;
  const Inputs* inputs = nullptr;
  bool imu_fresh = false;  ///< the next two are of this tick
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};
  bool standing = false;  ///< on both soles, and not about to step: what it stands on tells of up
  /// Where soles have no cells, or these are silent: who is taken to stand, and on what.
  bool on_feet = false;
  std::uint32_t carrying = gait::kBoth;
};

/// Does nothing for a robot that has no two legs, or none whose masses are known yet.
void update(const Params& params, EstimatorState& state, const EstimatorIn& in);

inline Vec3 com_m(const EstimatorState& state) {
  return math::to_vec(state.body_m) + math::to_vec(state.com_from_body_m);
}
inline Vec3 sole_m(const EstimatorState& state, int side) {
  return math::to_vec(state.body_m) + math::to_vec(state.sole_from_body_m[side]);
}
/// The divergent component of motion: where the centre of mass would come to rest if the ground
/// pushed there from now on. Its height is taken for that of a pendulum.
gait::Xy dcm_m(const EstimatorState& state);

/// The body's roll and pitch of fixed axes, as AttitudeOut has them.
float roll_rad(const EstimatorState& state);
float pitch_rad(const EstimatorState& state);

/// All of it at once, in the order of the controller's registers from body_position on.
struct Whereabouts {
  Xyz body_m;
  Xyz roll_pitch_yaw_rad;
  Xyz com_m;
  Xyz com_velocity_m_s;
  gait::Xy dcm_m;
  VERP_FIELDS(body_m, roll_pitch_yaw_rad, com_m, com_velocity_m_s, dcm_m)
};
VERP_PACKED(Whereabouts);
Whereabouts whereabouts(const EstimatorState& state, const AttitudeState& attitude);

}  // namespace verp::balance
