#include "common/balance/estimator.hpp"

#include "common/math/convert.hpp"
#include "common/model/leg.hpp"

namespace verp::balance {
namespace {

// How fast the estimate follows the legs (critically damped): a higher value turns encoder counts
// into velocity noise, a lower one the accelerometer's offset. From tuning seeds 1001-1030 of
// random robots; the leads below from 1001-1006.
constexpr float kBelief_per_s = 22.0F;
// The velocity turns "up" (learn_up), which moves the soles seen from the body, and so the
// velocity: a loop of gain belief * height / (2 * gravity * kAccelTime_s). At 1, a body 0.9 m up,
// it swings by itself at 3.5 Hz. Bodies above this height believe the legs less, for a gain of
// 0.37.
constexpr float kBelieved_m = 0.33F;
// Age of the IMU's data: filters and bus.
constexpr float kTiltLead_s = 0.005F;
constexpr float kAccelLead_s = 0.003F;
constexpr float kGroundTime_s = 0.5F;        // time constant for forgetting steps up and down
constexpr float kExchange_s = 0.015F;        // time of load transfer to a foot without cells
constexpr float kLeastShareOfWeight = 0.2F;  // least load on both soles of a standing robot
constexpr float kLeastShare = 0.2F;          // least share of the load on legs that reported
constexpr std::uint8_t kPatience = 10;       // ticks of silence bridged
constexpr float kStanding_s = 0.1F;          // time constant to standstill after a longer silence
constexpr float kMostVelocity_m_s = 10.0F, kMostAhead_m = 0.05F;

// On a standing robot the mean of ground and accelerometer errs less than either, weighted by
// squared errors: 0.3 degrees (an offset of 5 mg) and 0.5 (floors, joint zeros). More lean is the
// ground's: a ramp or an edge.
constexpr float kOffset_rad = 0.005F, kGround_rad = 0.009F;
constexpr float kShareOfGround =
    kOffset_rad * kOffset_rad / (kOffset_rad * kOffset_rad + kGround_rad * kGround_rad);
constexpr float kMostUneven_rad = 0.035F;

struct Leg {
  Vec3 sole_body_m;
  Vec3 up_body;
  bool fresh = true;  ///< all joints reported this tick
};

// The leg's pose by its encoders. Adds its mass and moment.
Leg look(const Params& params, const LegParams& leg, const Inputs& inputs, Vec3& moment_kg_m,
         float& mass_kg) {
  Leg seen;
  float angle_rad[kLegJoints];
  seen.fresh = model::measure_leg(params, leg, inputs, angle_rad);
  const kinematics::LegChain chain = kinematics::leg_chain(params, leg, Pose{}, angle_rad);
  for (int k = 0; k < kLegJoints; ++k) {
    const JointParams& joint = model::joint_of(params, leg, k);
    moment_kg_m += joint.mass_kg * math::apply(chain.link[k], math::to_vec(joint.com_link_m));
    mass_kg += joint.mass_kg;
  }
  const float x_m = 0.5F * (leg.sole_front_m - leg.sole_back_m);
  const float y_m = 0.5F * (leg.sole_left_m - leg.sole_right_m);
  Vec3 middle_m = math::to_vec(leg.sole_foot_m);
  for (int i = 0; i < 3; ++i)
    middle_m(i) += x_m * leg.sole_foot[3 * i] + y_m * leg.sole_foot[3 * i + 1];
  const Pose& foot = chain.link[kLegJoints - 1];
  seen.sole_body_m = math::apply(foot, middle_m);
  seen.up_body = foot.rotation * Vec3(leg.sole_foot[2], leg.sole_foot[5], leg.sole_foot[8]);
  return seen;
}

Mat3 odometry_axes(const Vec3& up, const math::SinCos& heading) {
  const Vec3 ahead = math::normalized_or(Vec3(1, 0, 0) - up.x() * up, Vec3(1, 0, 0));
  const Vec3 left = math::cross(up, ahead);
  Mat3 body;
  body.row(0) = heading.cos * ahead - heading.sin * left;
  body.row(1) = heading.sin * ahead + heading.cos * left;
  body.row(2) = up;
  return body;
}

// Averages the soles' up relative to the attitude's.
void stand_on_ground(const EstimatorIn& in, const Leg* leg, float period_s, EstimatorState& state) {
  if (!in.standing || !in.imu_fresh || !leg[0].fresh || !leg[1].fresh) return;
  const Vec3 now = 0.5F * (leg[0].up_body + leg[1].up_body) - math::to_vec(in.attitude->up_body);
  const Vec3 before = math::to_vec(state.uneven);
  state.stood_s = math::min(state.stood_s + period_s, kUnevenTime_s);
  state.uneven = math::to_xyz(before + (period_s / state.stood_s) * (now - before));
}

// Tilt that the accelerometer's offset causes. The ground counts less as it leans.
Vec3 offset_of(const EstimatorState& state) {
  const Vec3 uneven = math::to_vec(state.uneven);
  const float part2 = uneven.squaredNorm() / (kMostUneven_rad * kMostUneven_rad);
  return (kShareOfGround * math::max(1.0F - part2, 0.0F)) * uneven;
}

// The attitude takes the accelerometer's mean as up: a velocity change leans it by velocity /
// (gravity * averaging time). The legs know the velocity, so this removes the lean.
Mat3 learn_up(const EstimatorIn& in, float period_s, EstimatorState& state) {
  Vec3 up = math::to_vec(in.attitude->up_body);
  if (in.imu_fresh) {
    const Vec3 rate = in.gyro_body_rad_s - math::to_vec(in.attitude->gyro_bias_rad_s);
    up -= kTiltLead_s * math::cross(rate, up);
  }
  const math::SinCos heading = math::sincos(in.attitude->heading_rad);
  const gait::Xy velocity{state.body_velocity_m_s.x, state.body_velocity_m_s.y};
  const gait::Xy fast = velocity - state.slow_m_s;
  state.slow_m_s = state.slow_m_s + (period_s / kAccelTime_s) * fast;
  const Mat3 leaning = odometry_axes(up, heading);
  constexpr float kLean_s_m = 1.0F / (kAccelTime_s * math::kGravityMS2);
  up -= kLean_s_m * (fast.x * leaning.row(0) + fast.y * leaning.row(1)).transpose();
  up += offset_of(state);
  up = math::normalized_or(up, Vec3(0, 0, 1));
  state.up_body = math::to_xyz(up);
  return odometry_axes(up, heading);
}

// True if the soles bear the robot; shares come from force cells, else from the plan.
bool feel(const Params& params, const EstimatorIn& in, float weight_n, float period_s,
          EstimatorState& state) {
  const bool cells = params.feet.device_id[0] * params.feet.device_id[1] != 0;  // on both
  if (cells && (in.inputs->flags & kFeetFresh) != 0) {
    state.feet_silent = 0;
    float load_n[kFeet];
    for (int side = 0; side < kFeet; ++side) {
      std::int32_t sum = 0;
      for (const std::uint16_t count : in.inputs->foot_count[side]) sum += count;
      load_n[side] = params.feet.newton_per_count * math::to_float(sum);
    }
    const float all_n = load_n[0] + load_n[1];
    state.grounded = all_n > kLeastShareOfWeight * weight_n ? 1 : 0;
    if (state.grounded != 0) state.left = math::clamp(load_n[0] / all_n, 0.0F, 1.0F);
    return state.grounded != 0;
  }
  if (state.feet_silent < 255) ++state.feet_silent;
  if (state.feet_silent <= kPatience) return state.grounded != 0;
  const float left = in.carrying == gait::kBoth ? 0.5F : in.carrying == gait::kLeft ? 1.0F : 0.0F;
  state.left += math::min(period_s / kExchange_s, 1.0F) * (left - state.left);
  return in.on_feet;
}

// Motion since the last tick; false if no loaded leg reported.
bool moved_over_soles(const EstimatorState& state, const Leg* leg, const Vec3* sole_m,
                      Vec3& moved_m, float& height_m) {
  float share[kFeet] = {state.left, 1.0F - state.left};
  float known = 0;
  moved_m = Vec3(0, 0, 0);
  height_m = 0;
  for (int side = 0; side < kFeet; ++side) {
    if (!leg[side].fresh) continue;
    known += share[side];
    moved_m -= share[side] * (sole_m[side] - math::to_vec(state.sole_from_body_m[side]));
    height_m -= share[side] * sole_m[side].z();
  }
  if (!(known >= kLeastShare)) return false;
  moved_m = moved_m / known;
  height_m = height_m / known;
  return true;
}

Vec3 limited(const Vec3& v, float most) {
  return {math::clamp(v.x(), -most, most), math::clamp(v.y(), -most, most),
          math::clamp(v.z(), -most, most)};
}

// Moves the body by legs and accelerometer; returns its step.
Vec3 follow_body(bool carried, const Vec3& moved_m, float height_m, const Vec3& accel_m_s2,
                 float period_s, EstimatorState& state) {
  const float belief_per_s = kBelief_per_s * (kBelieved_m / math::max(state.body_m.z, kBelieved_m));
  Vec3 velocity = math::to_vec(state.body_velocity_m_s);
  Vec3 step_m = period_s * (velocity + 0.5F * period_s * accel_m_s2);
  velocity += period_s * accel_m_s2;
  Vec3 ahead_m(0, 0, 0);
  if (carried) {
    ahead_m = math::to_vec(state.ahead_m) + moved_m - step_m;
    ahead_m.z() += math::min(period_s / kGroundTime_s, 1.0F) *
                   (height_m - state.body_m.z - step_m.z() - ahead_m.z());
    ahead_m = limited(ahead_m, kMostAhead_m);
    velocity += (belief_per_s * belief_per_s * period_s) * ahead_m;
    const Vec3 pulled_m = (2.0F * belief_per_s * period_s) * ahead_m;
    step_m += pulled_m;
    ahead_m -= pulled_m;
  } else if (state.blind > kPatience) {
    velocity = (1.0F - math::min(period_s / kStanding_s, 1.0F)) * velocity;
  }
  state.ahead_m = math::to_xyz(ahead_m);
  state.body_velocity_m_s = math::to_xyz(limited(velocity, kMostVelocity_m_s));
  state.body_m = math::to_xyz(math::to_vec(state.body_m) + step_m);
  return step_m;
}

}  // namespace

void update(const Params& params, EstimatorState& state, const EstimatorIn& in) {
  const bool legs =
      params.leg[0].solver != LegSolver::kNone && params.leg[1].solver != LegSolver::kNone;
  if (!legs || !(in.lump->mass_kg > 0.0F)) return;
  const float period_s = 1e-6F * static_cast<float>(params.period_us);
  float mass_kg = in.lump->mass_kg;
  Vec3 moment_kg_m = mass_kg * math::to_vec(in.lump->com_body_m);
  Leg leg[kFeet];
  for (int side = 0; side < kFeet; ++side) {
    leg[side] = look(params, params.leg[side], *in.inputs, moment_kg_m, mass_kg);
  }
  stand_on_ground(in, leg, period_s, state);
  const Mat3 axes = learn_up(in, period_s, state);
  const bool stands = feel(params, in, mass_kg * math::kGravityMS2, period_s, state);
  const Vec3 com_m = axes * Vec3(moment_kg_m / mass_kg);
  const Vec3 sole_m[kFeet] = {axes * leg[0].sole_body_m, axes * leg[1].sole_body_m};
  if (state.begun == 0) {
    state.begun = 1;
    for (int side = 0; side < kFeet; ++side)
      state.sole_from_body_m[side] = math::to_xyz(sole_m[side]);
    state.com_from_body_m = math::to_xyz(com_m);
    state.body_m.z = -0.5F * (sole_m[0].z() + sole_m[1].z());
  }
  Vec3 moved_m;
  float height_m = 0;
  const bool carried = stands && moved_over_soles(state, leg, sole_m, moved_m, height_m);
  state.blind = carried ? 0 : state.blind < 255 ? state.blind + 1 : 255;
  Vec3 accel_m_s2(0, 0, 0);
  if (in.imu_fresh && state.blind <= kPatience) {
    accel_m_s2 = axes * in.accel_body_m_s2 - Vec3(0, 0, math::kGravityMS2);
  }
  const Vec3 step_m = follow_body(carried, moved_m, height_m, accel_m_s2, period_s, state);
  for (int side = 0; side < kFeet; ++side) {
    // A silent leg's sole is assumed to stand.
    Xyz& from_body_m = state.sole_from_body_m[side];
    from_body_m = math::to_xyz(leg[side].fresh ? sole_m[side] : math::to_vec(from_body_m) - step_m);
  }
  const Vec3 within_m_s = (com_m - math::to_vec(state.com_from_body_m)) / period_s;
  state.com_from_body_m = math::to_xyz(com_m);
  state.com_velocity_m_s = math::to_xyz(
      limited(math::to_vec(state.body_velocity_m_s) + within_m_s + kAccelLead_s * accel_m_s2,
              kMostVelocity_m_s));
}

gait::Xy dcm_m(const EstimatorState& state) {
  constexpr float kLeast_m = 0.05F;
  const Vec3 com = com_m(state);
  const float per_omega_s = math::sqrt(math::max(com.z(), kLeast_m) / math::kGravityMS2);
  return {com.x() + per_omega_s * state.com_velocity_m_s.x,
          com.y() + per_omega_s * state.com_velocity_m_s.y};
}

float roll_rad(const EstimatorState& state) {
  return math::atan2(state.up_body.y, state.up_body.z);
}

float pitch_rad(const EstimatorState& state) {
  return math::atan2(-state.up_body.x, math::hypot(state.up_body.y, state.up_body.z));
}

Whereabouts whereabouts(const EstimatorState& state, const AttitudeState& attitude) {
  return {state.body_m,
          {roll_rad(state), pitch_rad(state), attitude.heading_rad},
          math::to_xyz(com_m(state)),
          state.com_velocity_m_s,
          dcm_m(state)};
}

}  // namespace verp::balance
