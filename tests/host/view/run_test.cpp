#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <random>
#include <thread>

#include "host/apps/view/run/live_run.hpp"
#include "host/apps/view/run/player.hpp"
#include "host/apps/view/run/pose_hand.hpp"
#include "host/apps/view/run/steering.hpp"
#include "host/robot/model/params.hpp"
#include "host/trace/record/replay.hpp"
#include "host/trace/record/trace.hpp"
#include "tests/host/session/plans.hpp"

namespace verp::view {
namespace {

using namespace std::chrono_literals;
using session::test::plan_of;

TEST(Pace, WaitsForTheClockTimesItsSpeed) {
  Pace pace;
  pace.set_speed(0.5, 2, 100);
  EXPECT_DOUBLE_EQ(pace.wait_s(2, 100), 0);
  EXPECT_NEAR(pace.wait_s(2.01, 100), 0.02, 1e-9);
  pace.set_speed(20, 3, 200);
  EXPECT_NEAR(pace.wait_s(3.01, 200), 0.0005, 1e-9);
  pace.set_speed(0, 3, 200);
  EXPECT_EQ(pace.wait_s(1000, 200), 0);
}

TEST(Pace, CatchesUpNoLongDelay) {
  Pace pace;
  pace.set_speed(1, 0, 0);
  EXPECT_EQ(pace.wait_s(1, 1.1), 0) << "a short one";
  EXPECT_NEAR(pace.wait_s(1.2, 1.1), 0.1, 1e-9) << "is caught up";
  EXPECT_EQ(pace.wait_s(1.3, 9), 0) << "a long one";
  EXPECT_NEAR(pace.wait_s(1.4, 9), 0.1, 1e-9) << "is not";
}

TEST(Pace, BesideATwinThatIsLateThereAreFewerPictures) {
  Pace pace;
  pace.set_speed(1, 0, 0);
  pace.wait_s(1, 1.01);
  EXPECT_NEAR(pace.late_s(), 0.01, 1e-9);
  EXPECT_LE(frame_ms(pace.late_s()), 1000 / 20) << "20 a second are promised";
  pace.wait_s(1.1, 1.15);
  EXPECT_GT(frame_ms(pace.late_s()), 1000 / 20);
  EXPECT_LE(frame_ms(pace.late_s()), 1000 / 10) << "and 10 with four robots";
  pace.wait_s(1.2, 9);
  EXPECT_NEAR(pace.late_s(), 7.8, 1e-9) << "though it is not caught up";
  pace.wait_s(9.2, 9.1);
  EXPECT_EQ(pace.late_s(), 0);
}

void until(const LiveRun& run, std::uint64_t ticks) {
  for (int i = 0; i < 60000 && run.status().ticks < ticks; ++i) std::this_thread::sleep_for(1ms);
  ASSERT_GE(run.status().ticks, ticks) << run.status().failure;
}

TEST(LiveRun, HasTheBitsOfTheSameWalkWithoutAWindowAtAnySpeed) {
  const session::WalkPlan plan = plan_of("dxl");
  const session::test::Chain expected = session::test::alone(plan);
  LiveRun run({.run = {.plans = {plan}}});
  const auto check = [&](std::uint64_t at_least) {
    until(run, at_least);
    run.pause();
    std::this_thread::sleep_for(50ms);
    const LiveRun::Status status = run.status();
    ASSERT_LE(status.ticks, expected.size());
    EXPECT_EQ(status.digest, expected[status.ticks - 1]) << "tick " << status.ticks;
  };
  run.tick_once();
  check(1);
  std::uint64_t ticks = run.status().ticks;
  EXPECT_EQ(ticks, 1U) << "one is one";
  for (const double speed : {0.1, 1.0, 20.0, 0.0}) {
    run.set_speed(speed);
    run.play();
    ticks += speed < 1 ? 5 : 60;
    check(ticks);
  }
  run.reset();
  while (run.status().runs < 2) std::this_thread::sleep_for(1ms);
  run.set_speed(0);
  run.play();
  check(100);
}

TEST(LiveRun, ARunThatAPersonTouchedReplaysFromItsTrace) {
  const auto file = std::filesystem::temp_directory_path() / "verp_view_touched.mcap";
  const session::WalkPlan plan = plan_of("dxl");
  LiveRun run({.run = {.plans = {plan}}});
  run.set_speed(0);
  run.play();
  until(run, 50);
  Steering steering(plan.params);
  steering.nudge(1, 0, 1);
  run.touch([&](LiveRun::Hands& hands) {
    hands.orders.take(steering.command());
    hands.orders.write(*model::tuning_id("gait.lift_m"), 0.02F);
  });
  until(run, 300);
  run.pause();
  ASSERT_EQ(run.save(file), "");
  const LiveRun::Status status = run.status();
  EXPECT_EQ(status.tuning->gait.lift_m, 0.02F);
  EXPECT_TRUE(status.driving);
  const record::Trace trace = record::read_trace(file);
  EXPECT_EQ(trace.ticks.size(), status.ticks);
  EXPECT_EQ(trace.digest(), status.digest);
  EXPECT_EQ(trace.ticks.back().inputs.command.vx_tenth_mm_s, steering.command().vx_tenth_mm_s);
  EXPECT_FALSE(record::replay(trace).divergence);
  EXPECT_NE(run.save("/nowhere/at/all.mcap"), "") << "is told";

  std::filesystem::remove(file);
}

TEST(LiveRun, APushThatIsNoneIsToldAndTheRunGoesOn) {
  LiveRun run({.run = {.plans = {plan_of("dxl")}}});
  run.set_speed(0);
  run.play();
  session::Intervention push{.kind = session::Intervention::Kind::kPush, .name = "no_such_link"};
  push.for_s = 0.1;
  until(run, 5);
  run.intervene(push);
  until(run, 20);
  for (int i = 0; i < 5000 && run.status().complaint.empty(); ++i) std::this_thread::sleep_for(1ms);
  EXPECT_NE(run.status().complaint.find("no_such_link"), std::string::npos);
  EXPECT_EQ(run.status().failure, "");
}

TEST(Player, WindsARunBackTickByTick) {
  Player player(RunSetup{.run = {.plans = {plan_of("dxl")}}});
  player.set_speed(0);
  player.play();
  until(*player.live(), 150);
  player.seek(player.film()->begin_s() + 1);
  EXPECT_FALSE(player.playing());
  const double one_s = player.shown_s();
  player.step(1);
  const double physics_step_s = 0.001;  // a tick falls on such a step
  EXPECT_NEAR(player.shown_s() - one_s, player.film()->period_s(), 1.5 * physics_step_s);
  player.step(-1);
  EXPECT_NEAR(player.shown_s(), one_s, 1e-6);
}

// Bus and physics steps decide it.
TEST(Player, StepsFromInstantToInstantHoweverFarTheyAreApart) {
  constexpr double kInstants[] = {1.0, 1.009, 1.02, 1.029, 1.04};
  const auto film = std::make_shared<LiveFilm>(std::make_shared<const scene::Entity>(), 0.01);
  for (const double t_s : kInstants) {
    scene::Snapshot snapshot;
    snapshot.t_s = t_s;
    snapshot.robots.resize(1);
    film->add(snapshot);
  }
  Player player(film);
  for (std::size_t i = 1; i < std::size(kInstants); ++i) {
    player.step(1);
    EXPECT_EQ(player.shown_s(), kInstants[i]) << "forth to " << i;
  }
  for (std::size_t i = std::size(kInstants) - 1; i-- > 0;) {
    player.step(-1);
    EXPECT_EQ(player.shown_s(), kInstants[i]) << "back to " << i;
  }
}

TEST(PoseHand, AFootGoesWhereItIsDraggedAsFarAsTheLegReaches) {
  const session::WalkPlan plan = plan_of("dxl");
  PoseHand hand(plan.entity, plan.params);
  hand.set_joint(plan.params.leg[0].joint[3], 0.6);  // a bent knee reaches both ways
  hand.move_foot(0, hand.sole_body_m(0) + scene::Vec3(0, 0, 0.01));
  const scene::Vec3 to = hand.sole_body_m(0) + scene::Vec3(0.01, 0.005, 0.005);
  hand.move_foot(0, to);
  EXPECT_LT((hand.sole_body_m(0) - to).norm(), 1e-4);
  EXPECT_EQ(hand.reach(0), "within reach");
  EXPECT_EQ(hand.solver(0), "closed form");
  hand.move_foot(0, to - scene::Vec3(0, 0, 0.5));
  EXPECT_NE(hand.reach(0).find("out of reach"), std::string::npos);
  EXPECT_EQ(hand.foot_of(plan.params.leg[1].joint[5] + 1), 1);
  EXPECT_EQ(hand.foot_of(0), -1);
}

int hand_of(const model::Entity& entity, const std::string& joint) {
  const auto found = std::find_if(entity.joints.begin(), entity.joints.end(),
                                  [&](const model::Joint& each) { return each.name == joint; });
  return static_cast<int>(found - entity.joints.begin()) + 1;
}

TEST(PoseHand, AnArmGoesWhereItIsDragged) {
  const session::WalkPlan plan = plan_of("dxl");
  const int node = hand_of(plan.entity, "l_elbow");
  const scene::Vec3 point(0.01, 0, -0.08);
  std::mt19937 random(2001);
  std::uniform_real_distribution<double> any(-0.5, 0.5);
  for (int i = 0; i < 100; ++i) {
    PoseHand there(plan.entity, plan.params), hand(plan.entity, plan.params);
    for (int joint = node - 1; joint >= 0;
         joint = plan.entity.joints[std::size_t(joint)].parent - 1)
      there.set_joint(joint, there.joint_rad()[std::size_t(joint)] + any(random));
    const scene::Vec3 to = there.point_body_m(node, point);
    const std::vector<double> before = hand.joint_rad();
    hand.move_link(node, point, to);
    EXPECT_LT((hand.point_body_m(node, point) - to).norm(), 2e-4) << i << hand.link_reach();
    EXPECT_EQ(hand.link_reach().find("within reach"), 0u);
    for (std::size_t j = 0; j < before.size(); ++j) {
      const bool of_arm = plan.entity.joints[j].name.starts_with("l_shoulder") ||
                          plan.entity.joints[j].name == "l_elbow";
      if (!of_arm) {
        EXPECT_EQ(hand.joint_rad()[j], before[j]);
      }
      EXPECT_GE(hand.joint_rad()[j], plan.entity.joints[j].lower_rad);
      EXPECT_LE(hand.joint_rad()[j], plan.entity.joints[j].upper_rad);
    }
  }
}

TEST(PoseHand, AnArmThatCannotReachStretchesThereAndSaysByHowMuchItIsShort) {
  const session::WalkPlan plan = plan_of("dxl");
  const int node = hand_of(plan.entity, "l_elbow");
  const scene::Vec3 point(0, 0, -0.08), to(1, 0.2, 0.1);
  PoseHand hand(plan.entity, plan.params);
  hand.move_link(node, point, to);
  const double short_m = (hand.point_body_m(node, point) - to).norm();
  EXPECT_GT(short_m, 0.5);
  EXPECT_LT(short_m, (to - hand.point_body_m(node, scene::Vec3::Zero())).norm());
  EXPECT_NE(hand.link_reach().find(std::to_string(std::lround(1e3 * short_m)) + " mm short"),
            std::string::npos)
      << hand.link_reach();
  hand.move_link(0, point, to);
  EXPECT_EQ(hand.link_reach(), "is held; take a limb");
  hand.stand();
  EXPECT_EQ(hand.link_reach(), "");
}

}  // namespace
}  // namespace verp::view
