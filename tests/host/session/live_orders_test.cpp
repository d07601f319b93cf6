#include "host/run/session/live_orders.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "common/control/step.hpp"
#include "common/safety/machine.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/session/plans.hpp"

namespace verp::session::test {
namespace {

Hooks amended(LiveOrders& orders) {
  Hooks hooks;
  hooks.open_end = true;
  hooks.amend = [&orders](std::uint32_t tick, app::OperatorOrder& order) {
    orders.amend(tick, order);
  };
  return hooks;
}

TEST(LiveOrders, NobodyTouchesIsTheSameRunToTheLastBit) {
  const WalkPlan plan = plan_of("dxl");
  const Chain expected = alone(plan);
  LiveOrders orders;
  Chain chain;
  Hooks hooks = amended(orders);
  hooks.ticked = keep(chain).ticked;
  Session session;
  session.add(plan, hooks);
  while (chain.size() < expected.size() + 20) ASSERT_NE(session.tick(), nullptr);
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), chain.begin()));
  EXPECT_FALSE(session.over()) << "an open end";
}

TEST(LiveOrders, WhatAPersonDidIsInTheInputsAndReplays) {
  const WalkPlan plan = plan_of("dxl");
  const int lift = *model::tuning_id("gait.lift_m");
  LiveOrders orders;
  std::vector<TickRecord> ticks;
  float in_force = 0;
  Hooks hooks = amended(orders);
  hooks.ticked = [&](const Tick& tick) {
    ticks.push_back(*tick.record);
    in_force = tick.state->tuning.gait.lift_m;
  };
  Session session;
  session.add(plan, hooks);
  for (int i = 0; i < 700; ++i) {
    if (i == 100) {
      EXPECT_TRUE(orders.write(lift, 0.02F));
      EXPECT_TRUE(orders.write(lift, 0.015F)) << "the last value counts";
    }
    if (i == 200) {
      Command walk;
      walk.request = Request::kWalk;
      walk.vx_tenth_mm_s = 500;
      orders.take(walk);
    }
    ASSERT_NE(session.tick(), nullptr);
  }
  EXPECT_EQ(in_force, 0.015F);
  EXPECT_EQ(ticks.back().inputs.command.vx_tenth_mm_s, 500);
  State state;
  Outputs outputs;
  for (const TickRecord& tick : ticks) step(plan.params, state, tick.inputs, outputs);
  EXPECT_EQ(state.digest.chain, ticks.back().digest.chain);
  EXPECT_EQ(outputs.mode, static_cast<std::uint8_t>(safety::Mode::kWalking)) << "and not quiet";
}

Request asked(LiveOrders& orders, std::uint32_t tick) {
  app::OperatorOrder order;
  order.command.request = Request::kWalk;
  orders.amend(tick, order);
  return order.command.request;
}

TEST(LiveOrders, AskARobotThatLiesToGetUpByAWordAndThenHoldToWhatWasOrdered) {
  LiveOrders orders;
  orders.observe(safety::Mode::kFallen, 0.008);
  EXPECT_EQ(asked(orders, 0), Request::kWalk) << "nobody said so";
  Command stand;
  stand.request = Request::kStand;
  orders.take(stand);
  orders.get_up();
  EXPECT_EQ(asked(orders, 1), Request::kGetUp);
  orders.observe(safety::Mode::kGettingUp, 0.008);
  EXPECT_EQ(asked(orders, 2), Request::kGetUp);
  orders.observe(safety::Mode::kStanding, 0.008);
  EXPECT_EQ(asked(orders, 3), Request::kStand);
  orders.observe(safety::Mode::kFallen, 0.008);
  EXPECT_EQ(asked(orders, 4), Request::kStand) << "a word is for once";
}

TEST(LiveOrders, LetARobotGetUpByItselfThreeTimesThenAskItToRelax) {
  LiveOrders orders;
  orders.let_get_up(true);
  orders.observe(safety::Mode::kWalking, 0.008);
  EXPECT_EQ(asked(orders, 0), Request::kWalk);
  for (int attempt = 0; attempt < 3; ++attempt) {
    orders.observe(safety::Mode::kFallen, 0.008);
    EXPECT_EQ(asked(orders, 1), Request::kGetUp) << attempt;
    orders.observe(safety::Mode::kGettingUp, 0.008);
  }
  orders.observe(safety::Mode::kFallen, 0.008);
  EXPECT_EQ(asked(orders, 2), Request::kRelax);
  orders.observe(safety::Mode::kFallen, 0.008);
  EXPECT_EQ(asked(orders, 3), Request::kRelax) << "until a person has another word";
}

TEST(LiveOrders, TheEmergencyStopHoldsWhileItIsPressed) {
  LiveOrders orders;
  orders.press_emergency_stop(true);
  for (std::uint32_t tick = 0; tick < 3; ++tick) {
    app::OperatorOrder order;
    orders.amend(tick, order);
    EXPECT_NE(order.flags & kEmergencyStop, 0);
  }
  orders.press_emergency_stop(false);
  app::OperatorOrder order;
  orders.amend(3, order);
  EXPECT_EQ(order.flags & kEmergencyStop, 0);
}

TEST(LiveOrders, RefuseNumbersOutsideTheirRange) {
  LiveOrders orders;
  EXPECT_FALSE(orders.write(-1, 0.5F));
  EXPECT_FALSE(orders.write(kTuningCount, 0.5F));
  EXPECT_FALSE(orders.write(0, 100));
  EXPECT_FALSE(orders.write(0, std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(orders.waiting(), 0U);
}

}  // namespace
}  // namespace verp::session::test
