#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "common/model/image.hpp"
#include "firmware/app/app.hpp"
#include "firmware/app/lockstep_bus.hpp"
#include "host/twin/bus/shadow_loop.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/host/bus/lockstep_pair.hpp"
#include "tests/host/bus/walker.hpp"

namespace verp {
namespace {

struct Port {
  app::OperatorOrder order(std::uint32_t) {
    const app::OperatorOrder order = next;
    next.flags = 0;
    return order;
  }
  void record(const TickRecord& record, const State&, const Outputs&) { records.push_back(record); }
  app::OperatorOrder next;
  std::vector<TickRecord> records;
};

bool same(const std::vector<TickRecord>& a, const std::vector<TickRecord>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(&a[i], &b[i], sizeof(TickRecord)) != 0) return false;
  }
  return true;
}

constexpr int kTicks = 300;

std::vector<TickRecord> records_here(const Params& params) {
  test::FakePlant plant;
  bus::VirtualBus bus(params, plant);
  test::Walker walker;
  app::App<bus::VirtualBus, test::Walker, test::Walker> loop(params, bus, walker, walker);
  loop.bring_up();
  for (int i = 0; i < kTicks; ++i) loop.tick();
  return walker.records;
}

class Lockstep : public ::testing::Test {
 protected:
  using Bus = app::LockstepBus<test::ServedLink, test::Waiting&>;
  using Loop = app::App<Bus, Port, Port>;

  void run(int ticks = kTicks) {
    ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
    ASSERT_EQ(loop.bring_up().status, app::BringUpStatus::kReady);
    for (int i = 0; i < ticks; ++i) loop.tick();
    std::uint8_t none[1];
    ending = true;
    // This ends the last tick.
    const std::uint8_t ids[] = {1, 2};
    std::uint8_t frame[32];
    const std::size_t size = dxl::encode_sync_read(frame, sizeof frame, dxl::Instruction::kSyncRead,
                                                   dxl::address::kPresentPosition, 4, ids, 2);
    while (!bus.stopped()) {
      bus.send(frame, size);
      bus.poll(none, sizeof none, 100);
    }
  }

  bus::LockstepHooks hooks() {
    bus::LockstepHooks hooks;
    hooks.tick_ends = [this] {
      shadow.catch_up();
      return !ending;
    };
    hooks.tick_begins = [this](std::uint32_t tick) {
      port.next = test::Walker{}.order(tick);
      shadow.ordered(port.next);
    };
    hooks.sent = [this](auto frame) { shadow.sent({frame.begin(), frame.end()}); };
    hooks.damaged = [this] { shadow.damaged(); };
    hooks.polled = [this](auto bytes, std::uint64_t now_us) {
      shadow.polled({bytes.begin(), bytes.end()}, now_us);
    };
    hooks.refused = [this](const std::string& why) { refusal = why; };
    return hooks;
  }

  Params params = test::bus_params(2);
  test::FakePlant plant;
  bus::VirtualBus twin{params, plant};
  std::vector<TickRecord> shadow_records;
  bus::ShadowLoop shadow{params, [this](const TickRecord& record, const State&, const Outputs&) {
                           shadow_records.push_back(record);
                         }};
  bool ending = false;
  std::string refusal;
  Port port;
  bus::LockstepServer server{params, twin, hooks()};
  test::ServedLink link{server};
  test::Waiting waiting{&link};
  Bus bus{link, waiting};
  Loop loop{params, bus, port, port};
};

TEST_F(Lockstep, RecordsWhatTheLoopInThisProcessRecords) {
  run();
  EXPECT_TRUE(same(port.records, records_here(params)));
  EXPECT_TRUE(same(shadow_records, port.records));
  EXPECT_EQ(shadow.difference(), "");
  EXPECT_EQ(server.counters().repeats + bus.counters().repeats, 0u);
}

TEST(SetUpright, IsARegisterOfTheTwinsClock) {
  const Params params = test::bus_params(2);
  test::FakePlant plant;
  bus::VirtualBus twin(params, plant);
  int asked = 0;
  bool limp = true;
  bus::LockstepHooks hooks;
  hooks.set_upright = [&] { return ++asked, limp; };
  bus::LockstepServer server(params, twin, hooks);
  const auto error_of = [&](std::uint8_t value) {
    std::uint8_t frame[32];
    const std::size_t size = dxl::encode_write(frame, sizeof frame, lockstep::kClockId,
                                               lockstep::kSetUprightAddress, &value, 1);
    std::vector<std::uint8_t> answer;
    server.take({frame, size}, answer);
    dxl::Parser parser;
    for (const std::uint8_t byte : answer) {
      if (parser.push(byte)) return static_cast<dxl::Error>(parser.packet().error);
    }
    return dxl::Error::kCrc;
  };
  EXPECT_EQ(error_of(1), dxl::Error::kNone);
  EXPECT_EQ(error_of(0), dxl::Error::kDataRange);
  EXPECT_EQ(asked, 1);
  limp = false;
  EXPECT_EQ(error_of(1), dxl::Error::kResultFail);
}

TEST_F(Lockstep, MakesGoodWhatTheLinkSpoilsOnTheWayToTheController) {
  const std::vector<TickRecord> expected = records_here(params);
  link.inbound = {.lost = 0.002, .doubled = 0.002, .flipped = 0.002};
  run();
  EXPECT_TRUE(same(port.records, expected));
  EXPECT_GT(link.faults, 100u);
  EXPECT_GT(bus.counters().spoilt, 50u);
  EXPECT_EQ(bus.counters().damaged, 0u);
  EXPECT_LE(server.counters().repeats, bus.counters().repeats);
}

TEST_F(Lockstep, LetsADamagedFrameBeLostOnTheBus) {
  link.outbound = {.lost = 0.001, .doubled = 0.001, .flipped = 0.001};
  run();
  EXPECT_EQ(port.records.size(), static_cast<std::size_t>(kTicks));
  EXPECT_GT(bus.counters().damaged, 20u);
  EXPECT_EQ(bus.counters().damaged, server.counters().damaged);
  EXPECT_GT(loop.counters().timeouts, 0u);
  EXPECT_EQ(shadow.difference(), "");
  shadow_records.resize(port.records.size());  // one more tick may have ended
  EXPECT_TRUE(same(shadow_records, port.records));
}

TEST_F(Lockstep, NeverHangsOnAVeryBadLink) {
  link.outbound = link.inbound = {.lost = 0.01, .doubled = 0.01, .flipped = 0.01};
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  loop.bring_up();  // a request may reach no servo
  std::uint64_t before_us = bus.now_us();
  for (int i = 0; i < 100; ++i) {
    loop.tick();
    ASSERT_GE(bus.now_us(), before_us);
    ASSERT_LT(bus.now_us() - before_us, 4 * params.period_us);
    before_us = bus.now_us();
  }
  EXPECT_FALSE(bus.lost());
  EXPECT_GT(link.faults, 500u);
}

TEST_F(Lockstep, WaitsOutACutLinkWithoutASingleTimeout) {
  const std::vector<TickRecord> expected = records_here(params);
  link.cut_every = 37;
  run();
  EXPECT_TRUE(same(port.records, expected));
  EXPECT_EQ(loop.counters().timeouts, 0u);
  EXPECT_GT(server.counters().repeats, 10u);
}

TEST_F(Lockstep, EndsTheTickWithATwinThatHungUpBehindItsStop) {
  run(5);
  ASSERT_TRUE(bus.stopped());
  ASSERT_FALSE(bus.lost());
  link.outbound.lost = 1;
  waiting.mends = false;
  waiting.most = waiting.calls + 1000;
  loop.tick();
  EXPECT_LT(waiting.calls, waiting.most) << "it waited for somebody who is gone";
  EXPECT_TRUE(bus.stopped());
}

TEST_F(Lockstep, GivesUpWhenItsIdleHookSaysSo) {
  ASSERT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
  link.cut = true;
  waiting.mends = false;
  waiting.most = waiting.calls + 5000;
  std::uint8_t byte[1];
  EXPECT_EQ(bus.poll(byte, 1, 100), 0u);
  EXPECT_TRUE(bus.lost());
  EXPECT_TRUE(bus.stopped());
  EXPECT_EQ(waiting.calls, waiting.most);
}

TEST_F(Lockstep, IsLostWhenTheTwinBeganAnew) {
  run(5);
  bus::LockstepServer fresh(params, twin, {});
  std::vector<std::uint8_t> answer;
  const lockstep::Advance advance{.sequence = 9, .capacity = 10, .timeout_us = 1000};
  std::uint8_t request[lockstep::kMaxClockPacket];
  const std::size_t size =
      dxl::encode_write(request, sizeof request, lockstep::kClockId, lockstep::kAdvanceAddress,
                        reinterpret_cast<const std::uint8_t*>(&advance), sizeof advance);
  fresh.take({request, size}, answer);
  link.whisper(answer);
  std::uint8_t byte[1];
  EXPECT_FALSE(bus.lost());
  EXPECT_EQ(bus.poll(byte, 1, 100), 0u);
  EXPECT_TRUE(bus.lost());
}

TEST_F(Lockstep, RefusesOtherParamsByName) {
  Params other = params;
  other.joint[1].servo_id += 1;
  EXPECT_EQ(bus.greet(other), lockstep::Verdict::kOtherRobot);
  EXPECT_TRUE(bus.lost());
  EXPECT_NE(refusal.find("Params"), std::string::npos) << refusal;
  EXPECT_FALSE(server.greeted());
  EXPECT_EQ(bus.greet(params), lockstep::Verdict::kAccepted);
}

// A third-party controller has no core version.
TEST_F(Lockstep, MeetsAStrangerWhereNobodyComparesBits) {
  const lockstep::Hello stranger;
  const auto verdict = [&] {
    std::uint8_t frame[lockstep::kMaxClockPacket];
    const std::size_t size =
        dxl::encode_write(frame, sizeof frame, lockstep::kClockId, lockstep::kHelloAddress,
                          reinterpret_cast<const std::uint8_t*>(&stranger), sizeof stranger);
    std::vector<std::uint8_t> answer;
    server.take({frame, size}, answer);
    return static_cast<lockstep::Verdict>(answer.at(dxl::kHeaderBytes + 3));
  };
  EXPECT_EQ(verdict(), lockstep::Verdict::kOtherLayout);
  server.welcome_strangers();
  EXPECT_EQ(verdict(), lockstep::Verdict::kAccepted);
}

// One core version stands for one digest (tests/golden/core_versions.txt).
TEST_F(Lockstep, RefusesAnotherCoreByName) {
  lockstep::Hello theirs{.core_version = kCoreVersion,
                         .params_size = sizeof(Params),
                         .params_crc = params_crc(params),
                         .record_size = sizeof(TickRecord),
                         .state_size = sizeof(State)};
  EXPECT_EQ(bus::verdict_on(theirs, params), lockstep::Verdict::kAccepted);
  theirs.core_version = kCoreVersion - 1;
  EXPECT_EQ(bus::verdict_on(theirs, params), lockstep::Verdict::kOtherCore);
  const std::string words = bus::words_for(lockstep::Verdict::kOtherCore, theirs, params);
  for (const std::uint32_t version : {kCoreVersion, kCoreVersion - 1}) {
    EXPECT_NE(words.find(std::to_string(version)), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace verp
