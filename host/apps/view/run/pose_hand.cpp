#include "host/apps/view/run/pose_hand.hpp"

#include <algorithm>
#include <cmath>

#include "common/model/leg.hpp"
#include "host/show/scene/build.hpp"
#include "host/twin/sim/body.hpp"

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
  link_reach_.clear();
}

void PoseHand::read_leg(const LegParams& leg, float* leg_rad) const {
  for (int i = 0; i < kLegJoints; ++i) {
    leg_rad[i] = verp::model::has(leg, i) ? static_cast<float>(joint_rad_[leg.joint[i]]) : 0.0F;
  }
}

bool PoseHand::has_leg(int side) const {
  return params_.leg[side].solver != LegSolver::kNone;
}

kinematics::LegChain PoseHand::chain(int side) const {
  const LegParams& leg = params_.leg[side];
  float angle_rad[kLegJoints];
  read_leg(leg, angle_rad);
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
  read_leg(leg, previous_rad);
  const kinematics::LegAngles found = kinematics::solve_leg(params_, leg, wanted, previous_rad);
  flags_[static_cast<std::size_t>(side)] = found.flags;
  for (int i = 0; i < kLegJoints; ++i) {
    if (!verp::model::has(leg, i)) continue;
    set_joint(leg.joint[i], static_cast<double>(found.angle_rad[i]));
  }
}

scene::Vec3 PoseHand::point_body_m(int node, const scene::Vec3& point_link_m) const {
  const auto poses = sim::link_poses(entity_, scene::Transform::Identity(), joint_rad_);
  return poses.at(static_cast<std::size_t>(node)) * point_link_m;
}

std::vector<std::size_t> PoseHand::joints_to(int node) const {
  std::vector<std::size_t> joints;  // joint j moves node j + 1
  for (int at = node; at > 0; at = entity_.joints[static_cast<std::size_t>(at - 1)].parent) {
    const auto joint = static_cast<std::size_t>(at - 1);
    if (entity_.joints[joint].follows < 0) joints.push_back(joint);
  }
  return joints;
}

bool PoseHand::step_to(const std::vector<std::size_t>& joints, int node,
                       const scene::Vec3& point_link_m, const scene::Vec3& to_body_m) {
  const auto poses = sim::link_poses(entity_, scene::Transform::Identity(), joint_rad_);
  const scene::Vec3 at = poses[static_cast<std::size_t>(node)] * point_link_m, off = to_body_m - at;
  Eigen::Matrix3Xd turn(3, joints.size());  // motion by each joint, m/rad
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const model::Joint& joint = entity_.joints[joints[i]];
    const scene::Transform& link = poses[joints[i] + 1];
    const auto column = static_cast<Eigen::Index>(i);
    turn.col(column) = (link.linear() * joint.axis).cross(at - link.translation());
    const double wish = turn.col(column).dot(off), angle_rad = joint_rad_[joints[i]];
    const bool stuck = wish > 0 ? angle_rad >= joint.upper_rad : angle_rad <= joint.lower_rad;
    if (stuck) turn.col(column).setZero();
  }
  // Damped by the remaining error (Sugihara 2011): stable far away, fast near a solution.
  const double damping = 1e-7 + 0.1 * off.squaredNorm();
  const Eigen::Matrix3d square = turn * turn.transpose() + damping * Eigen::Matrix3d::Identity();
  const Eigen::VectorXd change = turn.transpose() * square.ldlt().solve(off);
  constexpr double kStep_rad = 0.2;
  const double share = std::min(1.0, kStep_rad / std::max(change.cwiseAbs().maxCoeff(), 1e-12));
  for (std::size_t i = 0; i < joints.size(); ++i)
    set_joint(static_cast<int>(joints[i]),
              joint_rad_[joints[i]] + share * change[static_cast<Eigen::Index>(i)]);
  return change.cwiseAbs().maxCoeff() > 1e-6;
}

void PoseHand::move_link(int node, const scene::Vec3& point_link_m, const scene::Vec3& to_body_m) {
  constexpr int kMostSteps = 100;
  constexpr double kThere_m = 1e-4;
  const std::vector<std::size_t> joints = joints_to(node);
  if (joints.empty()) {
    link_reach_ = "is held; take a limb";
    return;
  }
  const auto off_m = [&] { return (point_body_m(node, point_link_m) - to_body_m).norm(); };
  std::vector<double> best = joint_rad_;
  double least_m = off_m();
  for (int i = 0; i < kMostSteps && least_m > kThere_m; ++i) {
    const bool moved = step_to(joints, node, point_link_m, to_body_m);
    if (const double now_m = off_m(); now_m < least_m) {
      least_m = now_m;
      best = joint_rad_;
    }
    if (!moved) break;
  }
  joint_rad_ = best;
  const bool limited = std::any_of(joints.begin(), joints.end(), [&](std::size_t j) {
    const model::Joint& joint = entity_.joints[j];
    return joint_rad_[j] <= joint.lower_rad || joint_rad_[j] >= joint.upper_rad;
  });
  link_reach_ = least_m <= kThere_m
                    ? "within reach"
                    : "out of reach: " + std::to_string(std::lround(1e3 * least_m)) + " mm short";
  if (limited) link_reach_ += ", held at a joint's limit";
  link_reach_ += " (damped least squares)";
}

int PoseHand::foot_of(int node) const {
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = params_.leg[side];
    if (!has_leg(side)) continue;
    for (int i = kLegJoints - 2; i < kLegJoints; ++i) {
      if (verp::model::has(leg, i) && node == leg.joint[i] + 1) return side;
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
