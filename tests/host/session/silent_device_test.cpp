#include <gtest/gtest.h>

#include <functional>

#include "common/control/step.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/fault_names.hpp"
#include "host/run/session/session.hpp"

namespace verp::session {
namespace {

/// The device that holds a robot that stands, whose Inputs `spoil` changes; empty: nothing holds
/// it.
std::string held_by(const std::function<void(Inputs&)>& spoil) {
  WalkPlan plan;
  plan.entity = model::load_robot(model::find_model("generic21"), "");
  plan.params = model::make_params(plan.entity);
  plan.stands = true;
  plan.walk_s = 5;
  std::string held;
  int stood = 0;
  Hooks hooks;
  hooks.decide = [&](const Params& params, State& state, const Inputs& told, Outputs& outputs) {
    Inputs inputs = told;
    if (stood > 20) spoil(inputs);
    step(params, {}, state, inputs, outputs);
    stood += state.machine.mode == safety::Mode::kStanding ? 1 : 0;
    if (held.empty() && state.machine.mode == safety::Mode::kHolding)
      held = silent_device(params, state);
  };
  Options options;
  options.world.step_us = 2000;
  options.interrupted = [&] { return !held.empty(); };
  walk(plan, hooks, options);
  return held;
}

TEST(SilentDevice, IsNamedAsItHoldsTheRobot) {
  EXPECT_EQ(held_by([](Inputs&) {}), "");
  EXPECT_EQ(held_by([](Inputs& inputs) { inputs.fresh &= ~(1U << 3); }), "servo 2");
  EXPECT_EQ(held_by([](Inputs& inputs) { inputs.fresh &= ~(1U << 3 | 1U << 5); }), "servos 2, 6");
  EXPECT_EQ(held_by([](Inputs& inputs) { inputs.flags &= static_cast<std::uint16_t>(~kImuFresh); }),
            "IMU");
}

}  // namespace
}  // namespace verp::session
