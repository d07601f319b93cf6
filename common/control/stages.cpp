#include "common/control/stages.hpp"

#include "common/control/falling.hpp"
#include "common/math/convert.hpp"
#include "common/model/counts.hpp"
#include "common/model/coupling.hpp"

namespace verp::control {
namespace {

using safety::Mode;

constexpr std::int32_t kLongest_us = 1'000'000'000;  // durations saturate here
constexpr float kMaxHeadingError_rad = 0.5F;         // a robot turned by hand corrects gently

// In a cycle of whole ticks the gyro is read at the same moments of every step, and hurried feet
// add up to a false turn: 4 degrees a minute (generic21, 0.42 m/s; 2 with the sway). So the gait's
// clock gains a tick in this many, then loses one. Not in calm steps: the sway adds 0.5 mm of ZMP
// bias.
constexpr std::uint32_t kSway_ticks = 256;
constexpr float kHurried = 0.5F;  // Step::haste from which the clock sways: 0.31 m/s for generic21

std::int32_t gait_period_us(const Params& params, const State& state) {
  const auto period_us = static_cast<std::int32_t>(params.period_us);
  if (state.gait.queue[0].haste < kHurried) return period_us;
  const auto by_us = static_cast<std::int32_t>(params.period_us / kSway_ticks);
  return state.admit.tick % (2 * kSway_ticks) < kSway_ticks ? period_us + by_us : period_us - by_us;
}

float period_s(const Params& params) {
  return static_cast<float>(params.period_us) * 1e-6F;
}

// Trouble is latched with its fault: a supply that sags under load recovers without it.
bool in_trouble(const State& state, const AdmitOut& admitted) {
  return (admitted.conditions & safety::kTrouble) != 0 ||
         (state.machine.faults & safety::kTroubleFaults) != 0;
}

balance::SteppingIn stepping_in(const Params& params, const State& state) {
  return {&state.gait, &state.estimator, state.attitude.heading_rad, period_s(params)};
}

bool lies(Mode mode) {
  return mode == Mode::kFalling || mode == Mode::kFallen || mode == Mode::kLyingDown;
}

bool walks(const State& state, const AdmitOut& admitted) {
  constexpr std::uint32_t kNoMore = safety::kOperatorQuiet | safety::kStale;
  constexpr std::uint32_t kWhy = safety::kAskWalk | safety::kPushed;
  return state.machine.mode == Mode::kWalking && (admitted.conditions & kWhy) != 0 &&
         (admitted.conditions & kNoMore) == 0 && !in_trouble(state, admitted);
}

// The error and its integral, to meet a slip in every step before it happens.
float heading_error(const Params& params, const State& state, const AdmitOut& admitted,
                    const balance::AttitudeOut& attitude, SteerState& steer) {
  constexpr float kSumming_per_s = 0.15F;  // far slower than the plan's lead of four steps
  if (state.machine.mode != Mode::kWalking) {
    steer.heading_rad = attitude.heading_rad;
    steer.slip_rad = 0;
    return 0;
  }
  steer.heading_rad = math::wrap_angle(steer.heading_rad + period_s(params) * admitted.wz_rad_s);
  const float error_rad = math::clamp(math::wrap_angle(steer.heading_rad - attitude.heading_rad),
                                      -kMaxHeadingError_rad, kMaxHeadingError_rad);
  // A larger error is an order beyond what steps can turn.
  if (math::abs(error_rad) < kMaxHeadingError_rad) {
    steer.slip_rad = math::clamp(steer.slip_rad + kSumming_per_s * period_s(params) * error_rad,
                                 -kMaxHeadingError_rad, kMaxHeadingError_rad);
  }
  return error_rad + steer.slip_rad;
}

bool time_is_up(const State& state) {
  const safety::MachineState& machine = state.machine;
  switch (machine.mode) {
    case Mode::kActing:
    case Mode::kGettingUp:
      return state.action.number == 0;
    case Mode::kLyingDown:  // not back to the stand
      return state.action.number == 0 || state.action.part == action::Part::kReturn;
    case Mode::kFalling:
      return machine.in_mode_us >= kFallLasts_us;
    default:
      return machine.in_mode_us >= 1000 * machine.way_ms;
  }
}

std::uint32_t conditions_of(const State& state, const AdmitOut& admitted,
                            const balance::AttitudeOut& attitude, const safety::LimitOut& limited) {
  const SafetyTuning& tuning = state.tuning.safety;
  std::uint32_t conditions = admitted.conditions;
  const auto microseconds = [](float duration_s) { return math::to_int32(duration_s * 1e6F); };
  // A lying robot must not begin to rise.
  const bool limp = !safety::has_torque(state.machine.mode);
  const std::int32_t confirm_us = limp ? 0 : microseconds(tuning.fall_confirm_s);
  if (state.steer.fallen_us > confirm_us) conditions |= safety::kFell;
  if (attitude.calibrated) conditions |= safety::kCalibrated;
  if (state.gait.queued == 0) conditions |= safety::kGaitOver;
  if (time_is_up(state)) conditions |= safety::kTimeUp;
  if (in_trouble(state, admitted)) conditions |= safety::kTrouble;
  if (limited.beyond) conditions |= safety::kJointBeyond;
  return conditions;
}

// No joint's angle is known until its servo reports.
bool is_refused(Mode mode, std::uint32_t conditions) {
  constexpr std::uint32_t kAll = safety::kServosKnown | safety::kJointBeyond;
  const std::uint32_t asked = mode == Mode::kRelaxed  ? safety::kAskStand | 0U
                              : mode == Mode::kFallen ? safety::kAskGetUp | 0U
                                                      : 0U;
  return (conditions & asked) != 0 && (conditions & kAll) == kAll;
}

void enter(Mode mode, std::int32_t period_us, safety::MachineState& machine) {
  if (mode != machine.mode) {
    machine.mode = mode;
    machine.in_mode_us = 0;
  } else if (machine.in_mode_us < kLongest_us) {
    machine.in_mode_us += period_us;
  }
}

safety::Deed deed_of(const State& state) {
  const bool stepping = state.gait.queued > 0 && state.landing.carrying != gait::kBoth;
  return {state.machine.mode, stepping, state.limit.goal_rad};
}

std::uint32_t oldest_servos(const Params& params, const AdmitState& admit) {
  std::uint8_t oldest = admit.imu_age > 1 ? admit.imu_age : std::uint8_t{1};
  std::uint32_t silent = 0;
  for (int j = 0; j < params.joint_count; ++j) {
    if (admit.servo_age[j] > oldest) silent = 0;
    if (admit.servo_age[j] < oldest) continue;
    oldest = admit.servo_age[j];
    silent |= 1U << j;
  }
  return silent;
}

// A robot that holds and rises again and again never walks, and never rests.
bool flutters(const Params& params, const AdmitState& admit, Mode before, std::uint32_t conditions,
              safety::MachineState& machine) {
  const auto period_us = static_cast<std::int32_t>(params.period_us);
  const bool rests = machine.mode == Mode::kRelaxed || machine.flutter_us < period_us;
  machine.flutter_us = rests ? 0 : machine.flutter_us - period_us;
  const bool held = before != Mode::kHolding && machine.mode == Mode::kHolding;
  if (held && (conditions & safety::kStale) != 0) {
    machine.flutter_us += safety::kForgotten_us;
    machine.silent = oldest_servos(params, admit);
  }
  return machine.flutter_us > safety::kFlutter_us;
}

}  // namespace

void start(const Params& params, const Inputs& inputs, State& state) {
  state.tuning = params.tuning;
  gait::stand_legs(params, state.gait.preview.leg_rad);
  verp::start(params, inputs, state.admit);
}

safety::Doubts doubt(const Params& params, State& state, const Inputs& inputs) {
  return safety::doubt(params, inputs, deed_of(state), state.trust);
}

balance::AttitudeOut estimate(const Params& params, State& state, const AdmitOut& admitted) {
  balance::AttitudeIn in;
  in.fresh = admitted.imu_fresh;
  in.anew = admitted.imu_anew;
  in.gyro_body_rad_s = admitted.gyro_body_rad_s;
  in.accel_body_m_s2 = admitted.accel_body_m_s2;
  in.standing = state.machine.mode == Mode::kStanding;
  in.period_s = period_s(params);
  const balance::AttitudeOut out = balance::update(state.attitude, in);

  const bool tilted = out.up < math::cos(state.tuning.safety.fall_tilt_rad);
  const auto period_us = static_cast<std::int32_t>(params.period_us);
  state.steer.fallen_us = !tilted                               ? 0
                          : state.steer.fallen_us < kLongest_us ? state.steer.fallen_us + period_us
                                                                : kLongest_us;
  return out;
}

void locate(const Params& params, State& state, const Inputs& inputs, const AdmitOut& admitted) {
  const Mode mode = state.machine.mode;
  balance::EstimatorIn in;
  in.lump = &state.gait.preview.lump;
  in.attitude = &state.attitude;
  in.inputs = &inputs;
  in.imu_fresh = admitted.imu_fresh;
  in.gyro_body_rad_s = admitted.gyro_body_rad_s;
  in.accel_body_m_s2 = admitted.accel_body_m_s2;
  in.standing = mode == Mode::kStanding;
  in.on_feet = safety::has_torque(mode) && !lies(mode) && mode != Mode::kGettingUp;
  in.carrying = state.landing.carrying;
  balance::update(params, state.estimator, in);
}

void watch_push(const Params& params, State& state, AdmitOut& admitted) {
  const Mode mode = state.machine.mode;
  if (mode != Mode::kStanding && mode != Mode::kWalking) return;
  if (!balance::pushed(params, state.tuning, stepping_in(params, state), state.stepping)) return;
  admitted.conditions |= safety::kPushed;
  // The operator did not ask for a walk: step on the spot.
  if ((admitted.conditions & safety::kAskWalk) == 0) {
    admitted.vx_m_s = admitted.vy_m_s = admitted.wz_rad_s = 0.0F;
  }
}

gait::GaitOut plan_motion(const Params& params, State& state, const AdmitOut& admitted,
                          const balance::AttitudeOut& attitude) {
  // A fall ends the walk; nothing is learnt.
  if (lies(state.machine.mode) && state.gait.queued > 0) {
    state.gait = gait::GaitState{};
    state.stepping = balance::SteppingState{};
    gait::stand_legs(params, state.gait.preview.leg_rad);
  }
  gait::GaitIn in;
  in.walk = walks(state, admitted);
  in.at_once = (admitted.conditions & safety::kPushed) != 0;
  in.wanted.vx_m_s = admitted.vx_m_s;
  in.wanted.vy_m_s = admitted.vy_m_s;
  in.wanted.wz_rad_s = admitted.wz_rad_s;
  in.wanted.quick = (admitted.conditions & safety::kOperatorQuiet) != 0;
  in.wanted.heading_error_rad = heading_error(params, state, admitted, attitude, state.steer);
  in.goal_rad = state.limit.goal_rad;
  in.period_us = gait_period_us(params, state);
  return gait::update(params, state.tuning, state.gait, in);
}

void step_aside(const Params& params, State& state, gait::GaitOut& plan) {
  balance::step_aside(params, state.tuning, stepping_in(params, state), state.stepping, plan);
}

void lean(const Params& params, State& state, const AdmitOut& admitted,
          const balance::AttitudeOut& attitude, gait::GaitOut& plan) {
  const Mode mode = state.machine.mode;
  const bool off = !(state.tuning.balance.feedback_enable > 0.5F);
  if (off || lies(mode) || !safety::has_torque(mode)) state.lean = balance::LeanState{};
  // A standing robot learns the gyro's bias and must not turn.
  if (!off && mode == Mode::kWalking && admitted.imu_fresh) {
    const float planned_rad = state.tuning.gait.trunk_pitch_rad;
    balance::learn_lean(attitude, planned_rad, period_s(params), state.lean);
  }
  balance::lean(state.lean, plan.posture);
}

void watch_load(const Params& params, State& state, const Inputs& inputs, const Wanted& wanted,
                AdmitOut& admitted) {
  float sag_rad[kFeet];
  for (int side = 0; side < kFeet; ++side) {
    const int knee = params.leg[side].joint[safety::kKnee];
    sag_rad[side] = wanted.angle_rad[knee] - wanted.plain_rad[knee];
  }
  const float most_s = state.tuning.safety.unloaded_s;
  if (safety::carries_nothing(params, inputs, deed_of(state), sag_rad, most_s, state.trust)) {
    admitted.faults |= safety::kFaultUnloaded;
  }
}

safety::LimitOut limit_goals(const Params& params, State& state, const Inputs& inputs,
                             const Wanted& wanted) {
  safety::MachineState& machine = state.machine;
  const safety::LimitOut out =
      safety::limit(params, state.limit,
                    {machine.mode, machine.in_mode_us, machine.way_ms, wanted.angle_rad,
                     inputs.position_count, &state.tuning.safety});
  machine.way_ms = out.way_ms;
  return out;
}

std::uint32_t raise_faults(const State& state, const AdmitOut& admitted, const Wanted& wanted,
                           const safety::LimitOut& limited) {
  std::uint32_t faults = admitted.faults;
  if (wanted.leg_limited) faults |= safety::kNoteLegLimited;
  if (limited.slowed) faults |= safety::kNoteSpeedLimited;
  const std::uint32_t notes = state.gait.footsteps.notes;
  if ((notes & gait::kStrideLimited) != 0) faults |= safety::kNoteStrideLimited;
  if ((notes & (gait::kReachShortened | gait::kZmpShortened | gait::kTurnShortened)) != 0) {
    faults |= safety::kNotePlanShortened;
  }
  if ((notes & gait::kPlanRefused) != 0) faults |= safety::kNotePlanRefused;
  return faults;
}

void gate(const Params& params, State& state, const AdmitOut& admitted,
          const balance::AttitudeOut& attitude, const gait::GaitOut& plan,
          const safety::LimitOut& limited, std::uint32_t faults, Outputs& outputs) {
  safety::MachineState& machine = state.machine;
  const Mode before = machine.mode;
  const std::uint32_t conditions = conditions_of(state, admitted, attitude, limited);
  enter(safety::next_mode(before, conditions), static_cast<std::int32_t>(params.period_us),
        machine);
  if (flutters(params, state.admit, before, conditions, machine)) faults |= safety::kFaultFlutter;
  if (machine.mode == Mode::kFallen) faults |= safety::kFaultFall;
  if (is_refused(before, conditions)) faults |= safety::kFaultJointBeyond;
  if (before == Mode::kGettingUp && machine.mode == Mode::kStanding) {
    machine.faults &= ~std::uint32_t{safety::kFaultFall};
  }
  // Relaxing a relaxed robot acknowledges faults.
  const bool acknowledged = before == Mode::kRelaxed && machine.mode == Mode::kRelaxed &&
                            (conditions & safety::kAskRelax) != 0;
  machine.faults = acknowledged ? faults : machine.faults | faults;

  outputs = Outputs{};
  outputs.mode = static_cast<std::uint8_t>(machine.mode);
  outputs.faults = machine.faults;
  outputs.gait_phase = static_cast<std::uint8_t>(plan.phase);
  outputs.gait_state = plan.cycle_state;
  outputs.stance = plan.carrying;
  outputs.tilt_tenth_mrad[0] = math::to_int16(1e4F * attitude.roll_rad);
  outputs.tilt_tenth_mrad[1] = math::to_int16(1e4F * attitude.pitch_rad);
  for (int j = 0; j < params.joint_count; ++j) {
    const int driver = model::driver_of(params, j);
    outputs.goal_count[j] = model::count_of(params.joint[driver], state.limit.goal_rad[driver]);
  }
  if (safety::has_torque(machine.mode)) {
    outputs.torque_enable =
        static_cast<std::uint32_t>((std::uint64_t{1} << params.joint_count) - 1U);
  }
}

}  // namespace verp::control
