#pragma once
#include "common/balance/attitude.hpp"
#include "common/gait/whole_body.hpp"

/// Position and velocity of body and centre of mass, by the body's motion over the stance soles,
/// weighted by load; the accelerometer adds what encoders are too coarse for. Capture steps use it.
///
/// *Odometry frame*: z up from the ground under the stance soles; x and y from under the body,
/// along its heading, at power-up. They drift, a millimetre a step.
namespace verp::balance {

struct EstimatorState {
  /// AttitudeState's, corrected for the body's motion and the accelerometer's offset.
  Xyz up_body{0, 0, 1};
  Xyz body_m;  ///< origin of the body frame
  Xyz body_velocity_m_s;
  Xyz ahead_m;                     ///< the legs' body position minus body_m
  Xyz sole_from_body_m[kFeet];     ///< middle of each sole, odometry axes
  Xyz com_from_body_m;             ///< odometry axes
  Xyz com_velocity_m_s;            ///< over the ground
  gait::Xy slow_m_s;               ///< slow mean of the body's velocity
  Xyz uneven;                      ///< mean of soles' up minus attitude's
  float stood_s = 0;               ///< its averaging time, up to kUnevenTime_s
  float left = 0.5F;               ///< left foot's share of the weight
  std::uint8_t feet_silent = 255;  ///< ticks since the soles' cells reported, up to 255
  std::uint8_t blind = 255;        ///< ticks since a leg last reported, up to 255
  std::uint8_t grounded = 0;       ///< 1: the soles' cells bear weight
  std::uint8_t begun = 0;          ///< 0 until masses are known
  VERP_FIELDS(up_body, body_m, body_velocity_m_s, ahead_m, sole_from_body_m, com_from_body_m,
              com_velocity_m_s, slow_m_s, uneven, stood_s, left, feet_silent, blind, grounded,
              begun)
};
VERP_PACKED(EstimatorState);

/// Averaging time of the soles' up: long, because standing in many places improves the mean.
inline constexpr float kUnevenTime_s = 8.0F;

struct EstimatorIn {
  const gait::Lump* lump = nullptr;  ///< all that the legs carry
  const AttitudeState* attitude = nullptr;
  const Inputs* inputs = nullptr;
  bool imu_fresh = false;  ///< the next two are of this tick
  Vec3 gyro_body_rad_s{0, 0, 0};
  Vec3 accel_body_m_s2{0, 0, 0};
  bool standing = false;  ///< not about to step: the ground may correct "up"
  /// For soles without fresh cells: whether the robot stands, and on which foot.
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
/// Divergent component of motion (DCM): if the ground pushed there from now on, a pendulum of the
/// CoM's height would come to rest above it.
gait::Xy dcm_m(const EstimatorState& state);

/// Fixed-axis angles of the body, as in AttitudeOut.
float roll_rad(const EstimatorState& state);
float pitch_rad(const EstimatorState& state);

/// Ordered as the controller's registers from body_position on.
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
