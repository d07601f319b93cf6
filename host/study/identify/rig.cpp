#include "host/study/identify/rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/safety/machine.hpp"
#include "firmware/app/schedule.hpp"
#include "host/trace/record/decisions.hpp"
#include "host/twin/sim/robot.hpp"

namespace verp::identify {
namespace {

constexpr double kGravity_m_s2 = 9.80665;
/// A stand gives way; a walking robot turns ten times as fast.
constexpr double kMostTurn_rad_s = 0.15;
/// Share of the weight; above the force sensors' error.
constexpr double kMostBorne = 0.15;

/// True if the servos have full torque and follow the controller's goals.
bool drives(const Outputs& outputs) {
  using safety::Mode;
  const auto mode = static_cast<Mode>(outputs.mode);
  return mode == Mode::kStanding || mode == Mode::kWalking || mode == Mode::kActing;
}

/// How the robot was held, by the other sensors.
class Surroundings {
 public:
  explicit Surroundings(const Params& params) : params_(params) {}

  void see(const Inputs& in) {
    if ((in.flags & kImuFresh) != 0) see_imu(in);
    if ((in.flags & kFeetFresh) != 0) {
      double counts = 0;
      for (const auto& foot : in.foot_count) {
        for (const std::uint16_t cell : foot) counts += cell;
      }
      borne_n_ += counts * static_cast<double>(params_.feet.newton_per_count);
      ++felt_;
    }
    if ((in.flags & kSlowFresh) != 0 && in.slow_voltage_tenth_v != 0) {
      volts_ += 0.1 * in.slow_voltage_tenth_v;
      ++told_;
    }
  }

  double supply_v() const { return told_ > 0 ? volts_ / told_ : 0; }
  Eigen::Vector3d up_body() const {
    return up_.norm() > 0 ? Eigen::Vector3d(up_.normalized()) : Eigen::Vector3d::UnitZ();
  }
  void require_a_stand(const std::filesystem::path& file) const {
    const char* remedy =
        "hang the robot by its trunk, feet in the air (`verp action play --held`), and record anew";
    const double turn_rad_s = turning();
    if (turn_rad_s > kMostTurn_rad_s) {
      throw record::TraceError(file,
                               fmt::format("its trunk turned with {:.0f} degrees/s (rms): that is "
                                           "no robot in a stand",
                                           turn_rad_s * 180 / std::numbers::pi),
                               remedy);
    }
    double weight_n = params_.body_mass_kg * kGravity_m_s2;
    for (int j = 0; j < params_.joint_count; ++j) {
      weight_n += params_.joint[j].mass_kg * kGravity_m_s2;
    }
    const double borne_n = felt_ > 0 ? borne_n_ / felt_ : 0;
    if (borne_n > kMostBorne * weight_n) {
      throw record::TraceError(
          file, fmt::format("its feet bore {:.0f} % of its weight", 100 * borne_n / weight_n),
          remedy);
    }
  }

 private:
  void see_imu(const Inputs& in) {
    const float* turn = params_.imu.body_imu;
    for (int row = 0; row < 3; ++row) {
      double g = 0;
      for (int column = 0; column < 3; ++column) {
        g += static_cast<double>(turn[3 * row + column]) * in.accel_count[column];
      }
      up_[row] += g;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double rate =
          in.gyro_count[axis] * static_cast<double>(params_.imu.gyro_rad_s_per_count);
      rate_[axis] += rate;
      squares_ += rate * rate;
    }
    ++turned_;
  }
  /// Spread about the mean, which is the gyro's bias.
  double turning() const {
    if (turned_ == 0) return 0;
    const double mean = (rate_ / turned_).squaredNorm();
    return std::sqrt(std::max(0.0, squares_ / turned_ - mean));
  }

  const Params& params_;
  Eigen::Vector3d up_ = Eigen::Vector3d::Zero(), rate_ = Eigen::Vector3d::Zero();
  double squares_ = 0, borne_n_ = 0, volts_ = 0;
  int turned_ = 0, felt_ = 0, told_ = 0;
};

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

Recording recording_of(const record::Trace& trace) {
  if (trace.ticks.empty()) {
    throw record::TraceError(trace.file, "holds no tick", "record a run that begins");
  }
  Recording recording;
  recording.params = trace.params;
  record::Decisions decisions(trace);
  Surroundings around(trace.params);
  std::uint32_t first = 0;
  for (const TickRecord& record : trace.ticks) {
    const Inputs& in = record.inputs;
    const Outputs* out = decisions.at(record);
    if (out == nullptr && recording.ticks.empty()) {
      throw record::TraceError(
          trace.file,
          fmt::format("at tick {} this program decides otherwise than the one that recorded it, so "
                      "nobody knows what the servos were told",
                      in.tick),
          "use the VERP that recorded it, or record anew");
    }
    if (out == nullptr || !drives(*out)) {
      if (!recording.ticks.empty()) break;
      continue;
    }
    if (recording.ticks.empty()) first = in.tick;
    Recording::Tick& tick = recording.ticks.emplace_back();
    tick.slot = in.tick - first;
    tick.fresh = in.fresh;
    tick.goal.assign(out->goal_count, out->goal_count + trace.params.joint_count);
    tick.position.assign(in.position_count, in.position_count + trace.params.joint_count);
    around.see(in);
  }
  if (recording.ticks.empty()) {
    throw record::TraceError(trace.file, "the robot never stood with all of its strength",
                             "let it stand up first, and move then");
  }
  around.require_a_stand(trace.file);
  recording.supply_v = around.supply_v();
  recording.up_body = around.up_body();
  return recording;
}

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
