#include "host/view/run/pose_hand.hpp"

#include <algorithm>

#include "host/scene/build.hpp"

namespace verp::view {

using kinematics::LegFlag;

PoseHand::PoseHand(const scene::Entity& entity, const Params& params)
    : entity_(entity), params_(params) {
  stand();
}

void PoseHand::set_joint(int joint, double angle_rad) {
  const model::Joint& limits = entity_.joints[static_cast<std::size_t>(joint)];
  joint_rad_[static_cast<std::size_t>(joint)] =
      std::clamp(angle_rad, limits.lower_rad, limits.upper_rad);
}

void PoseHand::stand() {
  joint_rad_.clear();
  for (const model::Joint& joint : entity_.joints) joint_rad_.push_back(joint.stand_rad);
  flags_ = {};
}

bool PoseHand::has_leg(int side) const {
  return params_.leg[side].solver != LegSolver::kNone;
}

kinematics::LegChain PoseHand::chain(int side) const {
  const LegParams& leg = params_.leg[side];
  float angle_rad[kLegJoints];
  for (int i = 0; i < kLegJoints; ++i) {
    angle_rad[i] = static_cast<float>(joint_rad_[leg.joint[i]]);
  }
  return kinematics::leg_chain(params_, leg, math::Pose(), angle_rad);
}

scene::Vec3 PoseHand::sole_body_m(int side) const {
  return kinematics::sole_pose(params_.leg[side], chain(side)).position_m.cast<double>();
}

void PoseHand::move_foot(int side, const scene::Vec3& sole_body_m) {
  if (!has_leg(side)) return;
  const LegParams& leg = params_.leg[side];
  math::Pose wanted = kinematics::sole_pose(leg, chain(side));
  wanted.position_m = sole_body_m.cast<float>();
  float previous_rad[kLegJoints];
  for (int i = 0; i < kLegJoints; ++i) {
    previous_rad[i] = static_cast<float>(joint_rad_[leg.joint[i]]);
  }
  const kinematics::LegAngles found = kinematics::solve_leg(params_, leg, wanted, previous_rad);
  flags_[static_cast<std::size_t>(side)] = found.flags;
  for (int i = 0; i < kLegJoints; ++i) {
    set_joint(leg.joint[i], static_cast<double>(found.angle_rad[i]));
  }
}

int PoseHand::foot_of(int node) const {
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = params_.leg[side];
    if (!has_leg(side)) continue;
    for (int i = kLegJoints - 2; i < kLegJoints; ++i) {
      if (node == leg.joint[i] + 1) return side;
    }
  }
  return -1;
}

std::string PoseHand::reach(int side) const {
  const std::uint8_t flags = flags_[static_cast<std::size_t>(side)];
  std::string text;
  const auto add = [&](std::uint8_t flag, const char* words) {
    if ((flags & flag) != 0) text += (text.empty() ? "" : ", ") + std::string(words);
  };
  add(LegFlag::kOutOfReach, "out of reach: nearest pose");
  add(LegFlag::kJointLimited, "held at a joint's limit");
  add(LegFlag::kNotConverged, "not converged");
  return text.empty() ? "within reach" : text;
}

std::string PoseHand::solver(int side) const {
  switch (params_.leg[side].solver) {
    case LegSolver::kClosedForm:
      return "closed form";
    case LegSolver::kNewton:
      return "Newton";
    case LegSolver::kNone:
      break;
  }
  return "no leg solver";
}

scene::Snapshot PoseHand::snapshot() const {
  scene::Snapshot now;
  scene::RobotView robot = scene::standing(entity_, scene::Vec3(0, 0, kAir_m));
  const scene::Transform body = robot.link_world.front();
  now.robots.push_back(scene::posed(entity_, body, joint_rad_));
  return now;
}

}  // namespace verp::view
