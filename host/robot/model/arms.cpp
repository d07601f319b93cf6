#include "host/robot/model/arms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "host/robot/model/leg.hpp"

namespace verp::model {
namespace {

constexpr std::uint8_t kNone = 0xFF;
// Arms too light or too near the middle compensate less.
constexpr double kMost_rad_per_m = 6;

std::uint8_t swinging_joint(const Entity& entity, const Params& params, const char* limb) {
  const Limb* const arm = find_limb(entity, limb);
  if (!arm) return kNone;
  for (const int j : arm->joints) {
    const Vec3& axis = entity.joints[static_cast<std::size_t>(j)].axis;
    if (j < params.servo_count() && std::abs(axis.y()) > 0.9) return static_cast<std::uint8_t>(j);
  }
  return kNone;
}

/// Link frames relative to the body, in the stand pose.
class Standing {
 public:
  explicit Standing(const Entity& entity) : entity_(entity), link_(entity.nodes.size()) {
    // A follower joint may precede its parents, so repeat once per level of depth.
    link_[0] = Transform::Identity();
    std::vector<bool> placed(link_.size());
    placed[0] = true;
    for (std::size_t round = 0; round < link_.size(); ++round) {
      for (std::size_t j = 0; j < entity.joints.size(); ++j) {
        const Joint& joint = entity.joints[j];
        const auto parent = static_cast<std::size_t>(joint.parent);
        if (placed[j + 1] || !placed[parent]) continue;
        link_[j + 1] = link_[parent] * Eigen::Translation3d(joint.origin_m) *
                       Eigen::AngleAxisd(joint.stand_rad, joint.axis);
        placed[j + 1] = true;
      }
    }
  }

  /// Angular momentum about the vertical through the body's origin, joint j at 1 rad/s.
  double turned_by(std::size_t j) const {
    const Vec3 axis = link_[j + 1].linear() * entity_.joints[j].axis;
    double sum = 0;
    for (std::size_t node = 1; node < link_.size(); ++node) {
      if (!moves(j, node)) continue;
      const Vec3 at = com_m(node);
      const Vec3 velocity = axis.cross(at - link_[j + 1].translation());
      sum += entity_.nodes[node].mass_kg * at.cross(velocity).z();
    }
    return sum;
  }

  /// A leg's, with its foot moving backward at 1 m/s.
  double turned_by_leg(const LegParams& leg, const Limb& limb) const {
    const auto foot = static_cast<std::size_t>(limb.joints.back()) + 1;
    const double hip_m = static_cast<double>(leg.hip_body_m.z);
    const double sole_m = (link_[foot] * limb.tip).translation().z();
    double sum = 0;
    for (const int j : limb.joints) {
      const auto node = static_cast<std::size_t>(j) + 1;
      const Vec3 at = com_m(node);
      const double share = std::clamp((hip_m - at.z()) / (hip_m - sole_m), 0.0, 1.0);
      sum += entity_.nodes[node].mass_kg * share * at.y();
    }
    return sum;
  }

 private:
  bool moves(std::size_t j, std::size_t node) const {
    while (node != 0 && node != j + 1) {
      node = static_cast<std::size_t>(entity_.joints[node - 1].parent);
    }
    return node != 0;
  }

  Vec3 com_m(std::size_t node) const { return link_[node] * entity_.nodes[node].com_m; }

  const Entity& entity_;
  std::vector<Transform> link_;
};

}  // namespace

void find_arms(const Entity& entity, Params& params) {
  const std::array<const Limb*, kFeet> leg = {find_limb(entity, "left_leg"),
                                              find_limb(entity, "right_leg")};
  const std::array<std::uint8_t, kFeet> arm = {swinging_joint(entity, params, "left_arm"),
                                               swinging_joint(entity, params, "right_arm")};
  if (!leg[0] || !leg[1] || arm[0] == kNone || arm[1] == kNone) return;
  const Standing robot(entity);
  // One foot ahead, one back, at half their relative speed each.
  const double legs =
      (robot.turned_by_leg(params.leg[0], *leg[0]) - robot.turned_by_leg(params.leg[1], *leg[1])) /
      2;
  for (std::size_t side = 0; side < kFeet; ++side) {
    const double turned = 2 * robot.turned_by(arm[side]);
    if (std::abs(turned) < 1e-9) return;
    params.arm[side] = arm[side];
    params.arm_rad_per_m[side] =
        static_cast<float>(std::clamp(legs / turned, -kMost_rad_per_m, kMost_rad_per_m));
  }
}

}  // namespace verp::model
