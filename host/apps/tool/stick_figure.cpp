#include "host/apps/tool/stick_figure.hpp"

#include <algorithm>

#include "common/kinematics/forward.hpp"

namespace verp::tool {
namespace {

using model::Vec3;
using Kind = report::Limb::Kind;

Kind kind_of(const std::string& limb) {
  if (limb.ends_with("leg")) return Kind::kLeg;
  return limb.ends_with("arm") ? Kind::kArm : Kind::kHead;
}

int side_of(const std::string& limb) {
  if (limb.starts_with("left")) return 0;
  return limb.starts_with("right") ? 1 : 2;
}

}  // namespace

StickFigure::StickFigure(const model::Entity& entity, const Params& params)
    : entity_(entity), params_(params) {
  add_trunk();
  for (const model::Limb& limb : entity.limbs) add_limb(limb);
}

void StickFigure::add_trunk() {
  Vec3 hips_m = Vec3::Zero(), top_m = Vec3::Zero();
  int legs = 0;
  for (const model::Limb& limb : entity_.limbs) {
    const model::Joint& root = entity_.joints[static_cast<std::size_t>(limb.joints.front())];
    if (root.parent != 0) continue;
    if (kind_of(limb.name) == Kind::kLeg) {
      hips_m += root.origin_m;
      ++legs;
    } else if (root.origin_m.z() > top_m.z()) {
      top_m = root.origin_m;
    }
  }
  hips_m /= std::max(legs, 1);
  top_m.y() = 0;  // for a robot without a head
  limbs_.push_back({Kind::kTrunk, 2});
  bones_.push_back({{0, hips_m}, {0, top_m}});
}

void StickFigure::add_limb(const model::Limb& limb) {
  limbs_.push_back({kind_of(limb.name), side_of(limb.name)});
  std::vector<Bone> bones;
  for (const int joint : limb.joints) bones.push_back({joint + 1, Vec3::Zero()});
  const int last = bones.back().node;
  const Vec3& com_m = entity_.nodes[static_cast<std::size_t>(last)].com_m;
  if (limbs_.back().kind == Kind::kLeg) {
    const double middle_y_m = (limb.sole_min_m.y() + limb.sole_max_m.y()) / 2;
    for (const double x_m : {limb.sole_min_m.x(), limb.sole_max_m.x()}) {
      bones.push_back({last, limb.tip * Vec3(x_m, middle_y_m, 0)});
    }
    bones.push_back({last, Vec3::Zero()});
  } else {
    // A forearm is a rod with its mass in the middle.
    bones.push_back({last, limbs_.back().kind == Kind::kArm ? Vec3(2 * com_m) : com_m});
  }
  bones_.push_back(std::move(bones));
}

std::vector<std::vector<report::Point3>> StickFigure::lines(const sim::SeriesRow& row) const {
  const math::Vec3 rpy = row.body_rpy_rad.cast<float>();
  const Pose body(math::rotation_rpy(rpy.x(), rpy.y(), rpy.z()), row.body_world_m.cast<float>());
  float angle_rad[kMaxJoints] = {};
  for (std::size_t j = 0; j < row.joint_rad.size(); ++j) {
    angle_rad[j] = static_cast<float>(row.joint_rad[j]);
  }
  Pose pose[kMaxNodes];
  kinematics::all_poses(params_, body, angle_rad, pose);
  std::vector<std::vector<report::Point3>> lines;
  for (const std::vector<Bone>& bones : bones_) {
    lines.emplace_back();
    for (const Bone& bone : bones) {
      const Pose& link = pose[bone.node];
      const math::Vec3 at = link.position_m + link.rotation * bone.point_m.cast<float>();
      const auto x_m = static_cast<double>(at.x()), y_m = static_cast<double>(at.y()),
                 z_m = static_cast<double>(at.z());
      lines.back().push_back({x_m, y_m, z_m});
    }
  }
  return lines;
}

}  // namespace verp::tool
