#include "host/author/action/poser.hpp"

#include <fmt/format.h>

#include "common/gait/gait.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "common/model/leg.hpp"

namespace verp::action {
namespace {

Pose moved(const Pose& pose, const Offset& offset) {
  const auto f = [](double value) { return static_cast<float>(value); };
  const Vec3 by_m{f(offset.move_m[0]), f(offset.move_m[1]), f(offset.move_m[2])};
  const Mat3 turn =
      math::rotation_rpy(f(offset.turn_rad[0]), f(offset.turn_rad[1]), f(offset.turn_rad[2]));
  return {turn * pose.rotation, pose.position_m + by_m};
}

/// The stand with the centre of mass over the soles.
gait::Posture settled(const Params& params) {
  constexpr int kGlideTicks = 2000;
  gait::GaitState state;
  gait::stand_legs(params, state.preview.leg_rad);
  float goal_rad[kMaxJoints] = {};
  for (int j = 0; j < params.joint_count; ++j) goal_rad[j] = params.joint[j].stand_rad;
  gait::GaitIn in;
  in.goal_rad = goal_rad;
  in.period_us = static_cast<std::int32_t>(params.period_us);
  gait::Posture posture;
  for (int i = 0; i < kGlideTicks; ++i) {
    posture = gait::update(params, params.tuning, state, in).posture;
  }
  return posture;
}

Pose sole_of(const gait::FootPose& foot) {
  return {math::rot_z(foot.on.yaw_rad), Vec3(foot.on.at_m.x, foot.on.at_m.y, foot.height_m)};
}

}  // namespace

Poser::Poser(const Params& params) : params_(params), stand_(settled(params)) {
  for (int j = 0; j < params.joint_count; ++j) {
    stand_rad_[static_cast<std::size_t>(j)] = params.joint[j].stand_rad;
  }
  if (params.leg[0].solver != LegSolver::kNone) bend({}, stand_rad_);
}

Vec3 Poser::middle_m(const Pose& sole, int side) const {
  const LegParams& leg = params_.leg[side];
  return math::apply(sole, {0.5F * (leg.sole_front_m - leg.sole_back_m),
                            0.5F * (leg.sole_left_m - leg.sole_right_m), 0});
}

std::string Poser::solve(const Pose& body, const Pose* sole, Angles& angle_rad) const {
  constexpr const char* kSides[] = {"left", "right"};
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = params_.leg[side];
    float previous_rad[kLegJoints];
    model::read_leg(leg, angle_rad.data(), previous_rad);
    const kinematics::LegAngles solved =
        kinematics::solve_leg(params_, leg, math::inverse(body) * sole[side], previous_rad);
    model::write_leg(leg, solved.angle_rad, angle_rad.data());
    if ((solved.flags & kinematics::kOutOfReach) != 0) {
      return fmt::format("the {} leg does not reach there", kSides[side]);
    }
    for (int k = 0; k < kLegJoints && solved.flags != 0; ++k) {
      if (!model::has(leg, k)) continue;
      const JointParams& joint = params_.joint[leg.joint[k]];
      if (solved.angle_rad[k] > joint.lower_rad && solved.angle_rad[k] < joint.upper_rad) continue;
      return fmt::format("the {} leg does not come there: joint '{}' is at its limit", kSides[side],
                         joint.name);
    }
    if (solved.flags != 0) return fmt::format("the {} leg does not come there", kSides[side]);
  }
  return "";
}

std::string Poser::bend(const Legs& legs, Angles& angle_rad) const {
  constexpr int kMostTurns = 50;
  constexpr float kThere_m = 1e-4F;
  if (params_.leg[0].solver == LegSolver::kNone) return "the robot has no legs that can be solved";
  Pose body = moved(stand_.body, legs.body);
  Pose sole[kFeet];
  for (int side = 0; side < kFeet; ++side) {
    sole[side] = moved(sole_of(stand_.foot[side]), legs.foot[side]);
  }
  std::string trouble = solve(body, sole, angle_rad);
  if (!legs.over_left) return trouble;
  const auto left = static_cast<float>(*legs.over_left);
  // The stand's soles, even for a foot that swings.
  const Vec3 target_m = left * middle_m(sole_of(stand_.foot[0]), 0) +
                        (1 - left) * middle_m(sole_of(stand_.foot[1]), 1);
  for (int i = 0; i < kMostTurns; ++i) {
    const Vec3 com_m = kinematics::center_of_mass(params_, body, angle_rad.data());
    const Vec3 off_m = target_m - com_m;
    if (std::abs(off_m.x()) < kThere_m && std::abs(off_m.y()) < kThere_m) break;
    body.position_m += Vec3(off_m.x(), off_m.y(), 0);
    trouble = solve(body, sole, angle_rad);
  }
  return trouble;
}

}  // namespace verp::action
