#include "host/study/tune/tune.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/study/tune/evolution.hpp"
#include "host/study/tune/space.hpp"
#include "host/study/tune/trial.hpp"
#include "host/study/tune/write.hpp"

namespace verp::tune {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kRobots = fs::path(VERP_SOURCE_DIR) / "common" / "robots";

session::WalkPlan plan_of(const char* robot) {
  session::WalkPlan plan;
  plan.entity = model::load_robot(kRobots / robot / "robot.sdf");
  plan.params = model::make_params(plan.entity);
  return plan;
}

sim::WorldOptions coarse() {
  sim::WorldOptions world;
  world.step_us = 2000;
  return world;
}

// A hundred times as long as wide, with noise.
TEST(Evolution, GathersWhereTheCostIsLeast) {
  const Eigen::Vector4d best(1, -2, 0.5, 3), width(0.1, 1, 3, 10);
  Evolution evolution(Eigen::Vector4d::Zero(), 0.5, 12, 7);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.01);
  for (int generation = 0; generation < 200; ++generation) {
    std::vector<double> costs;
    for (const Eigen::VectorXd& at : evolution.ask())
      costs.push_back((at - best).cwiseQuotient(width).squaredNorm() + noise(random));
    evolution.tell(costs);
  }
  const double left = (evolution.mean() - best).cwiseQuotient(width).norm();
  EXPECT_LT(left, 0.2);
}

TEST(Evolution, RepeatsItself) {
  Evolution one(Eigen::Vector2d::Zero(), 1, 6, 3), other(Eigen::Vector2d::Zero(), 1, 6, 3);
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(one.ask(), other.ask());
    one.tell({3, 1, 2, 6, 5, 4});
    other.tell({3, 1, 2, 6, 5, 4});
  }
  EXPECT_EQ(one.mean(), other.mean());
}

TEST(Space, TheStartIsTheRobotsOwnTuning) {
  const session::WalkPlan plan = plan_of("op3");
  const Space space(plan.params);
  EXPECT_EQ(space.at(plan.params.tuning), Eigen::VectorXd::Zero(space.size()));
  const Tuning same = space.tuning(Eigen::VectorXd::Zero(space.size()), 0.1);
  EXPECT_EQ(std::memcmp(&same, &plan.params.tuning, sizeof same), 0);
}

TEST(Space, StaysInsideWhatEachNumberMayBe) {
  const session::WalkPlan plan = plan_of("generic21");
  const Space space(plan.params);
  for (const double far : {-1000.0, 1000.0}) {
    const Tuning tuning = space.tuning(Eigen::VectorXd::Constant(space.size(), far), 2);
    for (int id = 0; id < kTuningCount; ++id)
      EXPECT_TRUE(in_range(id, tuning_value(tuning, id)))
          << model::tuning_names()[static_cast<std::size_t>(id)];
  }
}

// 0.5 m/s in 0.45 s are steps of 11 cm; generic21 allows 8.
TEST(Space, LetsStepsBeAsLongAsTheSpeedNeeds) {
  const session::WalkPlan plan = plan_of("generic21");
  for (const Tuning& tuning : Space(plan.params).first_look(0.5))
    EXPECT_GE(tuning.gait.max_step_m, 0.5 * 0.5 * tuning.gait.cycle_s);
}

TEST(Trial, AFallCostsMoreThanAnyWalkAndLessTheLaterItComes) {
  session::WalkResult good, early, late;
  good.metrics.walk_s = 10;
  good.metrics.speed_steady_m_s = 0.1;  // of 0.2
  good.metrics.zmp_bias_mean_mm = 40;
  early.failure = late.failure = "fell";
  early.metrics.walk_s = 1;
  late.metrics.walk_s = 8;
  EXPECT_LT(cost_of(good, 10, 0.2), cost_of(late, 10, 0.2));
  EXPECT_LT(cost_of(late, 10, 0.2), cost_of(early, 10, 0.2));
  EXPECT_LT(cost_of(early, 10, 0.2), kCannotStand);
}

TEST(Limit, IsNamed) {
  session::WalkPlan plan = plan_of("generic21");
  plan.params.tuning.gait.max_step_m = 0.2F;
  plan.params.tuning.gait.cycle_s = 0.3F;
  EXPECT_THAT(limit_of(plan, coarse(), 0.8), HasSubstr("servo speed: "));
  plan = plan_of("generic21");
  EXPECT_THAT(limit_of(plan, coarse(), 0.8), HasSubstr("reach: steps of 180 mm are needed"));
  plan.params.tuning.gait.hip_height_m = 0.9F;
  EXPECT_THAT(limit_of(plan, coarse(), 0.2), HasSubstr("reach: the legs cannot stand"));
  plan = plan_of("generic21");
  plan.params.tuning.gait.zmp_x_m = 0.05F;            // tips over its toes
  plan.params.tuning.balance.feedback_enable = 0.0F;  // no step catches it
  EXPECT_THAT(limit_of(plan, coarse(), 0.2), HasSubstr("balance: fell after"));
}

// `verp walk` accepts half of the way, the tuner no tenth less.
TEST(Check, CountsWhoWalksAsFastAsWasAsked) {
  std::vector<session::WalkResult> results(4);
  const double speed_m_s[] = {0.21, 0.17, 0.19, 0.2};
  for (std::size_t i = 0; i < results.size(); ++i) {
    results[i].metrics.speed_steady_m_s = speed_m_s[i];
    results[i].metrics.zmp_bias_mean_mm = 10.0 * static_cast<double>(i);
  }
  results[3].failure = "fell";
  const Check check = sum_up(results, 0.2);
  EXPECT_EQ(check.walked, 2);
  EXPECT_EQ(check.of, 4);
  EXPECT_NEAR(*check.bias_mm, 10, 1e-9);
  EXPECT_NEAR(*check.speed_m_s, 0.2, 1e-9);
}

/// survey::Workers promises the same on any number of threads.
Options small() {
  return {.speed_m_s = 0.2, .generations = 1, .children = 2, .checks = 1, .try_s = 6, .check_s = 8};
}

// generic21's ZMP error is twice that of the first candidates.
TEST(Tune, MendsARobotAndSaysByHowMuch) {
  session::WalkPlan plan = plan_of("generic21");
  plan.params.tuning.gait.cycle_s = 0.31F;
  const Result result = tune(plan, coarse(), small(), {});
  EXPECT_EQ(result.limit, "");
  ASSERT_FALSE(result.numbers.empty());
  EXPECT_EQ(result.numbers.front().name, "gait.cycle_s");
  EXPECT_EQ(result.after.walked, 1);
  EXPECT_TRUE(result.before.walked == 0 || *result.after.bias_mm < *result.before.bias_mm);
}

TEST(Tune, SaysWhatStopsARobotThatWalksWithNothing) {
  Options options = small();
  options.speed_m_s = 1.5;
  options.generations = 0;
  options.try_s = options.check_s = 3;
  const Result result = tune(plan_of("generic21"), coarse(), options, {.threads = 2});
  EXPECT_EQ(result.after.walked, 0);
  EXPECT_NE(result.limit, "");
  EXPECT_TRUE(result.numbers.empty());
}

TEST(Tune, ThatIsInterruptedChangesNothing) {
  const Result result =
      tune(plan_of("generic21"), coarse(), small(), {.interrupted = [] { return true; }});
  EXPECT_TRUE(result.interrupted);
  EXPECT_TRUE(result.numbers.empty());
}

TEST(Write, OfTheFileOnlyTheNumbersChange) {
  const fs::path robot = kRobots / "op3" / "robot.sdf";
  const fs::path file = fs::path(testing::TempDir()) / "tuned.sdf";
  fs::remove(file);
  const auto id = [](const char* name) { return model::tuning_id(name).value(); };
  write({{id("gait.lift_m"), "gait.lift_m", 0.0123F, 0.0234F},
         {id("gait.cycle_s"), "gait.cycle_s", 0.45F, 0.5F}},
        robot, file);
  std::ifstream before(robot), after(file);
  std::vector<std::string> come;
  std::string line;
  std::vector<std::string> old_lines, new_lines;
  while (std::getline(before, line)) old_lines.push_back(line);
  while (std::getline(after, line)) new_lines.push_back(line);
  ASSERT_EQ(new_lines.size(), old_lines.size() + 1);
  std::size_t at = 0;
  for (const std::string& each : new_lines) {
    if (at < old_lines.size() && each == old_lines[at]) {
      ++at;
    } else {
      come.push_back(each);
      if (each.find("gait.lift_m") != std::string::npos) ++at;
    }
  }
  EXPECT_EQ(at, old_lines.size());
  ASSERT_EQ(come.size(), 2u);
  const Params params = model::make_params(model::load_robot(file));
  EXPECT_EQ(params.tuning.gait.lift_m, 0.0234F);
  EXPECT_EQ(params.tuning.gait.cycle_s, 0.5F);
}

}  // namespace
}  // namespace verp::tune
