#include "host/apps/libverp/core_plan.hpp"

#include <algorithm>

#include "common/gait/gait.hpp"

namespace verp::abi {
namespace {

verp_plan planned(const Params& params, const gait::GaitOut& out, float* leg_rad) {
  verp_plan to = {};
  put_pose(out.posture.body, to.body);
  for (int side = 0; side < kFeet; ++side) {
    const Pose sole = gait::sole_in_body(out.posture, side);
    float* const angle_rad = leg_rad + side * kLegJoints;
    const auto solved = kinematics::solve_leg(params, params.leg[side], sole, angle_rad);
    std::copy_n(solved.angle_rad, kLegJoints, angle_rad);
    put_pose(sole, to.sole[side]);
    to.flags |= solved.flags;
    to.carry[side] = out.carry[side];
  }
  std::copy_n(leg_rad, kFeet * kLegJoints, to.leg_rad);
  to.zmp_m[0] = out.zmp_m.x;
  to.zmp_m[1] = out.zmp_m.y;
  to.phase = static_cast<std::uint8_t>(out.phase);
  to.state = out.cycle_state;
  to.swing = out.swing;
  return to;
}

}  // namespace

void put_pose(const Pose& pose, float* to) {
  for (int i = 0; i < 9; ++i) to[i] = pose.rotation(i / 3, i % 3);
  std::copy_n(pose.position_m.data(), 3, to + 9);
}

void plan_walk(const Params& params, const Command& velocity, verp_plan* plan, std::uint32_t count,
               std::uint32_t stop) {
  gait::GaitState state;
  float goal_rad[kMaxJoints] = {}, leg_rad[kFeet * kLegJoints];
  for (int j = 0; j < params.joint_count; ++j) goal_rad[j] = params.joint[j].stand_rad;
  gait::stand_legs(params, state.preview.leg_rad);
  std::copy_n(state.preview.leg_rad, kFeet * kLegJoints, leg_rad);
  gait::GaitIn in;
  in.goal_rad = goal_rad;
  in.period_us = static_cast<std::int32_t>(params.period_us);
  in.wanted.vx_m_s = 1e-4F * static_cast<float>(velocity.vx_tenth_mm_s);
  in.wanted.vy_m_s = 1e-4F * static_cast<float>(velocity.vy_tenth_mm_s);
  in.wanted.wz_rad_s = 1e-3F * static_cast<float>(velocity.wz_mrad_s);
  for (std::uint32_t n = 0; n < count; ++n) {
    in.walk = n + stop < count;
    plan[n] = planned(params, gait::update(params, params.tuning, state, in), leg_rad);
  }
}

}  // namespace verp::abi
