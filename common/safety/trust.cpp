#include "common/safety/trust.hpp"

#include "common/math/convert.hpp"
#include "common/model/counts.hpp"
#include "common/model/tree.hpp"

namespace verp::safety {
namespace {

constexpr float kRangeUnit_rad = 0.01F;
constexpr float kLeastShareOfWeight = 0.2F;  // as the estimator's
constexpr float kLeastSag_rad2 = 1e-6F;      // of both knees: a milliradian
constexpr std::int32_t kLongest_us = 1'000'000'000;

float period_s(const Params& params) {
  return 1e-6F * static_cast<float>(params.period_us);
}

bool on_feet(Mode mode) {
  return mode == Mode::kRising || mode == Mode::kStanding || mode == Mode::kWalking ||
         mode == Mode::kHolding || mode == Mode::kSitting;
}

std::int8_t range_unit(float rad) {
  return static_cast<std::int8_t>(
      math::to_int32(math::clamp(rad / kRangeUnit_rad, -127.0F, 127.0F)));
}

void start_at(float rad, std::int32_t count, FollowState& state) {
  state.model_rad = rad;
  state.stays_count = static_cast<std::int16_t>(count);
  state.low = state.high = 0;
}

// A joint that was not read is not judged: its servo is silent.
bool follows(const JointParams& joint, float goal_rad, float share, bool fresh, std::int32_t count,
             FollowState& state) {
  state.model_rad += share * (goal_rad - state.model_rad);
  if (!fresh) return true;
  const float away_rad = state.model_rad - model::angle_of(joint, count);
  const auto moved = static_cast<std::int16_t>(static_cast<std::uint32_t>(count) -
                                               static_cast<std::uint16_t>(state.stays_count));
  const float moved_count = math::abs(math::to_float(std::int32_t{moved}));
  const std::int8_t away = range_unit(away_rad);
  if (moved_count > kStays_rad * math::abs(joint.counts_per_rad)) {
    state.stays_count = static_cast<std::int16_t>(count);
    state.low = state.high = away;
  }
  if (away < state.low) state.low = away;
  if (away > state.high) state.high = away;
  const float due_rad = kRangeUnit_rad * math::to_float(std::int32_t{state.high - state.low});
  return due_rad <= kStuck_rad && math::abs(away_rad) <= kAstray_rad;
}

std::uint32_t doubt_servos(const Params& params, const Inputs& inputs, const Deed& deed,
                           TrustState& state) {
  const float share = period_s(params) / (kServoLag_s + period_s(params));
  const bool judged = on_feet(deed.mode) && state.foreign == 0;
  state.doubted = 0;
  for (int j = 0; j < params.servo_count(); ++j) {
    const JointParams& joint = params.joint[j];
    const std::int32_t count = inputs.position_count[j];
    if (!judged) {
      start_at(model::angle_of(joint, count), count, state.joint[j]);
    } else if (!follows(joint, deed.goal_rad[j], share, (inputs.fresh >> j & 1U) != 0, count,
                        state.joint[j])) {
      state.doubted |= 1U << j;
    }
  }
  return state.doubted;
}

void keep_range(const Inputs& inputs, TrustState& state) {
  const bool first = state.imu_readings == 0;
  for (int i = 0; i < 6; ++i) {
    const std::int16_t count = i < 3 ? inputs.gyro_count[i] : inputs.accel_count[i - 3];
    if (first || count < state.imu_low[i]) state.imu_low[i] = count;
    if (first || count > state.imu_high[i]) state.imu_high[i] = count;
  }
  ++state.imu_readings;
}

bool two_axes_moved(const TrustState& state, int from) {
  int moved = 0;
  for (int i = from; i < from + 3; ++i) {
    if (state.imu_high[i] - state.imu_low[i] > kImuMoves_count) ++moved;
  }
  return moved >= 2;
}

// A doubted IMU is watched on, in any mode: a person who lifts the robot moves it.
bool doubt_imu(const Inputs& inputs, const Deed& deed, TrustState& state) {
  const bool watched = deed.stepping && state.foreign == 0 && (inputs.flags & kImuAssumed) == 0;
  if ((inputs.flags & kImuFresh) != 0 && (watched || state.imu_still != 0)) {
    keep_range(inputs, state);
  }
  if (state.imu_readings == kImuReadings) {
    state.imu_still = two_axes_moved(state, 0) && two_axes_moved(state, 3) ? 0 : 1;
    state.imu_readings = 0;
  }
  return state.imu_still != 0;
}

bool has_cells(const Params& params) {
  return params.feet.device_id[0] != 0 && params.feet.device_id[1] != 0;
}

bool cells_bear(const Params& params, const Inputs& inputs) {
  if ((inputs.flags & kFeetFresh) == 0) return true;
  std::int32_t sum = 0;
  for (const auto& foot : inputs.foot_count) {
    for (const std::uint16_t count : foot) sum += count;
  }
  return params.feet.newton_per_count * math::to_float(sum) >
         kLeastShareOfWeight * math::kGravityMS2 * model::total_mass(params);
}

bool shows_load(const Params& params, const LegParams& leg) {
  if (leg.solver == LegSolver::kNone || leg.joint[kKnee] >= params.servo_count()) return false;
  const JointParams& knee = params.joint[leg.joint[kKnee]];
  return knee.compliance_rad_nm > 0.0F && params.servo[knee.servo_profile].position_i_gain == 0;
}

bool knees_show(const Params& params) {
  return shows_load(params, params.leg[0]) && shows_load(params, params.leg[1]);
}

void feel_knees(const Params& params, const Inputs& inputs, const Deed& deed, const float* sag_rad,
                TrustState& state) {
  float felt_rad2 = 0, planned_rad2 = 0;
  for (int side = 0; side < kFeet; ++side) {
    const int j = params.leg[side].joint[kKnee];
    const float rad = model::angle_of(params.joint[j], inputs.position_count[j]);
    felt_rad2 += (deed.goal_rad[j] - rad) * sag_rad[side];
    planned_rad2 += sag_rad[side] * sag_rad[side];
  }
  const float share = period_s(params) / (kLoadTime_s + period_s(params));
  state.felt_rad2 += share * (felt_rad2 - state.felt_rad2);
  state.planned_rad2 += share * (planned_rad2 - state.planned_rad2);
}

}  // namespace

Doubts doubt(const Params& params, const Inputs& inputs, const Deed& deed, TrustState& state) {
  return {doubt_servos(params, inputs, deed, state), doubt_imu(inputs, deed, state)};
}

bool carries_nothing(const Params& params, const Inputs& inputs, const Deed& deed,
                     const float* sag_rad, float most_s, TrustState& state) {
  const bool stands = deed.mode == Mode::kStanding || deed.mode == Mode::kWalking;
  const bool cells = has_cells(params), knees = knees_show(params);
  if (!stands || state.foreign != 0 || (!cells && !knees)) {
    state.felt_rad2 = state.planned_rad2 = 0;
    state.unloaded_us = 0;
    return false;
  }
  bool bears = cells && cells_bear(params, inputs);
  if (knees) {
    feel_knees(params, inputs, deed, sag_rad, state);
    bears = bears || state.planned_rad2 < kLeastSag_rad2 ||
            state.felt_rad2 > kLeastLoad * state.planned_rad2;
  }
  if (bears) {
    state.unloaded_us = 0;
  } else if (state.unloaded_us < kLongest_us) {
    state.unloaded_us += static_cast<std::int32_t>(params.period_us);
  }
  return 1e-6F * math::to_float(state.unloaded_us) > most_s;
}

}  // namespace verp::safety
