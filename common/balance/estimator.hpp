#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/whole_body.hpp"

/// Position and velocity of body and centre of mass. The legs measure the body's motion over the
/// stance soles, weighted by load so that nothing jumps at an exchange; the accelerometer adds what
/// encoders are too coarse for. It observes and controls nothing.
///
/// *Odometry frame*: z up from the ground under the stance soles; x and y from under the body,
/// along its heading, at power-up. They drift with gyro and soles, a millimetre a step.
namespace verp::balance {

struct EstimatorState {
  /// AttitudeState's, without the lean by the body's motion and the accelerometer's offset.
  Xyz up_body{0, 0, 1};
  Xyz body_m;  ///< origin of the body frame
  Xyz body_velocity_m_s;
  Xyz ahead_m;                     ///< the legs' body position minus body_m
  Xyz sole_from_body_m[kFeet];     ///< middle of each sole, odometry axes
  Xyz com_from_body_m;             ///< odometry axes
  Xyz com_velocity_m_s;            ///< over the ground
  gait::Xy slow_m_s;               ///< slow mean of the body's velocity
  Xyz uneven;                      ///< mean of the soles' up minus the attitude's
  float stood_s = 0;               ///< its averaging time, up to kUnevenTime_s
  float left = 0.5F;               ///< share of the weight on the left foot
  std::uint8_t feet_silent = 255;  ///< ticks since the soles' cells reported, up to 255
  std::uint8_t blind = 255;        ///< ticks since a leg reported motion, up to 255
  std::uint8_t grounded = 0;       ///< 1: the cells bear weight
  std::uint8_t begun = 0;          ///< 0 until the first tick with masses
  VERP_FIELDS(up_body, body_m, body_velocity_m_s, ahead_m, sole_from_body_m, com_from_body_m,
              com_velocity_m_s, slow_m_s, uneven, stood_s, left, feet_silent, blind, grounded,
              begun)
};
VERP_PACKED(EstimatorState);

/// Averaging time of the soles' up. Long, because standing in many places improves the mean.
inline constexpr float kUnevenTime_s = 8.0F;

struct EstimatorIn {
  const gait::Lump* lump = nullptr;  ///< everything that the legs carry
  const AttitudeState* attitude = nullptr;
  const Inputs* inputs = nullptr;
  bool imu_fresh = false;  ///< the next two are of this tick
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};
  bool standing = false;  ///< on both soles, not about to step: the ground may correct "up"
  /// Used for soles without cells or with silent ones: whether the robot stands, and on which foot.
  bool on_feet = false;
  std::uint32_t carrying = gait::kBoth;
};

/// Does nothing without two legs or before masses are known.
void update(const Params& params, EstimatorState& state, const EstimatorIn& in);

inline Vec3 com_m(const EstimatorState& state) {
  return math::to_vec(state.body_m) + math::to_vec(state.com_from_body_m);
}
inline Vec3 sole_m(const EstimatorState& state, int side) {
  return math::to_vec(state.body_m) + math::to_vec(state.sole_from_body_m[side]);
}
/// The divergent component of motion (DCM): where the CoM would come to rest if the ground pushed
/// there from now on, by a pendulum of its height.
gait::Xy dcm_m(const EstimatorState& state);

/// The body's fixed-axis roll and pitch, as in AttitudeOut.
float roll_rad(const EstimatorState& state);
float pitch_rad(const EstimatorState& state);

/// The whole estimate, in the order of the controller's registers from body_position on.
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
