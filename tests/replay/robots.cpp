#include "tests/replay/robots.hpp"

#include <utility>

namespace verp::replay {
namespace {

Params newton(Params params) {
  for (LegParams& leg : params.leg) leg.solver = LegSolver::kNewton;
  return params;
}

/// Every axis reversed, every third one as a general axis, the right leg solved by Newton.
Params mirrored(Params params) {
  constexpr AxisKind kReverse[] = {AxisKind::kMinusX, AxisKind::kMinusY, AxisKind::kMinusZ,
                                   AxisKind::kX,      AxisKind::kY,      AxisKind::kZ,
                                   AxisKind::kGeneral};
  for (int j = 0; j < params.joint_count; ++j) {
    JointParams& joint = params.joint[j];
    joint.axis_kind = j % 3 == 2 ? AxisKind::kGeneral : kReverse[static_cast<int>(joint.axis_kind)];
    joint.axis = {-joint.axis.x, -joint.axis.y, -joint.axis.z};
    std::swap(joint.lower_rad, joint.upper_rad);
    joint.lower_rad = -joint.lower_rad;
    joint.upper_rad = -joint.upper_rad;
    joint.stand_rad = -joint.stand_rad;
    joint.sit_rad = -joint.sit_rad;
    joint.counts_per_rad = -joint.counts_per_rad;
  }
  for (LegParams& leg : params.leg) {
    for (float& direction : leg.direction) direction = -direction;
  }
  params.leg[1].solver = LegSolver::kNewton;
  return params;
}

/// `of_first` and `of_second` turn `first` and `second`, which have no servos, the other way. Those
/// are last in the list.
Params coupled(const Params& robot, int first, int of_first, int second, int of_second) {
  Params params = robot;
  const int count = robot.joint_count;
  const auto place = [=](int joint) {
    if (joint == first) return count - 2;
    if (joint == second) return count - 1;
    return joint - (joint > first ? 1 : 0) - (joint > second ? 1 : 0);
  };
  for (int j = 0; j < count; ++j) {
    JointParams& joint = params.joint[place(j)];
    joint = robot.joint[j];
    const int parent = robot.joint[j].parent;
    joint.parent = static_cast<std::uint8_t>(parent == 0 ? 0 : place(parent - 1) + 1);
  }
  for (int leg = 0; leg < kFeet; ++leg) {
    for (int k = 0; k < kLegJoints; ++k) {
      params.leg[leg].joint[k] = static_cast<std::uint8_t>(place(robot.leg[leg].joint[k]));
    }
  }
  for (std::uint8_t* const head : {&params.head_pan, &params.head_tilt}) {
    if (*head != 0xFF) *head = static_cast<std::uint8_t>(place(*head));
  }
  for (const auto& [joint, driver] : {std::pair{first, of_first}, std::pair{second, of_second}}) {
    JointParams& follower = params.joint[place(joint)];
    follower.servo_id = robot.joint[driver].servo_id;
    follower.counts_per_rad = -robot.joint[driver].counts_per_rad;
    follower.zero_count = robot.joint[driver].zero_count;
  }
  params.followers = 2;
  return params;
}

/// One motor for both hip yaws, one for two arm joints.
Params coupled_hips(const Params& robot) {
  const int left = robot.leg[0].joint[0], right = robot.leg[1].joint[0];
  int arm = 0;  // carries something; not head, legs or trunk
  while (robot.joint[arm].parent != 0 || arm == left || arm == right || arm == robot.head_pan)
    ++arm;
  return coupled(robot, right, left, arm, arm + 1);
}

/// Periods longer than the time between key points; feet so heavy that their swing nearly lifts the
/// robot; thighs too long to fold; no head, no force cells.
Params slow_and_heavy(Params params) {
  params.period_us = 20'000;
  params.head_pan = params.head_tilt = 0xFF;
  for (auto& device_id : params.feet.device_id) device_id = 0;
  params.tuning.safety.unloaded_s = 3600;  // the plant's knees feel no load
  for (LegParams& leg : params.leg) {
    leg.thigh_m *= 2.0F;
    for (int k = 3; k < kLegJoints; ++k) params.joint[leg.joint[k]].mass_kg *= 20.0F;
  }
  return params;
}

/// Joints off their parents' axes, and soles half a turn out of reach: Newton never converges.
Params fast_and_twisted(Params params) {
  params = newton(params);
  params.period_us = 4'000;
  for (JointParams& joint : params.joint) joint.origin_parent_m.x += 0.002F;
  constexpr float kHalfTurnAboutZ[9] = {-1, 0, 0, 0, -1, 0, 0, 0, 1};
  constexpr float kHalfTurnAboutX[9] = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  for (int i = 0; i < 9; ++i) {
    params.leg[0].sole_foot[i] = kHalfTurnAboutZ[i];
    params.leg[1].sole_foot[i] = kHalfTurnAboutX[i];
  }
  return params;
}

/// Five joints, no legs, no mass, a servo that reports nothing, swapped limits, arms and steps
/// without bound.
Params limbless(Params params) {
  params.joint_count = 5;
  params.body_mass_kg = 0;
  params.head_pan = params.head_tilt = 0xFF;
  params.joint[1].counts_per_rad = 0;
  params.joint[0].lower_rad = 1;
  params.joint[0].upper_rad = -1;
  for (const int j : {3, 4}) {
    JointParams& joint = params.joint[j];
    joint.lower_rad = -1000;
    joint.upper_rad = joint.velocity_limit_rad_s = 1000;
    joint.stand_rad = joint.sit_rad = j == 3 ? 500.0F : -500.0F;
  }
  params.tuning.gait.max_turn_rad = 100;
  params.tuning.gait.heading_gain = 20;
  for (JointParams& joint : params.joint) joint.mass_kg = 0;
  for (LegParams& leg : params.leg) {
    leg = LegParams{};
    leg.sole_front_m = leg.sole_back_m = leg.sole_left_m = leg.sole_right_m = 0.02F;
  }
  return params;
}

/// No leg has an ankle roll, the left one no hip yaw; the right hip yaw follows what was the left
/// one.
Params few_joints(const Params& robot) {
  Params params = newton(coupled_hips(robot));
  for (LegParams& leg : params.leg) leg.joint[kLegJoints - 1] = kNoJoint;
  LegParams& left = params.leg[0];
  const JointParams& yaw = params.joint[left.joint[0]];
  JointParams& roll = params.joint[left.joint[1]];
  roll.parent = yaw.parent;
  roll.origin_parent_m.x += yaw.origin_parent_m.x;
  roll.origin_parent_m.y += yaw.origin_parent_m.y;
  roll.origin_parent_m.z += yaw.origin_parent_m.z;
  left.joint[0] = kNoJoint;
  return params;
}

/// Four times as large, with masses as they are: its body is high enough for the estimator to
/// believe the legs less.
Params tall(Params params) {
  constexpr float kTimes = 4.0F;
  const auto grow = [](Xyz& place_m) {
    place_m = {kTimes * place_m.x, kTimes * place_m.y, kTimes * place_m.z};
  };
  grow(params.body_com_m);
  for (JointParams& joint : params.joint) {
    grow(joint.origin_parent_m);
    grow(joint.com_link_m);
  }
  for (LegParams& leg : params.leg) {
    grow(leg.hip_body_m);
    grow(leg.sole_foot_m);
    for (float* const length_m : {&leg.thigh_m, &leg.shank_m, &leg.sole_front_m, &leg.sole_back_m,
                                  &leg.sole_left_m, &leg.sole_right_m})
      *length_m *= kTimes;
  }
  GaitTuning& gait = params.tuning.gait;
  for (float* const length_m : {&gait.hip_height_m, &gait.half_stance_m, &gait.lift_m})
    *length_m *= kTimes;
  return params;
}

}  // namespace

std::vector<Robot> make_robots(const Params& robot) {
  return {{"closed_form", 20, 11, false, robot},
          {"newton", 15, 22, false, newton(robot)},
          {"mirrored", 20, 33, false, coupled_hips(mirrored(robot))},
          {"slow_heavy", 10, 44, false, slow_and_heavy(robot)},
          {"fast_twisted", 15, 55, false, fast_and_twisted(robot)},
          {"few_joints", 5, 88, false, few_joints(robot)},
          {"tall", 5, 99, false, tall(robot)},
          {"limbless", 5, 66, false, limbless(robot)},
          {"damaged", 5, 77, true, robot}};
}

}  // namespace verp::replay
