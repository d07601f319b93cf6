#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <memory>
#include <vector>

#include "firmware/app/app.hpp"
#include "firmware/app/lockstep_can.hpp"
#include "host/twin/can/lockstep_server.hpp"
#include "host/twin/can/shadow_loop.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/host/bus/walker.hpp"
#include "tests/host/can/served_can.hpp"

namespace verp::can {
namespace {

constexpr int kTicks = 300;

template <class Bus>
std::vector<TickRecord> walk(const Params& params, Bus& bus) {
  test::Walker walker;
  auto loop =
      std::make_unique<app::App<Bus, test::Walker, test::Walker>>(params, bus, walker, walker);
  const app::BringUpReport report = loop->bring_up();
  EXPECT_EQ(report.status, app::BringUpStatus::kReady) << int{report.device_id};
  for (int i = 0; i < kTicks; ++i) loop->tick();
  EXPECT_EQ(loop->state().admit.servo_age[0], 0u) << "it heard its drives";
  EXPECT_EQ(bus.errors().overruns, 0u);
  return walker.records;
}

Params can_robot() {
  Params params = test::bus_params(7);
  params.bus_protocol = BusProtocol::kCia402;
  params.baud = 1'000'000;
  return params;
}

std::vector<TickRecord> records_here(const Params& params) {
  test::FakePlant plant;
  VirtualCan bus(params, plant);
  return walk(params, bus);
}

class CanLoop : public ::testing::Test {
 protected:
  std::vector<TickRecord> records_at_the_end_of_a_bus() {
    EXPECT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
    return walk(params, bus);
  }
  LockstepHooks hooks() {
    LockstepHooks hooks;
    hooks.tick_ends = [this] {
      shadow.catch_up();
      return true;
    };
    hooks.tick_begins = [this](std::uint32_t tick) {
      operator_link.latest = test::Walker{}.order(tick);
      shadow.ordered(operator_link.latest);
    };
    hooks.sent = [this](const CanFrame& frame) { shadow.sent(frame); };
    hooks.damaged = [this] { shadow.damaged(); };
    hooks.polled = [this](const std::vector<CanFrame>& burst, std::uint64_t now_us) {
      shadow.polled(burst, now_us);
    };
    return hooks;
  }
  /// No frame reports the last tick's end.
  void expect_shadowed(std::vector<TickRecord> records) {
    EXPECT_EQ(shadow.difference(), "");
    records.pop_back();
    expect_same(shadow_records, records);
  }
  void expect_same(const std::vector<TickRecord>& a, const std::vector<TickRecord>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(std::memcmp(&a[i], &b[i], sizeof(TickRecord)), 0) << "tick " << i;
    }
  }

  Params params = can_robot();
  test::FakePlant plant;
  VirtualCan twin{params, plant};
  /// Orders come as a tick begins, like in `verp hil`.
  struct Linked : test::Walker {
    app::OperatorOrder order(std::uint32_t) {
      const app::OperatorOrder given = latest;
      latest.flags = 0;
      return given;
    }
    app::OperatorOrder latest;
  };
  Linked operator_link;
  std::vector<TickRecord> shadow_records;
  ShadowLoop shadow{params, [this](const TickRecord& record, const State&, const Outputs&) {
                      shadow_records.push_back(record);
                    }};
  LockstepServer server{params, twin, hooks()};
  ServedCan wire{server};
  struct Patient {
    bool operator()() const { return true; }
  };
  app::LockstepCan<ServedCan, Patient> bus{wire, {}};
};

TEST_F(CanLoop, RecordsTheSameBitsWhereverItsTwinIs) {
  const std::vector<TickRecord> expected = records_here(params);
  const std::vector<TickRecord> records = records_at_the_end_of_a_bus();
  expect_same(records, expected);
  expect_shadowed(records);
  std::uint32_t seen = 0;
  for (const TickRecord& each : expected) seen |= each.inputs.fresh;
  EXPECT_EQ(seen, 0x7Fu) << "seven drives";
  EXPECT_NE((expected.back().inputs.flags & kImuFresh), 0);
  EXPECT_LT(server.counters().polls, 12 * kTicks + 2000) << "a few answers a tick, not one a frame";
}

TEST_F(CanLoop, RecordsTheSameBitsOverABusThatLosesAnswers) {
  wire.inbound = {.lost = 0.01, .doubled = 0.01};
  const std::vector<TickRecord> records = records_at_the_end_of_a_bus();
  expect_same(records, records_here(params));
  expect_shadowed(records);
  EXPECT_GT(wire.faults, 100u);
}

TEST_F(CanLoop, IsKnownBitByBitThoughItsFramesAreLost) {
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  auto loop = std::make_unique<app::App<decltype(bus), Linked, Linked>>(params, bus, operator_link,
                                                                        operator_link);
  ASSERT_EQ(loop->bring_up().status, app::BringUpStatus::kReady);
  wire.outbound = {.lost = 0.004, .doubled = 0.004, .swapped = 0.1};
  for (int i = 0; i < kTicks; ++i) loop->tick();
  EXPECT_GT(bus.counters().damaged, 10u);
  expect_shadowed(operator_link.records);
}

TEST_F(CanLoop, IsKnownBitByBitThoughBeginningsOfTicksAreLost) {
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  auto loop = std::make_unique<app::App<decltype(bus), Linked, Linked>>(params, bus, operator_link,
                                                                        operator_link);
  ASSERT_EQ(loop->bring_up().status, app::BringUpStatus::kReady);
  for (int i = 0; i < kTicks; ++i) {
    if (i % 40 == 20) wire.lost_beginnings = i % 80 == 20 ? 1 : 2;
    loop->tick();
  }
  EXPECT_EQ(wire.faults, 10u);
  expect_shadowed(operator_link.records);
}

TEST_F(CanLoop, FramesOfAnotherControllerAreNoticed) {
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  test::Walker walker;
  auto loop = std::make_unique<app::App<decltype(bus), test::Walker, test::Walker>>(params, bus,
                                                                                    walker, walker);
  ASSERT_EQ(loop->bring_up().status, app::BringUpStatus::kReady);
  for (int i = 0; i < 50; ++i) {
    loop->tick();
    if (i == 30) loop->limit_torque(50);
  }
  EXPECT_NE(shadow.difference().find("in tick "), std::string::npos) << shadow.difference();
}

}  // namespace
}  // namespace verp::can
