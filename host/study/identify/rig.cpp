#include "host/study/identify/rig.hpp"

#include <algorithm>

#include "firmware/app/schedule.hpp"
#include "host/twin/sim/robot.hpp"

namespace verp::identify {
namespace {

sim::TwinOptions twin_options(const Recording& recording, const RigOptions& options,
                              const model::Entity& entity) {
  sim::TwinOptions twin;
  twin.seed = options.seed;
  twin.imperfections = sim::Imperfections::none();
  twin.imperfections.encoder = true;  // noise frees the gears from static friction
  twin.cradle = sim::Cradle::kNone;
  twin.supply_v = options.supply_v;
  const Recording::Tick& first = recording.ticks.front();
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    twin.initial_rad.push_back(sim::angle_of(entity.joints[j].servo, first.position[j]));
  }
  return twin;
}

/// The settings that the controller writes into a servo when it arms it.
sim::ServoSetpoint armed(const Params& params, int joint, std::int32_t goal) {
  const ServoProfile& profile = params.servo[params.joint[joint].servo_profile % kServoProfiles];
  sim::ServoSetpoint setpoint;
  setpoint.torque_on = true;
  setpoint.goal_count = goal;
  setpoint.p_gain = profile.position_p_gain;
  setpoint.i_gain = profile.position_i_gain;
  setpoint.d_gain = profile.position_d_gain;
  setpoint.profile_ms = profile.profile_ms;
  return setpoint;
}

model::Entity bare(model::Entity entity) {
  for (model::Node& node : entity.nodes) {
    node.collisions.clear();
    node.visuals.clear();
  }
  entity.lasers.clear();
  entity.cameras.clear();
  entity.force_torques.clear();
  entity.contacts.clear();
  entity.truths.clear();
  return entity;
}

/// Hangs the limbs from the world instead of the trunk: ODE then solves each limb alone, several
/// times faster. (ODE takes the angle as given only if the trunk is not rotated.)
void hang_from_world(const sim::Body& body) {
  const dBodyID trunk = body.ode_body(0);
  std::vector<dJointID> hinges;
  for (int i = 0; i < dBodyGetNumJoints(trunk); ++i) hinges.push_back(dBodyGetJoint(trunk, i));
  for (const dJointID hinge : hinges) {
    dVector3 anchor, axis;
    dJointGetHingeAnchor(hinge, anchor);
    dJointGetHingeAxis(hinge, axis);
    const double angle_rad = dJointGetHingeAngle(hinge);
    dJointAttach(hinge, dJointGetBody(hinge, 0), nullptr);
    dJointSetHingeAnchor(hinge, anchor[0], anchor[1], anchor[2]);
    dJointSetHingeAxisOffset(hinge, axis[0], axis[1], axis[2], angle_rad);
  }
  dBodySetKinematic(trunk);
}

}  // namespace

TickTimes times_of(const Params& params) {
  using namespace app;
  const std::size_t n = params.servo_count();
  const std::size_t positions =
      all_fast(params) ? fast_sync_read_bytes(n, 4) : sync_read_bytes(n, 4);
  const std::size_t before = positions +
                             sync_read_bytes(sensor_devices(params), dxl::sensor_block::kBytes) +
                             sync_write_bytes(1, 2) + sync_write_bytes(n, 4);
  return {wire_us(dxl::kInstructionBytes + 4 + n, params.baud), wire_us(before, params.baud)};
}

Simulated simulate(const model::Entity& with_shapes, const Recording& recording,
                   const RigOptions& options) {
  const model::Entity entity = bare(with_shapes);
  const std::size_t joints = entity.joints.size();
  const std::size_t ticks = std::min(options.ticks, recording.ticks.size());
  sim::WorldOptions air;
  air.ground = false;
  air.up = recording.up_body;
  air.step_us = kStep_us;
  sim::World world(air);
  const sim::TwinOptions twin = twin_options(recording, options, entity);
  sim::TwinRobot robot(world, entity, twin);
  robot.body().place(sim::Transform::Identity(), twin.initial_rad);
  hang_from_world(robot.body());
  for (std::size_t j = 0; j < joints; ++j) {
    const int joint = static_cast<int>(j);
    if (entity.joints[j].follows >= 0) continue;
    robot.setpoint(joint) = armed(recording.params, joint, recording.ticks.front().goal[j]);
  }
  Simulated out;
  out.count.assign(joints, std::vector<float>(ticks));
  const TickTimes times = times_of(recording.params);
  const auto goal_us = static_cast<std::uint64_t>(std::max<std::int64_t>(
      0, std::int64_t{times.goal_us} + options.delay_steps * std::int64_t{kStep_us}));
  // `told` is behind the tick being read: a tick's goals arrive while later ticks are read.
  std::size_t told = 0;
  double volts = 0;
  const auto tell_until = [&](std::uint64_t time_us) {
    for (; told < ticks; ++told) {
      const std::uint64_t at_us =
          std::uint64_t{recording.ticks[told].slot} * recording.params.period_us + goal_us;
      if (at_us > time_us) return;
      world.advance_to(at_us);
      for (std::size_t j = 0; j < joints; ++j) {
        if (entity.joints[j].follows >= 0) continue;
        robot.setpoint(static_cast<int>(j)).goal_count = recording.ticks[told].goal[j];
      }
    }
  };
  for (std::size_t i = 0; i < ticks; ++i) {
    const std::uint64_t read_us =
        std::uint64_t{recording.ticks[i].slot} * recording.params.period_us + times.read_us;
    tell_until(read_us);
    world.advance_to(read_us);
    volts += robot.supply_v();
    for (std::size_t j = 0; j < joints; ++j) {
      const int joint = static_cast<int>(j);
      const model::Servo& servo = entity.joints[j].servo;
      // The register holds the last round's angle.
      const double age_s = servo.loop_s + servo.loop_delay_s;
      const double rad = robot.body().angle_rad(joint) - robot.body().rate_rad_s(joint) * age_s;
      out.count[j][i] = static_cast<float>(sim::count_of(servo, rad));
    }
  }
  out.supply_v = volts / static_cast<double>(ticks);
  return out;
}

}  // namespace verp::identify
