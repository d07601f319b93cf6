#include "common/balance/landing.hpp"

#include "common/model/leg.hpp"

namespace verp::balance {
namespace {

constexpr float kLearning = 0.2F;     // share of one landing's error
constexpr float kLeastWay_m = 0.02F;  // shorter ways show noise
constexpr float kLeast = -0.1F, kMost = 0.3F;
constexpr float kSettling = 0.15F;  // share of a step until a landed leg rests

bool sole_in_body(const Params& params, const Inputs& inputs, int side, Vec3& sole_m) {
  const LegParams& leg = params.leg[side];
  float angle_rad[kLegJoints];
  if (!model::measure_leg(params, leg, inputs, angle_rad)) return false;
  const kinematics::LegChain chain = kinematics::leg_chain(params, leg, Pose{}, angle_rad);
  sole_m = kinematics::sole_pose(leg, chain).position_m;
  return true;
}

}  // namespace

void learn_landing(const Params& params, const gait::GaitState& gait, const gait::GaitOut& plan,
                   const Inputs& inputs, bool as_planned, LandingState& state) {
  const bool exchanged = plan.carrying != state.carrying;
  state.carrying = plan.carrying;
  // Goals lead the robot: it lands the step that begins now.
  const gait::Step& step = gait.queue[0];
  if (!exchanged || !as_planned || plan.carrying == gait::kBoth || step.landed != plan.carrying)
    return;
  const int side = step.landed, other = 1 - side;
  const gait::Xy way_m = step.foot[side].at_m - gait.previous.foot[side].at_m;
  const float way2_m2 = gait::dot(way_m, way_m);
  Vec3 sole_m, other_m;
  if (!(way2_m2 > math::square(kLeastWay_m)) || !sole_in_body(params, inputs, side, sole_m) ||
      !sole_in_body(params, inputs, other, other_m))
    return;
  const Vec3 apart_m = plan.posture.body.rotation * (sole_m - other_m);
  const gait::Xy miss_m =
      gait::Xy{apart_m.x(), apart_m.y()} - (step.foot[side].at_m - step.foot[other].at_m);
  const float beyond = state.beyond + kLearning * gait::dot(miss_m, way_m) / way2_m2;
  state.beyond = math::clamp(beyond, kLeast, kMost);
}

gait::FootPose aim(const gait::GaitState& gait, const LandingState& state, int side,
                   const gait::FootPose& planned) {
  if (gait.queued == 0) return planned;
  const gait::Step& step = gait.queue[0];
  gait::FootPose aimed = planned;
  if (side == step.swing) {
    aimed.on.at_m = planned.on.at_m - state.beyond * (planned.on.at_m - step.foot[side].at_m);
  } else if (side == step.landed) {
    const float time_s = static_cast<float>(gait.clock_us) * 1e-6F;
    const float settled = math::clamp(time_s / (kSettling * step.duration_s()), 0.0F, 1.0F);
    const float left = state.beyond * (1.0F - math::minimum_jerk(settled).value);
    aimed.on.at_m = planned.on.at_m - left * (planned.on.at_m - gait.previous.foot[side].at_m);
  }
  return aimed;
}

}  // namespace verp::balance
