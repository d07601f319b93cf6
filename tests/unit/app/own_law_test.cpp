#include "firmware/law/own_law.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/support/test_robot.hpp"

namespace verp::app {
namespace {

struct Given {
  static inline float goal_rad = 0;
  static inline bool torque = false;
  void operator()(const Params& params, State&, const Inputs&, Outputs& outputs) {
    outputs.torque_enable = torque ? 1 : 0;
    outputs.goal_count[0] = goal_of(params.joint[0], goal_rad);
  }
};

struct Rig {
  Rig() { Given::goal_rad = 0, Given::torque = false; }
  void tick(float goal_rad, bool torque) {
    Given::goal_rad = goal_rad;
    Given::torque = torque;
    law(params, state, inputs, outputs);
  }
  float goal_rad() const { return model::angle_of(params.joint[0], outputs.goal_count[0]); }

  const Params& params = test::kRobot;
  State state;
  Inputs inputs;
  Outputs outputs;
  OwnLaw<Given> law;
};

const float kNoNumber = std::numeric_limits<float>::quiet_NaN();

TEST(OwnLaw, SendsWhatIsWithinAJointsRange) {
  Rig rig;
  rig.tick(0.2F, true);
  EXPECT_EQ(rig.law.refused(), OwnLaw<Given>::kNone);
  EXPECT_NEAR(rig.goal_rad(), 0.2F, 2e-3F);
}

TEST(OwnLaw, KeepsTheGoalBeforeOneThatIsNoneOrOutOfRange) {
  Rig rig;
  rig.tick(0.2F, true);
  for (const float goal_rad : {kNoNumber, rig.params.joint[0].upper_rad + 0.5F, -50.0F}) {
    rig.tick(goal_rad, true);
    EXPECT_EQ(rig.law.refused(), 0);
    EXPECT_EQ(rig.outputs.torque_enable, 1U);
    EXPECT_NEAR(rig.goal_rad(), 0.2F, 2e-3F);
  }
}

// With torque, the joint would snap to its last goal.
TEST(OwnLaw, LeavesALimpJointLimpWhoseFirstGoalIsNone) {
  Rig rig;
  rig.tick(0, false);
  rig.tick(kNoNumber, true);
  EXPECT_EQ(rig.law.refused(), 0);
  EXPECT_EQ(rig.outputs.torque_enable, 0U);
  rig.tick(0.2F, true);
  EXPECT_EQ(rig.outputs.torque_enable, 1U);
  EXPECT_NEAR(rig.goal_rad(), 0.2F, 2e-3F);
}

TEST(OwnLaw, DigestsWhatIsSent) {
  Rig one, other;
  one.tick(0.2F, true);
  other.tick(0.3F, true);
  EXPECT_NE(one.state.digest.chain, other.state.digest.chain);
  EXPECT_NE(one.state.digest.chain, State().digest.chain);
}

}  // namespace
}  // namespace verp::app
