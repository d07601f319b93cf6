#include "common/model/leg.hpp"

#include <gtest/gtest.h>

#include "common/model/image.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::model {
namespace {

Params params;  // too large for a microcontroller's stack

LegParams& without(int slot) {
  params = test::kRobot;
  params.leg[0].solver = LegSolver::kNewton;
  params.leg[0].joint[slot] = kNoJoint;
  return params.leg[0];
}

TEST(LegSlots, AnEmptySlotIsZeroAndNothingIsWrittenForIt) {
  const LegParams& leg = without(5);
  float joint_rad[kMaxJoints], leg_rad[kLegJoints];
  for (int j = 0; j < kMaxJoints; ++j) joint_rad[j] = static_cast<float>(j);
  read_leg(leg, joint_rad, leg_rad);
  for (int k = 0; k < 5; ++k) EXPECT_EQ(leg_rad[k], joint_rad[test::kLeftLeg + k]);
  EXPECT_EQ(leg_rad[5], 0.0F);
  for (float& angle : leg_rad) angle = 99;
  write_leg(leg, leg_rad, joint_rad);
  for (int j = 0; j < kMaxJoints; ++j) {
    const bool of_leg = j >= test::kLeftLeg && j < test::kLeftLeg + 5;
    EXPECT_EQ(joint_rad[j], of_leg ? 99.0F : static_cast<float>(j));
  }
  EXPECT_EQ(joints_of(leg), 31U << test::kLeftLeg);
  EXPECT_EQ(int{last_joint(leg)}, test::kLeftLeg + 4);
}

TEST(LegSlots, AnEmptySlotIsNeverStale) {
  const LegParams& leg = without(0);
  static Inputs inputs;
  inputs.fresh = joints_of(leg);
  float leg_rad[kLegJoints];
  EXPECT_TRUE(measure_leg(params, leg, inputs, leg_rad));
  EXPECT_EQ(leg_rad[0], 0.0F);
  inputs.fresh &= inputs.fresh - 1;
  EXPECT_FALSE(measure_leg(params, leg, inputs, leg_rad));
}

TEST(LegSlots, OnlyHipYawAndAnkleRollMayBeEmpty) {
  for (int slot = 0; slot < kLegJoints; ++slot) {
    const bool may = slot == 0 || slot == kLegJoints - 1;
    LegParams& leg = without(slot);
    EXPECT_EQ(is_well_formed(params), may) << "slot " << slot;
    leg.solver = LegSolver::kClosedForm;
    EXPECT_FALSE(is_well_formed(params)) << "slot " << slot;
    leg.solver = LegSolver::kNewton;
    leg.joint[slot] = params.joint_count;
    EXPECT_FALSE(is_well_formed(params)) << "slot " << slot;
  }
}

}  // namespace
}  // namespace verp::model
