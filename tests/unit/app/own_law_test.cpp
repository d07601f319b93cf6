#include "firmware/law/own_law.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/control/loop.hpp"

namespace verp::app {
namespace {

using safety::Mode;

/// Wants torque always, and one joint at `goal_rad`.
struct Stubborn {
  static constexpr int kJoint = verp::test::kLeftArm;
  static inline float goal_rad = 0;
  void operator()(const Params& params, const State&, const Inputs&, Outputs& outputs) {
    outputs.torque_enable = ~0U;
    outputs.goal_count[kJoint] = goal_of(params.joint[kJoint], goal_rad);
  }
};

struct Rig : control::test::Loop {
  Rig() { Stubborn::goal_rad = 0; }
  void tick() {
    hear();
    law(verp::test::kRobot, state, inputs, outputs);
    follow();
  }
  bool stands() {
    command.request = Request::kStand;
    for (int i = 0; i < 1000 && !is_in(Mode::kStanding); ++i) tick();
    return is_in(Mode::kStanding);
  }
  std::int32_t goal() const { return outputs.goal_count[Stubborn::kJoint]; }

  OwnLaw<Stubborn> law;
};

TEST(OwnLaw, HasNoTorqueBeforeTheOperatorAsksForAStand) {
  Rig rig;
  for (int i = 0; i < 300; ++i) {
    rig.tick();
    ASSERT_EQ(rig.outputs.torque_enable, 0U);
  }
}

TEST(OwnLaw, MovesAStandingRobot) {
  Rig rig;
  ASSERT_TRUE(rig.stands());
  Stubborn::goal_rad = 0.2F;
  for (int i = 0; i < 100; ++i) rig.tick();
  EXPECT_EQ(rig.law.refused(), OwnLaw<Stubborn>::kNone);
  EXPECT_EQ(rig.goal(), goal_of(verp::test::kRobot.joint[Stubborn::kJoint], 0.2F));
}

TEST(OwnLaw, LosesItsTorqueInTheTickOfAnEmergencyStop) {
  Rig rig;
  ASSERT_TRUE(rig.stands());
  EXPECT_NE(rig.outputs.torque_enable, 0U);
  rig.inputs.flags |= kEmergencyStop;
  for (int i = 0; i < 100; ++i) {
    rig.tick();
    ASSERT_TRUE(rig.is_in(Mode::kStopped));
    ASSERT_EQ(rig.outputs.torque_enable, 0U);
  }
}

TEST(OwnLaw, KeepsTheGoalBeforeOneThatIsNoNumber) {
  Rig rig;
  ASSERT_TRUE(rig.stands());
  const std::int32_t before = rig.goal();
  Stubborn::goal_rad = std::numeric_limits<float>::quiet_NaN();
  rig.tick();
  EXPECT_EQ(rig.law.refused(), Stubborn::kJoint);
  EXPECT_EQ(rig.law.refused_count(), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(rig.goal(), before);
}

TEST(OwnLaw, DigestsWhatIsSent) {
  Rig one, other;
  ASSERT_TRUE(one.stands() && other.stands());
  for (int i = 0; i < 100; ++i) one.tick(), other.tick();  // the arm arrives
  ASSERT_EQ(one.state.digest.chain, other.state.digest.chain);
  Stubborn::goal_rad = 0.05F;
  one.tick();
  Stubborn::goal_rad = -0.05F;
  other.tick();
  EXPECT_NE(one.state.digest.chain, other.state.digest.chain);
}

}  // namespace
}  // namespace verp::app
