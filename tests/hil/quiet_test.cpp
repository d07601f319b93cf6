#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "common/control/step.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/session.hpp"
#include "host/run/session/stride.hpp"
#include "tests/hil/modes.hpp"
#include "tests/hil/safe_table.hpp"

namespace verp::test {
namespace {

struct Silenced {
  double way_m = 0, time_s = 0;  ///< from the last order to the stand
  bool fallen = false;
  int changes = 0, mode = kRelaxed;
  std::uint32_t faults = 0;
};

struct Trial {
  session::WalkPlan plan;
  double walks_s = 3;  ///< before the silence
  double lasts_s = 0;  ///< of it
  bool flutters = false;

  void spoil(double silent_s, Inputs& inputs) const {
    constexpr double kEvery_s = 0.3, kMute_s = 0.07;
    constexpr int kServo = 5;
    if (!flutters) inputs.flags &= static_cast<std::uint16_t>(~kCommandFresh);
    if (flutters && std::fmod(silent_s, kEvery_s) < kMute_s) inputs.fresh &= ~(1U << kServo);
  }
  Silenced run() const;
};

Silenced Trial::run() const {
  Silenced ended;
  SafeTable table(plan.params);
  const double period_s = 1e-6 * plan.params.period_us;
  double walked_s = 0, silent_s = 0;
  sim::Vec3 from_m = sim::Vec3::Zero();
  session::Hooks hooks;
  hooks.decide = [&](const Params& params, State& state, const Inputs& told, Outputs& outputs) {
    Inputs inputs = told;
    if (walked_s > walks_s) spoil(silent_s, inputs);
    step(params, {}, state, inputs, outputs);
    table.tick(inputs, outputs);
  };
  hooks.ticked = [&](const session::Tick& tick) {
    const sim::Vec3 at_m = tick.seen.truth.body_world.translation();
    const int mode = tick.outputs->mode;
    ended.fallen = ended.fallen || tick.seen.truth.fallen;
    ended.faults = tick.outputs->faults;
    if (walked_s <= walks_s) from_m = at_m;
    if (walked_s > walks_s) {
      silent_s += period_s;
      ended.changes += mode != ended.mode ? 1 : 0;
      if (mode == kStanding && ended.time_s == 0) {
        ended.time_s = silent_s;
        ended.way_m = (at_m - from_m).head<2>().norm();
      }
    }
    ended.mode = mode;
    walked_s += mode == kWalking && silent_s == 0 ? period_s : 0;
  };
  session::Options options;
  options.world.step_us = 2000;
  options.interrupted = [&] { return ended.fallen || silent_s > lasts_s; };
  session::walk(plan, hooks, options);
  EXPECT_EQ(table.violation(), "");
  return ended;
}

struct Way {
  double ahead, left, turn_rad_s;  ///< shares of the fastest speed ahead
};

Trial trial_of(const std::string& robot, const std::string& bus, std::uint64_t seed,
               const Way& way = {1, 0, 0}) {
  Trial trial;
  session::WalkPlan& plan = trial.plan;
  plan.entity = model::load_robot(model::find_model(robot), bus);
  plan.params = model::make_params(plan.entity);
  const Command most = session::longest_order(plan.params);
  const double vx = session::within_servo_speed(plan.params, most).velocity.vx_tenth_mm_s;
  plan.velocity.vx_tenth_mm_s = static_cast<std::int16_t>(way.ahead * vx);
  plan.velocity.vy_tenth_mm_s = static_cast<std::int16_t>(way.left * vx);
  plan.velocity.wz_mrad_s = static_cast<std::int16_t>(1000 * way.turn_rad_s);
  plan.walk_s = 60;
  plan.twin.seed = seed;
  trial.walks_s += 0.07 * static_cast<double>(seed);  // another phase of the step
  return trial;
}

/// The promise of host/guide/safety.md.
double promised_m(const std::string& robot) {
  return robot == "generic21" ? 0.60 : 0.40;
}
constexpr double kPromised_s = 2.0;

void expect_stop(const std::string& robot, const std::string& bus, std::uint64_t seed,
                 const Way& way = {1, 0, 0}) {
  SCOPED_TRACE(robot + " " + bus + ", seed " + std::to_string(seed));
  Trial trial = trial_of(robot, bus, seed, way);
  trial.lasts_s = 3.5;
  const Silenced ended = trial.run();
  EXPECT_FALSE(ended.fallen);
  EXPECT_EQ(ended.mode, kStanding);
  EXPECT_GT(ended.time_s, 0.5);
  EXPECT_LE(ended.time_s, kPromised_s);
  EXPECT_LE(ended.way_m, promised_m(robot));
  EXPECT_GE(ended.way_m, way.ahead == 1 ? 0.5 * promised_m(robot) : 0) << "the bar is a walk";
}

TEST(Quiet, OperatorOfTheFastestWalkIsWaitedForNoFurtherThanPromised) {
  for (const char* robot : {"generic21", "op3", "darwin_op"}) expect_stop(robot, "", 1);
  expect_stop("generic21", "can", 2);
}

TEST(ManyQuiet, StopsOfAllWaysKeepThePromise) {
  const char* const only = std::getenv("VERP_SEED");
  for (const char* robot : {"generic21", "op3", "darwin_op"}) {
    for (const Way& way :
         {Way{1, 0, 0}, Way{-0.85, 0, 0}, Way{0, 0.5, 0}, Way{0, 0, 1.5}, Way{0.5, 0, 0.5}}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        if (only == nullptr || std::to_string(seed) == only) expect_stop(robot, "", seed, way);
      }
    }
  }
}

void expect_rest(const std::string& robot, const std::string& bus) {
  SCOPED_TRACE(robot + " " + bus);
  Trial trial = trial_of(robot, bus, 1, {0.5, 0, 0});
  trial.flutters = true;
  trial.walks_s = 1;
  trial.lasts_s = 6;
  const Silenced ended = trial.run();
  EXPECT_LE(ended.changes, 12) << "four times holding and rising, then it sits";
  EXPECT_EQ(ended.faults & safety::kFaultFlutter, safety::kFaultFlutter + 0U);
  EXPECT_TRUE(ended.mode == kRelaxed || ended.mode == kFallen) << kModeNames[ended.mode];
}

TEST(Quiet, ServoThatFluttersSitsTheRobotDown) {
  for (const char* robot : {"generic21", "op3", "darwin_op"}) expect_rest(robot, "");
  expect_rest("generic21", "can");
}

}  // namespace
}  // namespace verp::test
