#include "host/show/scene/measured.hpp"

#include <algorithm>
#include <cstring>

#include "host/trace/record/ros_messages.hpp"
#include "host/twin/sim/body.hpp"

namespace verp::scene {
namespace {

/// Without force cells, a sole this close to the floor stands on it.
constexpr double kTouches_m = 0.004;

Vec3 com_of(const RobotView& view, const Entity& entity) {
  Vec3 moment = Vec3::Zero();
  double mass_kg = 0;
  for (std::size_t n = 0; n < entity.nodes.size(); ++n) {
    moment += entity.nodes[n].mass_kg * (view.link_world[n] * entity.nodes[n].com_m);
    mass_kg += entity.nodes[n].mass_kg;
  }
  return mass_kg > 0 ? Vec3(moment / mass_kg) : view.link_world.front().translation();
}

/// Order of cells: front-left, front-right, back-left, back-right.
constexpr std::size_t kCorner[kFootSensors] = {0, 1, 3, 2};

void add_foot_cells(RobotView& view, const sim::Truth& feet, const Params& params,
                    const Inputs& inputs) {
  Vec2 moment_n_m = Vec2::Zero();
  double sum_n = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    Vec3 at_m = Vec3::Zero();
    double foot_n = 0;
    for (std::size_t cell = 0; cell < kFootSensors; ++cell) {
      const double force_n =
          inputs.foot_count[side][cell] * static_cast<double>(params.feet.newton_per_count);
      at_m += force_n * feet.foot[side].corner_world_m[kCorner[cell]];
      foot_n += force_n;
    }
    view.foot_force_n[side] = foot_n;
    view.foot_contact[side] = foot_n > sim::kContactForceN;
    if (!view.foot_contact[side]) continue;
    view.contacts.push_back({static_cast<int>(side), at_m / foot_n, {0, 0, foot_n}});
    moment_n_m += at_m.head<2>();
    sum_n += foot_n;
  }
  if (sum_n > sim::kContactForceN) view.zmp_world_m = moment_n_m / sum_n;
}

}  // namespace

std::string text_of(const char (&name)[kNameLength]) {
  return {name, ::strnlen(name, kNameLength)};
}

std::vector<double> measured_rad(const Inputs& inputs, const Params& params) {
  std::vector<double> joint_rad;
  for (std::size_t j = 0; j < params.joint_count; ++j) {
    joint_rad.push_back(record::ros::joint_rad(params.joint[j], inputs.position_count[j]));
  }
  return joint_rad;
}

sim::Truth soles_of(const RobotView& view, const Entity& entity) {
  sim::Truth truth;
  for (int side = 0; side < 2; ++side) {
    const model::Limb* leg = sim::find_leg(entity, side);
    if (leg == nullptr) continue;
    sim::FootTruth& foot = truth.foot[static_cast<std::size_t>(side)];
    const auto node = static_cast<std::size_t>(leg->joints.back() + 1);
    foot.present = true;
    foot.sole_world = view.link_world[node] * leg->tip;
    const Vec3 &low = leg->sole_min_m, &high = leg->sole_max_m;
    foot.corner_world_m = {
        foot.sole_world * Vec3(high.x(), high.y(), 0), foot.sole_world * Vec3(high.x(), low.y(), 0),
        foot.sole_world * Vec3(low.x(), low.y(), 0), foot.sole_world * Vec3(low.x(), high.y(), 0)};
    foot.centroid_world_m =
        foot.sole_world * Vec3((low.x() + high.x()) / 2, (low.y() + high.y()) / 2, 0);
  }
  return truth;
}

void add_measured(RobotView& view, const Entity& entity, const Params& params,
                  const Inputs& inputs) {
  view.com_world_m = com_of(view, entity);
  const sim::Truth feet = soles_of(view, entity);
  if ((inputs.flags & kFeetFresh) != 0 && feet.foot[0].present && feet.foot[1].present) {
    add_foot_cells(view, feet, params, inputs);
  } else {
    for (std::size_t side = 0; side < 2; ++side) {
      view.foot_contact[side] =
          feet.foot[side].present && feet.foot[side].centroid_world_m.z() < kTouches_m;
    }
  }
  for (ContactForce& contact : view.contacts) {
    contact.node = sim::find_leg(entity, contact.node)->joints.back() + 1;
  }
  std::vector<Vec2> corners;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!view.foot_contact[side]) continue;
    for (const Vec3& corner : feet.foot[side].corner_world_m) corners.push_back(corner.head<2>());
  }
  view.support_world_m = sim::convex_hull(std::move(corners));
}

}  // namespace verp::scene
