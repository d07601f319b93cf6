#include "host/author/action/support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/kinematics/forward.hpp"
#include "common/model/tree.hpp"

namespace verp::action {
namespace {

float cross2(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vec2> around;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = around.size();
    for (const Vec2& point : points) {
      while (around.size() >= first + 2 &&
             cross2(around.back() - around[around.size() - 2], point - around.back()) <= 0) {
        around.pop_back();
      }
      around.push_back(point);
    }
    around.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return around;
}

std::array<Vec3, 4> corners(const LegParams& leg) {
  return {Vec3(leg.sole_front_m, leg.sole_left_m, 0), Vec3(leg.sole_front_m, -leg.sole_right_m, 0),
          Vec3(-leg.sole_back_m, leg.sole_left_m, 0), Vec3(-leg.sole_back_m, -leg.sole_right_m, 0)};
}

}  // namespace

Pose Support::sole(const PlayerOut& now, int side) const {
  const LegParams& leg = params_.leg[side];
  float leg_rad[kLegJoints];
  for (int k = 0; k < kLegJoints; ++k) leg_rad[k] = now.angle_rad[leg.joint[k]];
  return kinematics::sole_pose(leg, kinematics::leg_chain(params_, leg, Pose{}, leg_rad));
}

Vec3 Support::com_over(const PlayerOut& now, int side) const {
  const Vec3 com_m = kinematics::center_of_mass(params_, Pose{}, now.angle_rad);
  return math::apply(math::inverse(sole(now, side)), com_m);
}

double Support::margin_m(const PlayerOut& now, int side, const Vec2& point_m) const {
  std::vector<Vec2> points;
  const Pose from = math::inverse(sole(now, side));
  for (int foot = 0; foot < kFeet; ++foot) {
    if (now.stance != Stance::kBoth && foot != static_cast<int>(now.stance)) continue;
    const Pose there = from * sole(now, foot);
    for (const Vec3& corner : corners(params_.leg[foot])) {
      const Vec3 at = math::apply(there, corner);
      points.emplace_back(at.x(), at.y());
    }
  }
  const std::vector<Vec2> around = hull(points);
  double margin = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Vec2 edge = around[(i + 1) % around.size()] - around[i];
    const double length = std::hypot(edge.x(), edge.y());
    margin = std::min(margin, cross2(edge, point_m - around[i]) / std::max(length, 1e-6));
  }
  return margin;
}

Torques Support::torques(const PlayerOut& now) const {
  std::array<Pose, kMaxNodes> node;
  kinematics::all_poses(params_, Pose{}, now.angle_rad, node.data());
  const Pose soles[kFeet] = {sole(now, 0), sole(now, 1)};
  const Vec3 up = math::normalized_or(
      now.carry[0] * soles[0].rotation.col(2) + now.carry[1] * soles[1].rotation.col(2),
      Vec3(0, 0, 1));
  const Vec3 com_m = kinematics::center_of_mass(params_, Pose{}, now.angle_rad);
  const float push_n = model::total_mass(params_) * math::kGravityMS2;
  Torques torques{};
  for (int j = 0; j < params_.joint_count; ++j) {
    const std::uint32_t beyond = model::subtree(params_, j + 1) | 1U << j;
    const Vec3 at_m = node[static_cast<std::size_t>(j) + 1].position_m;
    Vec3 moment = Vec3::Zero();
    for (int i = 0; i < params_.joint_count; ++i) {
      if ((beyond >> i & 1U) == 0) continue;
      const Vec3 mass_m = math::apply(node[static_cast<std::size_t>(i) + 1],
                                      math::to_vec(params_.joint[i].com_link_m));
      const Vec3 weight_n = -math::kGravityMS2 * params_.joint[i].mass_kg * up;
      moment += math::cross(mass_m - at_m, weight_n);
    }
    for (int foot = 0; foot < kFeet; ++foot) {
      const LegParams& leg = params_.leg[foot];
      if (leg.solver == LegSolver::kNone || (beyond >> leg.joint[kLegJoints - 1] & 1U) == 0) {
        continue;
      }
      // The ground pushes below the centre of mass if the foot carries alone, else at the sole's
      // middle.
      const Vec3 below_m = com_m - (com_m - soles[foot].position_m).dot(up) * up;
      const Vec3 ground_m = now.stance == Stance::kBoth ? soles[foot].position_m : below_m;
      moment += math::cross(ground_m - at_m, now.carry[foot] * push_n * up);
    }
    const Vec3 axis =
        kinematics::joint_axis(params_.joint[j], node[static_cast<std::size_t>(j) + 1].rotation);
    torques[static_cast<std::size_t>(j)] = axis.dot(moment);
  }
  return torques;
}

}  // namespace verp::action
