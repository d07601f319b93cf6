#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/lockstep_can.hpp"
#include "host/twin/can/lockstep_server.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/host/can/served_can.hpp"

namespace verp::can {
namespace {

namespace plan = canopen::plan;

CanFrame sync_frame(std::uint8_t counter) {
  CanFrame frame = canopen::classic_frame(canopen::kSyncId, 1);
  frame.data[0] = counter;
  return frame;
}

struct Heard {
  CanFrame frame;
  bool any = false;
  std::uint64_t now_us = 0;
  bool operator==(const Heard& other) const {
    return any == other.any && now_us == other.now_us && (!any || frame == other.frame);
  }
};

constexpr int kTicks = 200;

template <std::derived_from<hal::CanBus> Bus>
std::vector<Heard> drive(const Params& params, Bus& bus) {
  constexpr std::uint32_t kTimeout_us = 700;
  std::vector<Heard> heard;
  const auto listen = [&] {
    Heard each;
    do {
      each = Heard{};
      each.any = bus.poll(each.frame, kTimeout_us);
      each.now_us = bus.now_us();
      heard.push_back(each);
    } while (each.any);
  };
  bus.send(canopen::nmt_frame(canopen::NmtCommand::kStart, 0));
  listen();
  for (int tick = 0; tick < kTicks; ++tick) {
    for (int f = 0; f < plan::shared_frames(plan::kGoals, params); ++f) {
      CanFrame goals = canopen::classic_frame(plan::shared_id(plan::kGoals, params, f), 8);
      canopen::put_le(goals.data, static_cast<std::uint64_t>(tick + f), 4);
      bus.send(goals);
    }
    bus.send(sync_frame(1));
    listen();
    CanFrame ask = canopen::classic_frame(canopen::sdo_request_id(params.joint[0].servo_id), 8);
    ask.data[0] = 0x40;
    canopen::put_le(ask.data + 1, 0x6041, 2);
    bus.send(ask);
    bus.send(sync_frame(2));
    listen();
  }
  return heard;
}

struct Patient {
  int* left;
  bool operator()() const { return --*left > 0; }
};

class CanLockstep : public ::testing::Test {
 protected:
  using Bus = app::LockstepCan<ServedCan, Patient>;

  std::vector<Heard> here() const {
    test::FakePlant other;
    VirtualCan direct(params, other);
    return drive(params, direct);
  }
  LockstepHooks hooks() {
    LockstepHooks hooks;
    hooks.tick_ends = [this] { return ++ends <= most_ticks; };
    hooks.tick_begins = [this](std::uint32_t tick) { begun.push_back(tick); };
    hooks.refused = [this](const std::string& why) { refusal = why; };
    return hooks;
  }

  Params params = test::bus_params(5);
  test::FakePlant plant;
  VirtualCan twin{params, plant};
  int ends = 0, most_ticks = 1 << 30;
  std::vector<std::uint32_t> begun;
  std::string refusal;
  LockstepServer server{params, twin, hooks()};
  ServedCan wire{server};
  int patience = 1 << 20;
  Bus bus{wire, Patient{&patience}};
};

TEST_F(CanLockstep, BringsWhatABusInThisProcessBrings) {
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  const std::vector<Heard> heard = drive(params, bus);
  EXPECT_GT(heard.size(), std::size_t{5 * kTicks});
  EXPECT_TRUE(heard == here());
  EXPECT_EQ(begun.size(), std::size_t{kTicks});
  EXPECT_EQ(bus.counters().repeats + bus.counters().damaged, 0u);
  EXPECT_LT(server.counters().polls, heard.size() * 2 / 3)
      << "a burst takes one answer: " << heard.size();
}

TEST_F(CanLockstep, MakesGoodWhatIsLostOrDoubledOnTheWayToTheController) {
  wire.inbound = {.lost = 0.02, .doubled = 0.02};
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  EXPECT_TRUE(drive(params, bus) == here());
  EXPECT_GT(wire.faults, 50u);
  EXPECT_GT(bus.counters().repeats, 20u);
  EXPECT_EQ(bus.counters().damaged, 0u);
}

// Priorities differ, so SYNC may overtake.
TEST_F(CanLockstep, TakesNoHarmFromAnotherOrderOnTheWay) {
  wire.outbound = {.swapped = 0.5};
  wire.inbound = {.swapped = 0};
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  EXPECT_TRUE(drive(params, bus) == here());
  EXPECT_GT(wire.faults, 200u);
  EXPECT_EQ(bus.counters().damaged, 0u);
}

TEST(CanSetUpright, IsAMessageOfTheTwinsClock) {
  const Params params = test::bus_params(2);
  test::FakePlant plant;
  VirtualCan twin(params, plant);
  bool limp = true;
  LockstepHooks hooks;
  hooks.set_upright = [&] { return limp; };
  LockstepServer server(params, twin, hooks);
  for (const bool each : {true, false}) {
    limp = each;
    std::vector<CanFrame> answer;
    server.take(lockstep::can_message(lockstep::kCanSetUprightId, std::uint8_t{1}), answer);
    std::uint8_t result = 9;
    ASSERT_EQ(answer.size(), 1u);
    ASSERT_TRUE(lockstep::take_message(answer[0], lockstep::kCanSetUprightReplyId, result));
    EXPECT_EQ(result, each ? 0 : 1);
  }
  EXPECT_TRUE(server.unannounced().empty()) << "no frame of the robot's bus";
}

TEST_F(CanLockstep, AnAnswerFitsAnSja1000) {
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  wire.most_room = 0;
  drive(params, bus);
  EXPECT_GT(wire.most_room, std::size_t{13 + 3 + 8}) << "some answers bring more than one frame";
  EXPECT_LE(wire.most_room, 64u);
}

TEST_F(CanLockstep, AnAnswerFitsAnSja1000WithARequestToTheController) {
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  wire.most_room = 0;
  wire.requests = 300;
  EXPECT_TRUE(drive(params, bus) == here());
  EXPECT_EQ(wire.requests_heard, 300u);
  EXPECT_GT(wire.most_room, std::size_t{13 + 3 + 8 + 3 + 8});
  EXPECT_LE(wire.most_room, 64u);
}

TEST_F(CanLockstep, KeepsNoRequestsForAControllerThatIsGone) {
  const CanFrame asked = canopen::classic_frame(canopen::sdo_request_id(plan::kControllerNode), 8);
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  for (int i = 0; i < 1000; ++i) server.enclose(asked);
  drive(params, bus);
  EXPECT_EQ(wire.requests_heard, 4u);
  server.enclose(asked);
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  drive(params, bus);
  EXPECT_EQ(wire.requests_heard, 4u);
}

TEST_F(CanLockstep, LetsALostFrameBeLostOnTheBus) {
  wire.outbound = {.lost = 0.01, .doubled = 0.01};
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  drive(params, bus);
  EXPECT_GT(bus.counters().damaged, 5u);
  EXPECT_EQ(bus.counters().damaged, server.counters().damaged);
  EXPECT_FALSE(bus.lost());
}

TEST_F(CanLockstep, IgnoresWhatOthersSay) {
  wire.outbound = {.foreign = 0.1};
  wire.inbound = {.foreign = 0.1};
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  EXPECT_TRUE(drive(params, bus) == here());
  EXPECT_GT(wire.strangers, 200u);
  EXPECT_EQ(bus.counters().damaged, 0u);
  EXPECT_EQ(server.counters().damaged, 0u);
}

TEST_F(CanLockstep, IsRefusedOnceTimeGoesOnByItself) {
  server.refuse_lockstep();
  EXPECT_EQ(bus.greet(params), lockstep::Verdict::kNoLockstep);
  EXPECT_NE(refusal.find("real time"), std::string::npos) << refusal;
}

TEST_F(CanLockstep, RefusesAnotherRobotByName) {
  Params other = params;
  other.period_us = 8000;
  EXPECT_EQ(bus.greet(other), lockstep::Verdict::kOtherRobot);
  EXPECT_TRUE(bus.lost());
  EXPECT_FALSE(bus.send(sync_frame(1)));
  EXPECT_NE(refusal.find("Params"), std::string::npos);
}

TEST_F(CanLockstep, AControllerMayBeginAnew) {
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  drive(params, bus);
  Bus second{wire, Patient{&patience}};
  ASSERT_EQ(second.greet(params), lockstep::Verdict::kAccepted);
  EXPECT_EQ(server.counters().greetings, 2u);
  CanFrame frame;
  second.send(sync_frame(1));
  EXPECT_TRUE(second.poll(frame, 1000));
  EXPECT_GT(second.now_us(), std::uint64_t{kTicks} * params.period_us) << "the twin's time goes on";
}

TEST_F(CanLockstep, StopsWhenTheTwinWantsNoFurtherTick) {
  most_ticks = 50;
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  drive(params, bus);
  EXPECT_TRUE(bus.stopped());
  EXPECT_FALSE(bus.lost());
  EXPECT_EQ(begun.size(), 50u);
}

TEST_F(CanLockstep, ASilentTwinIsGivenUpWhenIdleSaysSo) {
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  wire.cut = true;
  patience = 1000;
  CanFrame frame;
  bus.send(sync_frame(1));
  EXPECT_FALSE(bus.poll(frame, 1000));
  EXPECT_TRUE(bus.lost());
  EXPECT_GT(bus.counters().repeats, 2u) << "it asked again";
  EXPECT_LE(patience, 0);
}

}  // namespace
}  // namespace verp::can
