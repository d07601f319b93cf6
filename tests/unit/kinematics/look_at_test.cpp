#include "common/kinematics/look_at.hpp"

#include <gtest/gtest.h>

#include "common/kinematics/forward.hpp"
#include "common/math/scalar.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::kinematics {
namespace {

void expect_head_looks_at_points(const Params& params) {
  test::Random random(7);
  for (int round = 0; round < 300; ++round) {
    const Vec3 point_m{random.between(-3, 3), random.between(-3, 3), random.between(-1, 1)};
    const HeadAngles angles = look_at(params, point_m);
    float angle_rad[kMaxJoints] = {};
    angle_rad[params.head_pan] = angles.pan_rad;
    angle_rad[params.head_tilt] = angles.tilt_rad;
    const Pose head = node_pose(params, Pose{}, angle_rad, params.head_tilt + 1);
    const Vec3 seen_m = head.rotation.transpose() * (point_m - head.position_m);
    const float far_m = math::norm(seen_m);
    if (far_m < 0.4F) continue;  // inside the head
    EXPECT_NEAR(seen_m.x(), far_m, 1e-4F * far_m) << round;
    EXPECT_NEAR(seen_m.y(), 0, 1e-4F * far_m) << round;
    EXPECT_NEAR(seen_m.z(), 0, 1e-4F * far_m) << round;
  }
}

TEST(LookAt, TurnsTheHeadsXAxisToThePoint) {
  expect_head_looks_at_points(test::kRobot);
}

TEST(LookAt, TurnsAHeadOnATorsoAndALongNeck) {
  static Params params;
  params = test::kRobot;
  constexpr AxisKind kAxes[] = {AxisKind::kX, AxisKind::kZ, AxisKind::kX, AxisKind::kY};
  for (int j = 0; j < 4; ++j) {
    const float m = 0.01F * static_cast<float>(j + 1);
    params.joint[j].parent = static_cast<std::uint8_t>(j);
    params.joint[j].axis_kind = kAxes[j];
    params.joint[j].origin_parent_m = {m, j < 2 ? -0.5F * m : 0.0F, 3 * m};
  }
  params.head_pan = 1;
  params.head_tilt = 3;
  expect_head_looks_at_points(params);
}

TEST(LookAt, MirrorsWithThePoint) {
  const HeadAngles left = look_at(test::kRobot, Vec3{1, 0.4F, 0.2F});
  const HeadAngles right = look_at(test::kRobot, Vec3{1, -0.4F, 0.2F});
  EXPECT_EQ(left.pan_rad, -right.pan_rad);
  EXPECT_EQ(left.tilt_rad, right.tilt_rad);
  EXPECT_GT(left.pan_rad, 0.0F);
}

TEST(LookAt, AMissingJointsAngleIsZero) {
  Params fixed = test::kRobot;
  fixed.head_pan = fixed.head_tilt = 0xFF;
  const HeadAngles none = look_at(fixed, Vec3{1, 1, 1});
  EXPECT_EQ(none.pan_rad, 0.0F);
  EXPECT_EQ(none.tilt_rad, 0.0F);
  fixed.head_pan = test::kRobot.head_pan;
  EXPECT_NEAR(look_at(fixed, Vec3{1, 1, 1}).pan_rad, 0.25F * math::kPi, 1e-6F);
  EXPECT_EQ(look_at(fixed, Vec3{1, 1, 1}).tilt_rad, 0.0F);
}

TEST(LookAt, IsTotal) {
  const float bad[] = {math::kMaxFloat, -math::kMaxFloat, 0, 1e30F};
  for (const float x : bad) {
    for (const float z : bad) {
      const HeadAngles angles = look_at(test::kRobot, Vec3{x, -x, z});
      EXPECT_LE(math::abs(angles.pan_rad), math::kPi);
      EXPECT_LE(math::abs(angles.tilt_rad), math::kPi);
    }
  }
}

}  // namespace
}  // namespace verp::kinematics
