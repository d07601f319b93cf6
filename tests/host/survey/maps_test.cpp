#include <gtest/gtest.h>

#include <cmath>

#include "host/run/session/session.hpp"
#include "host/study/survey/push_map.hpp"
#include "host/study/survey/stability_map.hpp"
#include "host/study/survey/words.hpp"
#include "tests/host/session/plans.hpp"

namespace verp::survey {
namespace {

const sim::WorldOptions kCoarse{.step_us = 2000};

session::WalkPlan plan_of(double walk_s) {
  session::WalkPlan plan = session::test::plan_of("");
  plan.walk_s = walk_s;
  return plan;
}

bool survives(session::WalkPlan plan, const PushOptions& options, const PushCell& cell,
              double impulse_n_s) {
  const double force_n = impulse_n_s / options.push_s;
  const double to_rad = cell.heading_rad + cell.direction_rad;
  plan.interventions.push_back(
      {.kind = session::Intervention::Kind::kPush,
       .at_s = cell.at_s,
       .name = "trunk",
       .force_world_n = {force_n * std::cos(to_rad), force_n * std::sin(to_rad), 0},
       .for_s = options.push_s});
  return session::walk(plan, {}, {.world = kCoarse, .interrupted = {}}).good();
}

TEST(PushMap, FindsTheLargestPushThatTheSameWalkSurvivesWhateverTheThreads) {
  const PushOptions options{
      .phases = 2, .directions = 1, .settle_s = 1.2, .after_s = 1, .step_n_s = 1, .steps = 3};
  const session::WalkPlan plan = plan_of(least_walk_s(options, 0.45));
  const PushMap map = push_map(plan, kCoarse, options, {.threads = 1});
  EXPECT_EQ(csv_of(push_map(plan, kCoarse, options, {.threads = 3})), csv_of(map));
  EXPECT_EQ(map.walks, 4u);
  ASSERT_EQ(map.cells.size(), 2u);
  const PushCell& cell = map.cells[1];
  EXPECT_EQ(cell.phase, 1);
  EXPECT_NEAR(cell.at_s - map.cells[0].at_s, 0.225, 1e-6);
  EXPECT_NE(cell.heading_rad, map.cells[0].heading_rad) << "it sways as it walks";
  ASSERT_TRUE(cell.survives_n_s);
  ASSERT_LT(*cell.survives_n_s, options.most_n_s());
  EXPECT_TRUE(survives(plan, options, cell, *cell.survives_n_s));
  EXPECT_FALSE(survives(plan, options, cell, *cell.survives_n_s + options.step_n_s));
}

TEST(PushMap, OfARobotThatStandsEndsWithIt) {
  PushOptions options = standing_pushes();
  options.directions = 2;
  options.settle_s = 0.5;
  options.after_s = 1.5;
  options.step_n_s = 0.5;
  options.steps = 7;
  const PushMap map = push_map(plan_of(1), kCoarse, options, {.threads = 2});
  ASSERT_EQ(map.cells.size(), 2u);
  EXPECT_EQ(map.walks, 6u);
  for (const PushCell& cell : map.cells) {
    ASSERT_TRUE(cell.survives_n_s);
    EXPECT_GE(*cell.survives_n_s, 0.5) << cell.direction_rad << ": a tap";
    EXPECT_LE(*cell.survives_n_s, 3.0) << cell.direction_rad << ": as fast as it could run";
  }
}

TEST(PushMap, OfARobotThatFallsUnpushedThereIsNone) {
  const PushOptions options{.phases = 1, .directions = 1, .settle_s = 1};
  session::WalkPlan plan = plan_of(6);
  plan.params.tuning.gait.lift_m = 0;
  plan.velocity.vx_tenth_mm_s = 3000;
  try {
    push_map(plan, kCoarse, options, {});
    FAIL() << "it walks";
  } catch (const SurveyError& error) {
    EXPECT_NE(std::string(error.what()).find("without a push"), std::string::npos) << error.what();
  }
}

TEST(PushMap, InterruptedKeepsWhatIsDoneAndSaysSo) {
  const PushMap map = push_map(plan_of(8), kCoarse, {}, {.interrupted = [] { return true; }});
  EXPECT_TRUE(map.interrupted);
  EXPECT_TRUE(sides_of(map).empty());
}

// Over so few cycles a turn lags.
TEST(StabilityMap, SaysWhatWasAskedAndWhatWasWalkedAndKeepsItWhenInterrupted) {
  const StabilityOptions options{.on_axis = 3, .most = {0.12, 0.04, 0.5}, .begin_s = 1.5};
  double share = 0;
  const Watch watch{.interrupted = [&] { return share > 0.3; },
                    .went_on = [&](double now) { share = now; },
                    .threads = 1};
  const StabilityMap map =
      stability_map(plan_of(least_walk_s(options, 1)), kCoarse, options, watch);
  EXPECT_TRUE(map.interrupted);
  ASSERT_EQ(map.cells.size(), 15u) << "two planes of nine, which share three";
  EXPECT_GE(count_of(map, StabilityCell::End::kWalked), 5);
  EXPECT_GE(count_of(map, StabilityCell::End::kNone), 8);
  for (const StabilityCell& cell : map.cells) {
    if (cell.end == StabilityCell::End::kNone) continue;
    ASSERT_TRUE(cell.walked) << cell.why;
    EXPECT_NEAR(cell.walked->vx_m_s, cell.asked.vx_m_s, 0.03);
    EXPECT_NEAR(cell.walked->vy_m_s, cell.asked.vy_m_s, 0.03);
    EXPECT_NEAR(cell.walked->wz_rad_s, cell.asked.wz_rad_s, 0.35);
  }
  EXPECT_NE(text_of(map, options).find("   -0.120   + + +\n"), std::string::npos)
      << text_of(map, options);
}

}  // namespace
}  // namespace verp::survey
