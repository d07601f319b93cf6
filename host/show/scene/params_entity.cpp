#include "host/show/scene/params_entity.hpp"

#include <algorithm>

#include "host/robot/model/principal.hpp"
#include "host/show/scene/measured.hpp"

namespace verp::scene {
namespace {

Vec3 metres(const Xyz& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

void add_bone(model::Node& node, const Vec3& to_m) {
  const double length_m = to_m.norm();
  model::Visual bone;
  bone.shape = model::Visual::Shape::kCapsule;
  bone.size_m = {0.009, 0, length_m};
  bone.pose = Transform(model::turn_of_z(length_m > 1e-6 ? to_m : Vec3(Vec3::UnitZ())));
  bone.pose.translation() = to_m / 2;
  node.visuals.push_back(bone);
}

void add_leg(Entity& entity, const LegParams& leg, const char* name) {
  if (leg.solver == LegSolver::kNone) return;
  model::Limb limb;
  limb.name = name;
  for (const std::uint8_t joint : leg.joint) limb.joints.push_back(joint);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      limb.tip.linear()(row, column) = static_cast<double>(leg.sole_foot[3 * row + column]);
    }
  }
  limb.tip.translation() = metres(leg.sole_foot_m);
  limb.sole_min_m = {-static_cast<double>(leg.sole_back_m), -static_cast<double>(leg.sole_right_m),
                     0};
  limb.sole_max_m = {static_cast<double>(leg.sole_front_m), static_cast<double>(leg.sole_left_m),
                     0};
  model::Visual sole;
  sole.size_m = limb.sole_max_m - limb.sole_min_m + Vec3(0, 0, 0.006);
  sole.pose =
      limb.tip * Eigen::Translation3d((limb.sole_min_m + limb.sole_max_m) / 2 + Vec3(0, 0, 0.003));
  entity.nodes[static_cast<std::size_t>(limb.joints.back()) + 1].visuals.push_back(sole);
  entity.limbs.push_back(limb);
}

}  // namespace

Entity entity_of(const Params& params) {
  Entity entity;
  entity.name = text_of(params.name);
  entity.nodes.resize(params.joint_count + std::size_t{1});
  entity.nodes[0].name = "body";
  entity.nodes[0].mass_kg = static_cast<double>(params.body_mass_kg);
  entity.nodes[0].com_m = metres(params.body_com_m);
  for (std::size_t j = 0; j < params.joint_count; ++j) {
    const JointParams& from = params.joint[j];
    model::Joint joint;
    joint.name = text_of(from.name);
    joint.parent = from.parent;
    joint.origin_m = metres(from.origin_parent_m);
    joint.axis = metres(from.axis);
    joint.lower_rad = static_cast<double>(from.lower_rad);
    joint.upper_rad = static_cast<double>(from.upper_rad);
    joint.stand_rad = static_cast<double>(from.stand_rad);
    entity.joints.push_back(joint);
    model::Node& node = entity.nodes[j + 1];
    node.name = joint.name;
    node.mass_kg = static_cast<double>(from.mass_kg);
    node.com_m = metres(from.com_link_m);
    add_bone(entity.nodes[from.parent], joint.origin_m);
  }
  for (std::size_t n = 1; n < entity.nodes.size(); ++n) {
    if (entity.nodes[n].visuals.empty()) add_bone(entity.nodes[n], 2 * entity.nodes[n].com_m);
  }
  add_leg(entity, params.leg[0], "left_leg");
  add_leg(entity, params.leg[1], "right_leg");
  return entity;
}

}  // namespace verp::scene
