#include "host/show/scene/from_twin.hpp"

#include "host/show/scene/plan_marks.hpp"
#include "host/twin/sim/body.hpp"
#include "host/twin/sim/planned_zmp.hpp"
#include "host/twin/sim/scenery.hpp"

namespace verp::scene {
namespace {

void add_truth(RobotView& view, const sim::Observation& seen, const Entity& entity) {
  const sim::Truth& truth = seen.truth;
  view.joint_rad = truth.joint_rad;
  view.link_world = sim::link_poses(entity, truth.body_world, truth.joint_rad);
  view.torque_use = truth.torque_use;
  view.com_world_m = truth.com_world_m;
  view.support_world_m = truth.support_world_m;
  view.held = truth.held;
  view.fallen = truth.fallen;
  if (seen.loads.valid()) view.zmp_world_m = seen.loads.zmp_world_m();
  for (std::size_t side = 0; side < 2; ++side) {
    view.foot_contact[side] = truth.foot[side].contact;
    view.foot_force_n[side] = truth.foot[side].normal_force_n;
  }
}

/// Contacts of the last physics step.
void add_contacts(RobotView& view, const sim::World& world, int owner) {
  for (const sim::Contact& contact : world.contacts()) {
    if (contact.owner != owner) continue;
    view.contacts.push_back({contact.node, contact.position_world_m, contact.force_world_n});
  }
}

void add_controller(RobotView& view, const session::Tick& tick, const sim::Truth& truth,
                    const Params& params) {
  if (tick.outputs != nullptr) add_outputs(view, *tick.outputs, params);
  if (tick.record != nullptr) add_imu(view, tick.record->inputs, params);
  if (tick.state == nullptr) return;
  view.zmp_planned_world_m = sim::planned_zmp_world_m(tick.state->tuning, tick.state->gait, truth);
  view.footsteps = footsteps(tick.state->gait, truth.foot[0].sole_world, truth.foot[1].sole_world);
}

}  // namespace

RobotView look(const session::Tick& tick, const Entity& entity, const Params& params) {
  RobotView view;
  add_truth(view, tick.seen, entity);
  if (tick.world != nullptr) add_contacts(view, *tick.world, tick.owner);
  add_controller(view, tick, tick.seen.truth, params);
  return view;
}

Snapshot snapshot(const session::Tick& tick, const Entity& entity, const Params& params) {
  Snapshot now;
  now.t_s = tick.seen.truth.t_s;
  if (tick.record != nullptr) now.tick = tick.record->inputs.tick;
  now.robots.push_back(look(tick, entity, params));
  if (tick.world != nullptr && tick.world->scenery() != nullptr)
    now.body_world = tick.world->scenery()->moving_poses();
  return now;
}

}  // namespace verp::scene
