#include "host/show/scene/plan_marks.hpp"

#include <cmath>

#include "host/trace/record/ros_messages.hpp"

namespace verp::scene {
namespace {

std::array<double, 3> turned(const float (&rotation)[9], const std::int16_t (&count)[3],
                             double per_count) {
  std::array<double, 3> out{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      out[row] += static_cast<double>(rotation[3 * row + column]) * count[column] * per_count;
    }
  }
  return out;
}

/// Walk frame to world, by a foothold known in both.
struct Placed {
  Vec2 from_m, to_m;
  double turn_rad;

  Footstep operator()(int side, const gait::Foothold& foot) const {
    const Vec2 at(static_cast<double>(foot.at_m.x), static_cast<double>(foot.at_m.y));
    const Vec2 world = to_m + Eigen::Rotation2Dd(turn_rad) * (at - from_m);
    return {side, world, static_cast<double>(foot.yaw_rad) + turn_rad};
  }
};

}  // namespace

void add_outputs(RobotView& view, const Outputs& outputs, const Params& params) {
  view.goal_rad.clear();
  for (std::size_t j = 0; j < params.joint_count; ++j) {
    view.goal_rad.push_back(record::ros::joint_rad(params.joint[j], outputs.goal_count[j]));
  }
  view.faults = outputs.faults;
  view.mode = outputs.mode;
  view.phase = outputs.gait_phase;
  view.gait_state = outputs.gait_state;
  view.stance = outputs.stance;
}

void add_imu(RobotView& view, const Inputs& inputs, const Params& params) {
  const ImuParams& imu = params.imu;
  view.gyro_rad_s =
      turned(imu.body_imu, inputs.gyro_count, static_cast<double>(imu.gyro_rad_s_per_count));
  view.accel_m_s2 =
      turned(imu.body_imu, inputs.accel_count, static_cast<double>(imu.accel_m_s2_per_count));
}

std::vector<Footstep> footsteps(const gait::GaitState& gait, const Transform& left_sole_world,
                                const Transform& right_sole_world) {
  std::vector<Footstep> steps;
  if (gait.queued == 0) return steps;
  const gait::Step& now = gait.queue[0];
  const int carrying = now.carrying() == gait::kBoth ? gait::kLeft : now.carrying();
  const Transform& sole = carrying == gait::kLeft ? left_sole_world : right_sole_world;
  const gait::Foothold& known = now.foot[carrying];
  const Vec3 ahead = sole.linear().col(0);
  const Placed place{Vec2(static_cast<double>(known.at_m.x), static_cast<double>(known.at_m.y)),
                     sole.translation().head<2>(),
                     std::atan2(ahead.y(), ahead.x()) - static_cast<double>(known.yaw_rad)};
  for (int i = 0; i < gait.queued && i < gait::kQueue; ++i) {
    const gait::Step& step = gait.queue[i];
    if (step.swing != gait::kBoth) steps.push_back(place(step.swing, step.landing));
  }
  return steps;
}

}  // namespace verp::scene
