#include <gtest/gtest.h>

#include <string>

#include "common/control/step.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/session.hpp"
#include "tests/hil/modes.hpp"
#include "tests/hil/safe_table.hpp"

namespace verp::test {
namespace {

struct Liar {
  const char* robot;
  const char* bus;
};
constexpr Liar kLiars[] = {{"generic21", ""}, {"generic21", "can"}, {"op3", ""}, {"darwin_op", ""}};

struct Unmasked {
  double held_s = -1, limp_s = -1;  ///< after the lie begins; -1: never
  std::uint32_t faults = 0, named = 0;
};

session::WalkPlan plan_for(const Liar& liar) {
  session::WalkPlan plan;
  plan.entity = model::load_robot(model::find_model(liar.robot), liar.bus);
  plan.params = model::make_params(plan.entity);
  plan.velocity.vx_tenth_mm_s = 1500;
  plan.walk_s = 20;
  return plan;
}

constexpr double kWalks_s = 3;

/// Until it is limp, or for 20 s after the first intervention, kWalks_s into the gait.
Unmasked unmask(const session::WalkPlan& plan, bool refereed = true) {
  Unmasked seen;
  SafeTable table(plan.params);
  const double period_s = 1e-6 * plan.params.period_us;
  bool lies = false;
  double lied_s = 0;
  session::Hooks hooks;
  hooks.open_end = true;
  hooks.decide = [&](const Params& params, State& state, const Inputs& inputs, Outputs& outputs) {
    step(params, {}, state, inputs, outputs);
    table.tick(inputs, outputs);
    if (!lies) return;
    lied_s += period_s;
    seen.faults |= outputs.faults;
    seen.named |= state.trust.doubted;
    if (outputs.mode == kHolding && seen.held_s < 0) seen.held_s = lied_s;
    if (outputs.torque_enable == 0 && seen.limp_s < 0) seen.limp_s = lied_s;
  };
  hooks.ticked = [&](const session::Tick& tick) { lies = lies || tick.gone_s >= kWalks_s; };
  session::Options options;
  options.world.step_us = 2000;
  options.interrupted = [&] { return seen.limp_s > 0 || lied_s > 20; };
  const session::WalkResult result = session::walk(plan, hooks, options);
  EXPECT_TRUE(!refereed || table.violation().empty()) << table.violation();
  EXPECT_FALSE(result.interventions.empty());
  return seen;
}

Unmasked walk_with(const Liar& liar, const std::string& setting) {
  session::WalkPlan plan = plan_for(liar);
  plan.interventions.push_back(session::read_setting(std::to_string(kWalks_s) + ": " + setting));
  return unmask(plan);
}

std::string knee_of(const Liar& liar) {
  const session::WalkPlan plan = plan_for(liar);
  return plan.params.joint[plan.params.leg[0].joint[3]].name;
}

// A jammed gear, an encoder that is stuck, one that jumps by a turn: the servo's loop is fooled,
// too.
TEST(LyingDevices, KneeThatDoesNotFollowHoldsTheWalkWithin300MsAndThenLetsGo) {
  for (const Liar& liar : kLiars) {
    const std::string knee = knee_of(liar);
    for (const char* lie : {"friction_n_m=100", "encoder_stuck=1", "encoder_off_count=4096"}) {
      SCOPED_TRACE(std::string(liar.robot) + liar.bus + " " + lie);
      const Unmasked seen = walk_with(liar, knee + "." + lie);
      EXPECT_GT(seen.held_s, 0);
      EXPECT_LE(seen.held_s, 0.3);
      EXPECT_GT(seen.limp_s, 0);
      EXPECT_LE(seen.limp_s, 3);
      EXPECT_NE(seen.faults & safety::kFaultNotFollowing, 0U);
      EXPECT_NE(seen.named & 1U << plan_for(liar).params.leg[0].joint[3], 0U);
    }
  }
}

TEST(LyingDevices, ImuThatIsStuckEndsTheWalkThoughABitFlickers) {
  for (const Liar& liar : kLiars) {
    for (const char* lie : {"imu_stuck", "gyro_stuck"}) {
      SCOPED_TRACE(std::string(liar.robot) + liar.bus + " " + lie);
      const Unmasked seen = walk_with(liar, std::string("robot.") + lie + "=1");
      EXPECT_GT(seen.held_s, 0);
      EXPECT_LE(seen.held_s, 0.5);
      EXPECT_LE(seen.limp_s, 4);
      EXPECT_NE(seen.faults & safety::kFaultImuSilent, 0U);
    }
  }
}

// Its IMU hangs loose, upright and still; pushed over, it stands on, on its back.
TEST(LyingDevices, RobotThatStandsOnTheFloorFeelsNoLoadAndLetsGo) {
  for (const Liar& liar : kLiars) {
    SCOPED_TRACE(std::string(liar.robot) + liar.bus);
    session::WalkPlan plan = plan_for(liar);
    plan.velocity = {};
    plan.stands = true;
    plan.interventions = {session::read_setting("3: robot.imu_loose=1"),
                          session::read_push("3.5: trunk 150,0,0 N for 0.3")};
    // The referee knows a push by the IMU; a robot that steps then seems to walk unasked.
    const bool stands = plan.entity.name == "generic21";
    const Unmasked seen = unmask(plan, stands);
    EXPECT_GT(seen.limp_s, 0) << "torque for ever";
    EXPECT_LE(seen.limp_s, 12);
    EXPECT_EQ(seen.faults & safety::kFaultFall, 0U) << "it cannot know";
  }
}

}  // namespace
}  // namespace verp::test
