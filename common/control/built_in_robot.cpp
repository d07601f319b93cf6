#include "common/control/built_in_robot.hpp"

namespace verp::control {
namespace {

// Hip yaw, roll, pitch; knee; ankle pitch, roll.
constexpr float kLink_m = 0.093F, kHipSide_m = 0.037F, kHipDown_m = 0.085F, kSole_m = 0.0335F;
constexpr AxisKind kAxis[kLegJoints] = {AxisKind::kZ, AxisKind::kX, AxisKind::kY,
                                        AxisKind::kY, AxisKind::kY, AxisKind::kX};
constexpr float kMass_kg[kLegJoints] = {0.03F, 0.18F, 0.12F, 0.06F, 0.18F, 0.08F};
constexpr float kStand_rad[kLegJoints] = {0, 0, -0.628F, 1.256F, -0.628F, 0};
constexpr float kSit_rad[kLegJoints] = {0, 0, -1.1F, 2.2F, -1.1F, 0};

void make_leg(int foot, Params& params) {
  const float side = foot == 0 ? 1.0F : -1.0F;
  LegParams& leg = params.leg[foot];
  leg.solver = LegSolver::kClosedForm;
  leg.hip_body_m = {0, side * kHipSide_m, -kHipDown_m};
  leg.thigh_m = leg.shank_m = kLink_m;
  leg.sole_foot_m = {0, 0, -kSole_m};
  leg.sole_front_m = leg.sole_back_m = 0.052F;
  leg.sole_left_m = leg.sole_right_m = 0.033F;
  for (int k = 0; k < kLegJoints; ++k) {
    const int j = foot * kLegJoints + k;
    leg.joint[k] = static_cast<std::uint8_t>(j);
    leg.direction[k] = 1;
    JointParams& joint = params.joint[j];
    joint.parent = static_cast<std::uint8_t>(k == 0 ? 0 : j);
    joint.axis_kind = kAxis[k];
    joint.axis = {kAxis[k] == AxisKind::kX ? 1.0F : 0.0F, kAxis[k] == AxisKind::kY ? 1.0F : 0.0F,
                  kAxis[k] == AxisKind::kZ ? 1.0F : 0.0F};
    joint.servo_id = static_cast<std::uint8_t>(j + 1);
    if (k == 0) joint.origin_parent_m = leg.hip_body_m;
    if (k == 3 || k == 4) joint.origin_parent_m = {0, 0, -kLink_m};
    joint.mass_kg = kMass_kg[k];
    joint.com_link_m = {0.001F * static_cast<float>(k), 0, -0.01F * static_cast<float>(k)};
    joint.lower_rad = kStand_rad[k] - 1.7F;
    joint.upper_rad = kStand_rad[k] + 1.7F;
    joint.velocity_limit_rad_s = 8.0F;
    joint.counts_per_rad = k % 2 == 0 ? 651.9F : -651.9F;
    joint.zero_count = 2048;
    joint.compliance_rad_nm = 0.026F;
    joint.armature_kg_m2 = 0.0064F;
    joint.friction_n_m = 0.035F;
    joint.load_friction = 0.233F;
    joint.friction_speed_rad_s = 1.57F;
    joint.stand_rad = kStand_rad[k];
    joint.sit_rad = kSit_rad[k];
  }
}

}  // namespace

void make_built_in_robot(Params& params) {
  params = Params{};
  params.joint_count = kFeet * kLegJoints;
  params.body_mass_kg = 1.8F;
  params.body_com_m = {0, 0, 0.01F};
  for (int foot = 0; foot < kFeet; ++foot) make_leg(foot, params);
  params.imu.gyro_rad_s_per_count = 0.00106F;
  params.imu.accel_m_s2_per_count = 0.0012F;
  params.imu.device_id = 120;
  params.feet.newton_per_count = 0.01F;
}

}  // namespace verp::control
