#include "host/run/session/session.hpp"

#include <gtest/gtest.h>

#include <string>

#include "common/safety/machine.hpp"
#include "host/run/session/not_up.hpp"
#include "host/twin/bus/order_sink.hpp"
#include "tests/host/session/plans.hpp"

namespace verp::session::test {
namespace {

TEST(Session, RobotsOnBusesOfTheirOwnWalkInOneWorldAsTheyDoAlone) {
  const WalkPlan plans[] = {plan_of("dxl", -1), plan_of("can", 1, 2), plan_of("dxl", 3, 3)};
  Chain together[3];
  Session session;
  for (int i = 0; i < 3; ++i) session.add(plans[i], keep(together[i]));
  while (session.tick() != nullptr) {
  }
  EXPECT_TRUE(session.over());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(session.result(i).failure, "");
    EXPECT_EQ(together[i], alone(plans[i])) << "robot " << i;
  }
}

TEST(Session, RefusesARobotInsideAnother) {
  Session session;
  session.add(plan_of("dxl", 1));
  EXPECT_THROW(session.add(plan_of("dxl", 1.05)), NoRoom);
  EXPECT_NO_THROW(session.add(plan_of("dxl", 1.2)));
}

TEST(Session, OrdersGoThroughTheOperatorsRegisters) {
  WalkPlan plan = plan_of("dxl");
  Hooks hooks;
  std::uint32_t refuse_at = 200;
  hooks.order = [&](std::uint32_t tick) {
    app::OperatorOrder order;
    order.command.request = Request::kStand;
    order.command.head_pan_mrad = 123;
    order.flags = kCommandFresh;
    if (tick % 4 == 1) {  // not fresh: the last values hold
      order.command.head_pan_mrad = 321;
      order.flags = 0;
    }
    if (tick != refuse_at) return order;
    order.flags |= kParameterWrite;
    order.parameter_id = 0;  // cycle_s, at least 0.3
    order.parameter_bits = 0;
    return order;
  };
  std::uint32_t seen = 0;
  std::uint16_t flags = 0;
  hooks.ticked = [&](const Tick& tick) {
    seen = tick.record->inputs.tick;
    flags = tick.record->inputs.flags;
    EXPECT_EQ(tick.record->inputs.command.head_pan_mrad, 123) << seen;
    EXPECT_TRUE(tick.record->inputs.command.request == Request::kStand) << seen;
    EXPECT_NE(tick.outputs->mode, static_cast<std::uint8_t>(safety::Mode::kStopped));
  };
  Session session;
  session.add(plan, hooks);
  EXPECT_THROW(while (session.tick() != nullptr){}, bus::SinkError);
  EXPECT_EQ(seen + 1, refuse_at);
  EXPECT_NE(flags & kCommandFresh, 0);
}

TEST(Session, RobotsThatMeetFeelEachOther) {
  WalkPlan one = plan_of("dxl");
  one.walk_s = 4;
  WalkPlan other = plan_of("dxl", 0, 2);
  other.velocity.vx_tenth_mm_s = 0;  // stands in the way
  other.twin.start_m.x() = 0.25;
  Chain chain;
  Session session;
  session.add(one, keep(chain));
  session.add(other);
  while (session.tick() != nullptr) {
  }
  EXPECT_TRUE(chain != alone(one));
}

TEST(Session, SeveralAtATimeInOneProcessDoNotKnowOfEachOther) {
  const WalkPlan serial = plan_of("dxl"), can = plan_of("can");
  Chain chain[3];
  Session first, second, third;
  first.add(serial, keep(chain[0]));
  second.add(can, keep(chain[1]));
  third.add(serial, keep(chain[2]));
  for (bool on = true; on;) {
    on = first.tick() != nullptr;
    on = second.tick() != nullptr || on;
    on = third.tick() != nullptr || on;
  }
  EXPECT_EQ(chain[0], chain[2]);
  EXPECT_EQ(chain[0], alone(serial));
  EXPECT_EQ(chain[1], alone(can));
}

TEST(Session, ShowsEachTickWithWhatTheTwinKnowsOfIt) {
  std::uint32_t next = 0;
  double height_m = 0;
  Hooks hooks;
  hooks.keep_series = true;
  hooks.ticked = [&](const Tick& tick) {
    ASSERT_NE(tick.record, nullptr);
    EXPECT_EQ(tick.record->inputs.tick, next++);
    EXPECT_EQ(tick.state->digest.chain, tick.record->digest.chain);
    height_m = tick.seen.truth.body_world.translation().z();
    EXPECT_LE(tick.gone_s, kWalk_s + 0.5);
  };
  Session session;
  Robot& robot = session.add(plan_of("dxl"), hooks);
  EXPECT_EQ(session.tick(), &robot);
  EXPECT_EQ(next, 1u);
  EXPECT_GT(height_m, 0.2);
  while (session.tick() != nullptr) {
  }
  EXPECT_EQ(session.result(0).series.size(), next);
}

TEST(Session, TakesOrdersInPlaceOfTheWalks) {
  Command command;
  command.request = Request::kStand;
  WalkPlan plan = plan_of("dxl");
  plan.walk_s = 4;
  Hooks hooks;
  hooks.order = [&](std::uint32_t) {
    ++command.sequence;
    return app::OperatorOrder{.command = command, .flags = kCommandFresh};
  };
  bool stood = false;
  hooks.ticked = [&](const Tick& tick) {
    stood = stood || tick.outputs->mode == static_cast<std::uint8_t>(safety::Mode::kStanding);
    if (tick.gone_s > 3) command.request = Request::kRelax;
  };
  const WalkResult result = walk(plan, hooks);
  EXPECT_TRUE(stood);
  EXPECT_EQ(result.failure, "");
  EXPECT_NEAR(result.simulated_s, 4.8, 0.8) << "bring-up, and plan.walk_s of orders";
}

TEST(Session, EndsWhenItsUserSaysSo) {
  int asked = 0;
  const WalkResult result = walk(plan_of("dxl"), {}, {.interrupted = [&] { return ++asked > 50; }});
  EXPECT_TRUE(result.interrupted);
  EXPECT_FALSE(result.good());
  EXPECT_GT(result.ticks, 0u);
  EXPECT_LE(result.ticks, 50u);
}

TEST(Session, ThatIsLeftInMidRunTakesItsRobotsWithIt) {
  Session session;
  session.add(plan_of("dxl", -1));
  session.add(plan_of("can", 1));
  for (int i = 0; i < 20; ++i) EXPECT_NE(session.tick(), nullptr);
  EXPECT_FALSE(session.over());
}

TEST(Session, SaysWhichRobotDoesNotComeUp) {
  for (const int robots : {1, 2}) {
    Session session;
    const WalkPlan plan = plan_of("dxl");
    const int id = plan.params.joint[3].servo_id;
    session.add(plan).bus().set_connected(static_cast<std::uint8_t>(id), false);
    if (robots == 2) session.add(plan_of("can", 2));
    try {
      while (session.tick() != nullptr) {
      }
      FAIL() << "came up";
    } catch (const NotUp& error) {
      EXPECT_NE(std::string(error.what()).find("device " + std::to_string(id)), std::string::npos);
    }
  }
}

TEST(Session, TakesNobodyInAfterItsFirstTick) {
  Session session;
  session.add(plan_of("dxl"));
  session.tick();
  EXPECT_THROW(session.add(plan_of("dxl", 2)), std::logic_error);
}

/// It falls because it lets go, and the fall is not the cause.
TEST(Session, AWalkThatSagOrHeatEndsSaysSoWithNumbers) {
  WalkPlan sags = plan_of("dxl");
  sags.twin.supply_v = 9.7;
  const std::string low = walk(sags).failure;
  EXPECT_EQ(low.rfind("stopped by fault: voltage low", 0), 0U) << low;
  EXPECT_NE(low.find("; lowest 9."), std::string::npos) << low;
  EXPECT_NE(low.find(" V, cut-out 9.6 V)"), std::string::npos) << low;
  WalkPlan warms = plan_of("dxl");
  for (model::Joint& joint : warms.entity.joints) {
    joint.servo.heat_capacity_j_k = 0.2;
    joint.servo.heat_resistance_k_w = 1000;
  }
  const std::string hot = walk(warms).failure;
  EXPECT_EQ(hot.rfind("stopped by fault: ", 0), 0U) << hot;
  EXPECT_NE(hot.find("servo too hot"), std::string::npos) << hot;
  EXPECT_NE(hot.find(" C, limit "), std::string::npos) << hot;
}

}  // namespace
}  // namespace verp::session::test
