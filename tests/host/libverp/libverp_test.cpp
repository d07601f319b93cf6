#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "common/control/state.hpp"
#include "common/gait/gait.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "host/apps/libverp/verp.hpp"
#include "tests/host/libverp/opened.hpp"
#include "tests/host/session/plans.hpp"

namespace verp::abi::test {
namespace {

TEST(Libverp, WalksAsASessionDoes) {
  const session::WalkPlan plan = session::test::plan_of("");
  const session::WalkResult wanted = session::walk(plan);
  Opened opened;
  opened.add();
  opened.run();
  const verp_result result = opened.result();
  EXPECT_EQ(result.digest, wanted.digest);
  EXPECT_EQ(result.ticks, wanted.ticks);
  EXPECT_EQ(result.distance_m, wanted.metrics.distance_m);
  EXPECT_STREQ(result.failure, "");
}

TEST(Libverp, CoreDecidesWhatTheSessionDid) {
  Opened opened;
  opened.add();
  verp_tick seen = {};
  seen.size = sizeof seen;
  ASSERT_EQ(verp_session_view(opened.session, 0, &seen), VERP_OK);
  verp_lib::Core core;
  while (verp_session_tick(opened.session, 1, nullptr, nullptr) == VERP_OK) {
    verp_outputs out = {};
    core.step(seen.inputs, out);
    ASSERT_EQ(core.digest(), seen.digest);
    ASSERT_EQ(std::memcmp(&out, &seen.outputs, sizeof out), 0);
  }
  EXPECT_GT(seen.truth.body_m[0], 0.04);
  State state;
  ASSERT_EQ(verp_session_state(opened.session, 0, &state, sizeof state), VERP_OK);
  EXPECT_EQ(state.digest.chain, core.digest());
}

TEST(Libverp, KinematicsAreTheCoresBits) {
  const session::WalkPlan plan = session::test::plan_of("");
  const Params& params = plan.params;
  const verp_lib::Core core;
  std::vector<float> angle_rad;
  for (int j = 0; j < params.joint_count; ++j) angle_rad.push_back(params.joint[j].stand_rad);

  Pose node[kMaxNodes];
  kinematics::all_poses(params, Pose(), angle_rad.data(), node);
  const auto poses = core.forward(angle_rad);
  ASSERT_EQ(poses.size(), angle_rad.size() + 1);
  for (std::size_t n = 0; n < poses.size(); ++n) {
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(poses[n][9 + i], node[n].position_m(static_cast<int>(i)));
    EXPECT_EQ(poses[n][1], node[n].rotation(0, 1));
  }
  const Vec3 com = kinematics::center_of_mass(params, Pose(), angle_rad.data());
  for (int i = 0; i < 3; ++i) EXPECT_EQ(core.com(angle_rad)[static_cast<std::size_t>(i)], com(i));

  const auto planned = core.plan(0.1, 0, 0, 500, 320);
  const verp_plan& middle = planned[150];
  verp_lib::Core::Pose sole;
  std::copy_n(middle.sole[0], sole.size(), sole.begin());
  const auto leg = core.leg_ik(0, sole);
  EXPECT_EQ(leg.flags, 0U);
  for (std::size_t k = 0; k < kLegJoints; ++k) EXPECT_EQ(leg.angle_rad[k], middle.leg_rad[k]);
  EXPECT_EQ(planned.front().phase, 0);
  EXPECT_EQ(middle.phase, 2) << "the transition phase";
  EXPECT_EQ(planned.back().phase, 0) << "it was asked to stop";
}

int freeze(const verp_moment* moment, void*) {
  moment->outputs->torque_enable = 0;
  return 0;
}

/// The robot's own is never called, so the digest differs.
TEST(Libverp, ReplacedControllerHasTheRobot) {
  Opened opened;
  opened.add();
  ASSERT_EQ(verp_session_control(opened.session, 0, freeze, nullptr), VERP_OK);
  verp_tick seen = {};
  seen.size = sizeof seen;
  ASSERT_EQ(verp_session_view(opened.session, 0, &seen), VERP_OK);
  ASSERT_EQ(verp_session_tick(opened.session, 50, nullptr, nullptr), VERP_OK);
  EXPECT_EQ(seen.outputs.torque_enable, 0U);
  EXPECT_TRUE(seen.truth.held) << "nobody ever armed it";
  const std::uint64_t first = seen.digest;
  ASSERT_EQ(verp_session_tick(opened.session, 1, nullptr, nullptr), VERP_OK);
  EXPECT_NE(seen.digest, first);
}

TEST(Libverp, OwnControllerThatDecidesLikeTheRobotsIsTheSameRun) {
  const auto digest_with = [](verp_lib::Session::Controller controller) {
    verp_lib::Session session;
    verp_robot robot = verp_lib::Session::defaults();
    robot.walk_s = session::test::kWalk_s;
    session.add(robot);
    session.control(std::move(controller));
    while (session.tick(100)) {
    }
    return session.result().digest;
  };
  EXPECT_EQ(digest_with([](const verp_lib::Moment& moment) { moment.decide(); }), digest_with({}));
}

int hold_on(const verp_moment* moment, void*) {
  verp_decide(moment->token);
  moment->outputs->torque_enable = ~0U;
  for (std::int32_t& goal : moment->outputs->goal_count) goal = 100'000;
  return 0;
}

TEST(Libverp, NoControllerKeepsTorqueThroughAnEmergencyStopOrOrdersWhatNoJointReaches) {
  Opened opened;
  opened.add();
  verp_tick seen = {};
  seen.size = sizeof seen;
  ASSERT_EQ(verp_session_view(opened.session, 0, &seen), VERP_OK);
  ASSERT_EQ(verp_session_control(opened.session, 0, hold_on, nullptr), VERP_OK);
  ASSERT_EQ(verp_session_tick(opened.session, 500, nullptr, nullptr), VERP_OK);
  EXPECT_NE(seen.outputs.torque_enable, 0U) << "it stands";
  for (const std::int32_t goal : seen.outputs.goal_count) EXPECT_LT(goal, 4096);
  ASSERT_EQ(verp_session_emergency_stop(opened.session, 0, 1), VERP_OK);
  ASSERT_EQ(verp_session_tick(opened.session, 1, nullptr, nullptr), VERP_OK);
  EXPECT_EQ(seen.outputs.torque_enable, 0U);
}

/// With walk_s 0 only orders move the robot.
TEST(Libverp, DrivesARobotByOrders) {
  Opened opened;
  opened.add([](verp_robot& robot) { robot.walk_s = 0; });
  const auto order = [&](std::uint32_t request, std::uint32_t ticks) {
    ASSERT_EQ(verp_session_command(opened.session, 0, request, 0.1, 0, 0, 0, 0), VERP_OK);
    ASSERT_EQ(verp_session_tick(opened.session, ticks, nullptr, nullptr), VERP_OK);
  };
  double mass_kg = 0, lift_m = 0;
  ASSERT_EQ(verp_session_read(opened.session, "trunk.mass_kg", &mass_kg), VERP_OK);
  ASSERT_EQ(verp_session_set(opened.session, "trunk.mass_kg", 1.01 * mass_kg), VERP_OK);
  order(VERP_STAND, 600);
  ASSERT_EQ(verp_session_tune(opened.session, 0, "gait.lift_m", 0.0125), VERP_OK);
  ASSERT_EQ(verp_session_push(opened.session, "trunk", 0, 1, 0, 0.1), VERP_OK);
  order(VERP_WALK, 300);
  ASSERT_EQ(verp_session_tuning(opened.session, 0, "gait.lift_m", &lift_m), VERP_OK);
  EXPECT_FLOAT_EQ(static_cast<float>(lift_m), 0.0125F);
  const verp_result result = opened.result();
  EXPECT_GT(result.ahead_m, 0.1);
  EXPECT_FALSE(result.fallen);
}

TEST(Libverp, ARobotLiesDownBeforeItLetsGoAndGetsUpWhenOrdered) {
  Opened opened;
  opened.add([](verp_robot& robot) { robot.walk_s = 0; });
  verp_tick seen = {};
  seen.size = sizeof seen;
  ASSERT_EQ(verp_session_view(opened.session, 0, &seen), VERP_OK);
  const auto order = [&](std::uint32_t request, std::uint32_t ticks) {
    ASSERT_EQ(verp_session_command(opened.session, 0, request, 0, 0, 0, 0, 0), VERP_OK);
    ASSERT_EQ(verp_session_tick(opened.session, ticks, nullptr, nullptr), VERP_OK);
  };
  order(VERP_STAND, 400);
  order(VERP_RELAX, 1400);
  EXPECT_EQ(seen.outputs.torque_enable, 0U);
  EXPECT_GT(seen.truth.body_rpy_rad[1], 1.2) << "on its front";
  order(VERP_GET_UP, 1700);
  EXPECT_NEAR(seen.truth.body_rpy_rad[1], 0, 0.2);
  EXPECT_NE(seen.outputs.torque_enable, 0U);
}

}  // namespace
}  // namespace verp::abi::test
