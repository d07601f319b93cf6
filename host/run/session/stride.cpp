#include "host/run/session/stride.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/gait/gait.hpp"
#include "common/model/leg.hpp"

namespace verp::session {
namespace {

// Within five seconds the planner has shortened a walk, or robots fall.
constexpr double kStand_s = 1.5, kWalk_s = 5;

class Plan {
 public:
  Plan(const Params& params, const Command& velocity) : params_(params) {
    for (int j = 0; j < params.joint_count; ++j) goal_rad_[j] = params.joint[j].stand_rad;
    gait::stand_legs(params, state_.preview.leg_rad);
    std::copy_n(state_.preview.leg_rad, kFeet * kLegJoints, leg_rad_);
    in_.goal_rad = goal_rad_;
    in_.period_us = static_cast<std::int32_t>(params.period_us);
    in_.wanted.vx_m_s = 1e-4F * static_cast<float>(velocity.vx_tenth_mm_s);
    in_.wanted.vy_m_s = 1e-4F * static_cast<float>(velocity.vy_tenth_mm_s);
    in_.wanted.wz_rad_s = 1e-3F * static_cast<float>(velocity.wz_mrad_s);
  }

  void run(bool walk, double duration_s) {
    in_.walk = walk;
    kept_ = 1;
    for (double t_s = 0; t_s < duration_s; t_s += period_s()) tick();
  }

  double kept() const { return (state_.footsteps.notes & gait::kPlanRefused) != 0 ? 0 : kept_; }

  Fastest measure(double duration_s) {
    fastest_ = {};
    run(true, duration_s);
    return fastest_;
  }

 private:
  double period_s() const { return 1e-6 * params_.period_us; }

  void tick() {
    const gait::GaitOut out = gait::update(params_, params_.tuning, state_, in_);
    kept_ = std::min(kept_, static_cast<double>(state_.footsteps.scale));
    for (int side = 0; side < kFeet; ++side) {
      const LegParams& leg = params_.leg[side];
      float* const last_rad = leg_rad_ + side * kLegJoints;
      const auto solved =
          kinematics::solve_leg(params_, leg, gait::sole_in_body(out.posture, side), last_rad);
      for (int k = 0; k < kLegJoints; ++k) {
        if (!model::has(leg, k)) continue;
        const JointParams& joint = params_.joint[leg.joint[k]];
        const double speed_rad_s =
            std::abs(static_cast<double>(solved.angle_rad[k] - last_rad[k])) / period_s();
        const auto limit_rad_s = static_cast<double>(joint.velocity_limit_rad_s);
        const double share = speed_rad_s / limit_rad_s;
        if (share > fastest_.share) fastest_ = {share, joint.name, limit_rad_s};
        last_rad[k] = solved.angle_rad[k];
      }
    }
  }

  const Params& params_;
  gait::GaitState state_;
  gait::GaitIn in_;
  float goal_rad_[kMaxJoints] = {};
  float leg_rad_[kFeet * kLegJoints] = {};
  Fastest fastest_;
  double kept_ = 1;
};

Command scaled(const Command& velocity, double share) {
  const auto part = [share](std::int16_t value) {
    return static_cast<std::int16_t>(std::lround(share * value));
  };
  Command less = velocity;
  less.vx_tenth_mm_s = part(velocity.vx_tenth_mm_s);
  less.vy_tenth_mm_s = part(velocity.vy_tenth_mm_s);
  less.wz_mrad_s = part(velocity.wz_mrad_s);
  return less;
}

}  // namespace

Fastest fastest_joint(const Params& params, const Command& velocity) {
  if (params.leg[0].solver == LegSolver::kNone) return {};
  Plan plan(params, velocity);
  plan.run(false, kStand_s);
  return plan.measure(kWalk_s);
}

double kept_stride(const Params& params, const Command& velocity) {
  if (params.leg[0].solver == LegSolver::kNone) return 0;
  Plan plan(params, velocity);
  plan.run(false, kStand_s);
  plan.run(true, kWalk_s);
  return plan.kept();
}

Command longest_order(const Params& params) {
  const GaitTuning& gait = params.tuning.gait;
  const long vx = std::lround(2e4F * gait.max_step_m / gait.cycle_s);
  Command command;
  command.vx_tenth_mm_s = static_cast<std::int16_t>(std::min(vx, 32767L));
  return command;
}

FeasibleVelocity within_servo_speed(const Params& params, const Command& velocity) {
  const Fastest asked = fastest_joint(params, velocity);
  if (asked.share <= kMostSpeedShare) return {velocity, ""};
  double enough = 0, too_much = 1;
  for (int halving = 0; halving < 5; ++halving) {
    const double share = (enough + too_much) / 2;
    const bool fits = fastest_joint(params, scaled(velocity, share)).share <= kMostSpeedShare;
    (fits ? enough : too_much) = share;
  }
  return {scaled(velocity, enough),
          fmt::format(
              "walks at {:.0f} % of the velocity asked for: its joint '{}' would turn at {:.1f} "
              "times its greatest speed; {}",
              100 * enough, asked.joint, asked.share,
              enough > 0 ? "a longer cycle or lower lift allows more"
                         : "even steps on the spot are too fast, `verp check` says what helps")};
}

}  // namespace verp::session
