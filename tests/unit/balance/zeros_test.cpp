#include "common/balance/zeros.hpp"

#include <gtest/gtest.h>

#include "common/model/counts.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::balance {
namespace {

using test::kRobot;

constexpr float kBent_rad[kLegJoints] = {0, 0.02F, -0.63F, 1.26F, -0.63F, -0.02F};
constexpr float kHalfDegree_rad = 0.0087F;

// A flat sole under a tilted body, read through encoders with offsets.
struct Stand {
  explicit Stand(int foot_side, test::Random& random) : side(foot_side) {
    body.roll_rad = random.between(-0.03F, 0.03F);
    body.pitch_rad = random.between(-0.03F, 0.03F);
    for (float& zero_rad : error_rad) zero_rad = random.between(-kHalfDegree_rad, kHalfDegree_rad);
    for (int k = 0; k < kLegJoints; ++k) planned_rad[k] = kBent_rad[k];
    planned_rad[1] += random.between(-0.1F, 0.1F);
    planned_rad[5] = -planned_rad[1];
    chain = kinematics::leg_chain(kRobot, leg(), Pose{}, planned_rad);
    inputs.fresh = 0xFFFFFFFFU;
    // The ankle is off its plan by the tilt.
    for (int k = 0; k < kLegJoints; ++k) true_rad[k] = planned_rad[k];
    true_rad[4] -= body.pitch_rad;
    true_rad[5] -= body.roll_rad;
    for (int k = 0; k < kLegJoints; ++k) {
      inputs.position_count[leg().joint[k]] =
          model::count_of(kRobot.joint[leg().joint[k]], true_rad[k] + error_rad[k]);
    }
  }
  const LegParams& leg() const { return kRobot.leg[side]; }
  float roll_error_rad() const { return error_rad[1] + error_rad[5]; }
  float pitch_error_rad() const { return error_rad[2] + error_rad[3] + error_rad[4]; }
  void learn(float seconds) {
    for (float t_s = 0; t_s < seconds; t_s += 0.01F) {
      learn_zero(kRobot, leg(), chain, planned_rad, {}, inputs, body, 0, zero);
    }
  }

  int side;
  AttitudeOut body;
  float error_rad[kLegJoints] = {};
  float planned_rad[kLegJoints] = {};
  float true_rad[kLegJoints] = {};
  kinematics::LegChain chain;
  Inputs inputs;
  LegZero zero;
};

// An encoder step is 1.5 mrad; the ankle's pitch tilts a roll axis against the sole's.
constexpr float kNear_rad = 3e-3F;

TEST(Zeros, SumsOfALegsZeroErrorsAreFound) {
  test::Random random(1);
  for (int round = 0; round < 40; ++round) {
    Stand stand(round % 2, random);
    stand.learn(6);
    EXPECT_NEAR(stand.zero.roll_rad, stand.roll_error_rad(), kNear_rad) << "round " << round;
    EXPECT_NEAR(stand.zero.pitch_rad, stand.pitch_error_rad(), kNear_rad) << "round " << round;
  }
}

TEST(Zeros, GoalsWithWhatWasLearntSetTheSoleDownLevel) {
  test::Random random(2);
  for (int round = 0; round < 40; ++round) {
    Stand stand(round % 2, random);
    stand.learn(6);
    float goal_rad[kLegJoints];
    for (int k = 0; k < kLegJoints; ++k) goal_rad[k] = stand.planned_rad[k];
    add_zero(stand.leg(), stand.zero, goal_rad);
    for (int k = 0; k < kLegJoints; ++k) goal_rad[k] -= stand.error_rad[k];
    const kinematics::LegChain reached =
        kinematics::leg_chain(kRobot, stand.leg(), Pose{}, goal_rad);
    const Vec3 up = kinematics::sole_pose(stand.leg(), reached).rotation.col(2);
    EXPECT_NEAR(up.x(), 0.0F, kNear_rad) << "round " << round;
    EXPECT_NEAR(up.y(), 0.0F, kNear_rad) << "round " << round;
  }
}

TEST(Zeros, AJointThatHasNotReportedTeachesNothing) {
  test::Random random(3);
  Stand stand(0, random);
  stand.inputs.fresh &= ~(1U << stand.leg().joint[2]);
  stand.learn(6);
  EXPECT_EQ(stand.zero.roll_rad, 0.0F);
  EXPECT_EQ(stand.zero.pitch_rad, 0.0F);
}

// A horn mounted one tooth off is no zero error.
TEST(Zeros, WhatIsLearntStaysSmall) {
  test::Random random(4);
  Stand stand(0, random);
  stand.inputs.position_count[stand.leg().joint[5]] += 500;
  stand.learn(60);
  EXPECT_LE(math::abs(stand.zero.roll_rad), 0.051F);
  EXPECT_GT(math::abs(stand.zero.roll_rad), 0.04F) << "it has tried";
}

TEST(Zeros, ASoleStandsFlatOnlyWithThePressureInItsMiddle) {
  const auto flat = [](std::uint16_t front_left, std::uint16_t front_right, std::uint16_t back_left,
                       std::uint16_t back_right) {
    const std::uint16_t count[kFootSensors] = {front_left, front_right, back_left, back_right};
    return stands_flat(count);
  };
  EXPECT_TRUE(flat(100, 100, 100, 100));
  EXPECT_TRUE(flat(140, 140, 60, 60));
  EXPECT_FALSE(flat(0, 0, 0, 0)) << "in the air, or without sensors";
  EXPECT_FALSE(flat(160, 160, 40, 40)) << "on its toes";
  EXPECT_FALSE(flat(40, 40, 160, 160)) << "on its heel";
  EXPECT_FALSE(flat(160, 40, 160, 40)) << "on its left edge";
  EXPECT_FALSE(flat(40, 160, 40, 160)) << "on its right edge";
  EXPECT_TRUE(flat(65535, 65535, 65535, 65535));
}

}  // namespace
}  // namespace verp::balance
