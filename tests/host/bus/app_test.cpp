#include "firmware/app/app.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "host/bus/virtual_bus.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp {
namespace {

Outputs wanted;  // what the step() of this test asks for

}  // namespace

// Stands in for the core's step() at link time: the loop is tested without a robot's mind.
void step(const Params&, State& state, const Inputs&, Outputs& outputs) noexcept {
  ++state.digest.chain;
  outputs = wanted;
}

namespace {

struct Script {
  app::OperatorOrder order(std::uint32_t tick) {
    asked.push_back(tick);
    return next;
  }
  app::OperatorOrder next;
  std::vector<std::uint32_t> asked;
};

struct Memory {
  void record(const TickRecord& record, const State&, const Outputs&) { records.push_back(record); }
  std::vector<TickRecord> records;
};

/// Passes frames on and lets a test lose, hear or add some.
struct Tap {
  bool send(const std::uint8_t* data, std::size_t size) {
    frames.emplace_back(data, data + size);
    if (lose_sends > 0 && --lose_sends >= 0) return true;
    return bus.send(data, size);
  }
  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) {
    ++polls;
    std::size_t kept = 0;
    const std::size_t count = bus.poll(buffer, capacity, timeout_us);
    for (std::size_t i = 0; i < count; ++i) {
      const auto fault = faults_per_mille == 0 ? 1000 : noise() % 1000;
      if (fault < faults_per_mille / 2) continue;
      buffer[kept++] = fault < faults_per_mille ? static_cast<std::uint8_t>(noise()) : buffer[i];
    }
    return kept;
  }
  std::uint64_t now_us() { return bus.now_us(); }
  bus::VirtualBus& bus;
  std::vector<std::vector<std::uint8_t>> frames;
  int lose_sends = 0;
  int polls = 0;
  unsigned faults_per_mille = 0;  ///< of received bytes: half are lost, half are changed
  std::minstd_rand noise{};
};

class AppLoop : public ::testing::Test {
 protected:
  static constexpr int kJoints = 21;
  AppLoop() {
    wanted = {};
    for (int j = 0; j < kJoints; ++j) wanted.goal_count[j] = 1000 + j;
  }
  void ready() { ASSERT_EQ(app.bring_up().status, app::BringUpStatus::kReady); }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) app.tick();
  }
  static std::uint32_t all() { return (1u << kJoints) - 1; }
  static std::uint32_t without(int joint) { return all() & ~(1u << joint); }
  int frames_of(dxl::Instruction instruction) const {
    int count = 0;
    for (const auto& frame : tap.frames) count += frame[7] == static_cast<int>(instruction);
    return count;
  }

  Params params = test::bus_params(kJoints);
  test::FakePlant plant;
  bus::VirtualBus bus{params, plant};
  Tap tap{bus, {}};
  Script script;
  Memory memory;
  app::App<Tap, Script, Memory> app{params, tap, script, memory};
};

TEST_F(AppLoop, BringUpLeavesEveryServoAsParamsSayWithTorqueOff) {
  ready();
  for (int j = 0; j < kJoints; ++j) {
    EXPECT_FALSE(plant.setpoint(j).torque_on);
    EXPECT_EQ(plant.setpoint(j).p_gain, 3500);
    EXPECT_EQ(plant.setpoint(j).i_gain, 10);
    EXPECT_EQ(plant.setpoint(j).d_gain, 20);
    EXPECT_EQ(plant.setpoint(j).profile_ms, 10u);
  }
}

TEST_F(AppLoop, BringUpWritesEepromOnlyOnce) {
  ready();
  const int writes = frames_of(dxl::Instruction::kWrite);
  tap.frames.clear();
  ready();
  EXPECT_GT(writes, 4 * kJoints);
  EXPECT_EQ(frames_of(dxl::Instruction::kWrite), kJoints) << "torque off, and nothing else";
}

TEST_F(AppLoop, BringUpNamesASilentDevice) {
  bus.set_connected(7, false);
  const app::BringUpReport report = app.bring_up();
  EXPECT_EQ(report.status, app::BringUpStatus::kSilent);
  EXPECT_EQ(report.device_id, 7);
}

TEST_F(AppLoop, BringUpNamesAWrongModel) {
  Params other = params;
  other.servo[0].model_number = dxl::kModelMx28;
  app::App<Tap, Script, Memory> stranger{other, tap, script, memory};
  const app::BringUpReport report = stranger.bring_up();
  EXPECT_EQ(report.status, app::BringUpStatus::kWrongModel);
  EXPECT_EQ(report.device_id, 1);
  EXPECT_EQ(report.expected, dxl::kModelMx28);
  EXPECT_EQ(report.found, dxl::kModelXm430W210);
}

TEST_F(AppLoop, BringUpSurvivesALostFrame) {
  tap.lose_sends = 1;
  ready();
}

TEST_F(AppLoop, ATickBringsEveryValueFresh) {
  ready();
  for (int j = 0; j < kJoints; ++j) {
    plant.measured[static_cast<std::size_t>(j)].position_count = 2000 - 100 * j;
  }
  ticks(1);
  const Inputs& inputs = app.inputs();
  EXPECT_EQ(inputs.fresh, all());
  EXPECT_EQ(inputs.flags, kImuFresh | kFeetFresh | kSlowFresh);
  for (int j = 0; j < kJoints; ++j) EXPECT_EQ(inputs.position_count[j], 2000 - 100 * j);
  EXPECT_EQ(inputs.gyro_count[1], -2);
  EXPECT_EQ(inputs.accel_count[2], 4096);
  EXPECT_EQ(inputs.foot_count[0][3], 103);
  EXPECT_EQ(inputs.foot_count[1][0], 200);
  EXPECT_EQ(inputs.slow_voltage_tenth_v, 120);
  EXPECT_EQ(inputs.slow_temperature_c, 25);
}

TEST_F(AppLoop, OneTickIsOnePeriodOfBusTime) {
  ready();
  ticks(1);
  const std::uint64_t first_us = bus.now_us();
  ticks(100);
  EXPECT_EQ(bus.now_us() - first_us, 100u * params.period_us);
  EXPECT_EQ(app.inputs().tick, 100u);
  EXPECT_EQ(bus.tick(), 100u);
  ASSERT_EQ(memory.records.size(), 101u);
  ASSERT_EQ(script.asked.size(), 101u);
  for (std::uint32_t tick = 0; tick < 101; ++tick) {
    EXPECT_EQ(script.asked[tick], tick);
    EXPECT_EQ(memory.records[tick].inputs.tick, tick);
    EXPECT_EQ(memory.records[tick].digest.chain, record::kChainSeed + tick + 1);
  }
}

TEST_F(AppLoop, ATickNeedsTwoPollsAndFourFrames) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  tap.frames.clear();
  tap.polls = 0;
  ticks(10);
  EXPECT_EQ(tap.polls, 20);
  EXPECT_EQ(tap.frames.size(), 40u);
}

TEST_F(AppLoop, StaysInsideItsSchedule) {
  ready();
  wanted.torque_enable = all();
  ticks(2);
  const std::uint64_t before = bus.bytes_on_wire();
  ticks(1);
  EXPECT_LE(bus.bytes_on_wire() - before, app::schedule_bytes(params));
  EXPECT_LE(app::schedule_us(params), params.period_us * 8 / 10);
}

TEST_F(AppLoop, GoalsArriveBeforeTorqueAndOnlyWhereTorqueIsWanted) {
  ready();
  ticks(1);
  EXPECT_EQ(plant.setpoint(0).goal_count, 0);
  wanted.torque_enable = 0b101;
  tap.frames.clear();
  ticks(1);
  ASSERT_GE(tap.frames.size(), 2u);
  EXPECT_EQ(tap.frames[tap.frames.size() - 2][8], dxl::address::kGoalPosition);
  EXPECT_EQ(tap.frames.back()[8], dxl::address::kTorqueEnable);
  EXPECT_TRUE(plant.setpoint(0).torque_on);
  EXPECT_EQ(plant.setpoint(0).goal_count, 1000);
  EXPECT_FALSE(plant.setpoint(1).torque_on);
  EXPECT_EQ(plant.setpoint(1).goal_count, 0);
  EXPECT_TRUE(plant.setpoint(2).torque_on);
  ticks(1);
  EXPECT_EQ(app.inputs().position_count[2], 1002);
}

TEST_F(AppLoop, NothingIsSentToJointsBeyondTheRobots) {
  ready();
  wanted.torque_enable = ~0u;
  tap.frames.clear();
  ticks(1);
  for (const auto& frame : tap.frames) {
    if (frame[7] == 0x83 && frame[8] == dxl::address::kGoalPosition) {
      EXPECT_EQ(frame.size(), app::sync_write_bytes(kJoints, 4));
    }
  }
}

TEST_F(AppLoop, ALostTorqueFrameIsMadeGood) {
  ready();
  ticks(5);
  wanted.torque_enable = all();
  ticks(5);
  wanted.torque_enable = 0;
  tap.lose_sends = 3;  // both reads and the frame that takes the torque away
  ticks(1);
  EXPECT_TRUE(plant.setpoint(0).torque_on);
  ticks(2);
  for (int j = 0; j < kJoints; ++j) EXPECT_FALSE(plant.setpoint(j).torque_on);
}

TEST_F(AppLoop, ASilentServoGoesStaleAloneAndCostsNoTick) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  bus.set_connected(6, false);
  ticks(3);
  EXPECT_EQ(app.inputs().fresh, without(5));
  EXPECT_EQ(app.inputs().position_count[5], 1005) << "keeps the last value";
  const std::uint32_t tick = app.inputs().tick;
  ticks(50);
  EXPECT_EQ(app.inputs().fresh, without(5));
  EXPECT_EQ(app.inputs().tick, tick + 50);
  EXPECT_EQ(app.inputs().flags & kOverrun, 0);
  bus.set_connected(6, true);
  ticks(2);
  EXPECT_EQ(app.inputs().fresh, all());
}

TEST_F(AppLoop, ASilentImuIsReportedStale) {
  ready();
  bus.set_connected(test::kImuId, false);
  ticks(3);
  EXPECT_EQ(app.inputs().flags & kImuFresh, 0);
  EXPECT_NE(app.inputs().flags & kFeetFresh, 0);
  EXPECT_EQ(app.inputs().fresh, all());
}

TEST_F(AppLoop, ADeadBusNeverHangsTheLoop) {
  ready();
  for (int id = 0; id < 253; ++id) bus.set_connected(static_cast<std::uint8_t>(id), false);
  ticks(100);
  EXPECT_EQ(app.inputs().fresh, 0u);
  EXPECT_EQ(app.inputs().flags & (kImuFresh | kFeetFresh | kSlowFresh), 0);
  EXPECT_EQ(app.inputs().tick, 99u);
  EXPECT_EQ(app.counters().timeouts, 200u);
}

TEST_F(AppLoop, ServosWithoutFastSyncReadAreReadOneByOne) {
  Params plain = test::bus_params(kJoints, false);
  plain.servo[0].model_number = dxl::kModelMx28;
  test::FakePlant mx_plant;
  bus::VirtualBus mx(plain, mx_plant);
  Tap mx_tap{mx, {}};
  app::App<Tap, Script, Memory> mx_app{plain, mx_tap, script, memory};
  ASSERT_EQ(mx_app.bring_up().status, app::BringUpStatus::kReady);
  for (int i = 0; i < 3; ++i) mx_app.tick();
  EXPECT_EQ(mx_app.inputs().fresh, all());
}

TEST_F(AppLoop, EveryServosHealthComesInTurn) {
  ready();
  std::uint32_t seen = 0;
  for (int i = 0; i < kJoints; ++i) {
    ticks(1);
    seen |= 1u << app.inputs().slow_joint;
  }
  EXPECT_EQ(seen, all());
}

TEST_F(AppLoop, AnAlertIsLookedUp) {
  ready();
  plant.measured[3].temperature_c = 90;
  for (int i = 0; i < kJoints; ++i) {
    ticks(1);
    EXPECT_EQ(app.inputs().slow_error, app.inputs().slow_joint == 3 ? dxl::kOverheatingError : 0);
    EXPECT_NE(app.inputs().flags & kSlowFresh, 0);
  }
}

TEST_F(AppLoop, TheOperatorsOrderReachesTheTickItWasGivenFor) {
  ready();
  script.next.command.request = Request::kWalk;
  script.next.command.vx_tenth_mm_s = 1730;
  script.next.flags = kCommandFresh | kEmergencyStop | kImuFresh | kOverrun;
  script.next.parameter_id = 3;
  bus.set_connected(test::kImuId, false);
  ticks(1);
  EXPECT_EQ(app.inputs().command.vx_tenth_mm_s, 1730);
  EXPECT_EQ(app.inputs().parameter_id, 3);
  EXPECT_EQ(app.inputs().flags & ~kSlowFresh & ~kFeetFresh, kCommandFresh | kEmergencyStop)
      << "an operator can't claim a fresh IMU";
}

TEST_F(AppLoop, AMissedPeriodIsSkippedAndReported) {
  ready();
  ticks(3);
  std::uint8_t byte = 0;
  bus.poll(&byte, 1, 2 * params.period_us);  // something else held the bus
  ticks(1);
  EXPECT_EQ(app.inputs().tick, 5u) << "ticks 3 and 4 had no time";
  EXPECT_EQ(bus.tick(), 5u);
  EXPECT_NE(app.inputs().flags & kOverrun, 0);
  ticks(1);
  EXPECT_EQ(app.inputs().flags & kOverrun, 0);
}

// Lost and changed bytes make values stale; none ever becomes a position, and none costs the loop
// its time.
TEST_F(AppLoop, NoiseMakesValuesStaleButNeverWrong) {
  ready();
  for (int j = 0; j < kJoints; ++j) {
    plant.measured[static_cast<std::size_t>(j)].position_count = 2000 - 100 * j;
  }
  tap.faults_per_mille = 5;
  constexpr int kTicks = 2000;
  int fresh = 0;
  for (int i = 0; i < kTicks; ++i) {
    ticks(1);
    for (int j = 0; j < kJoints; ++j) {
      if ((app.inputs().fresh >> j & 1) == 0) continue;
      ++fresh;
      ASSERT_EQ(app.inputs().position_count[j], 2000 - 100 * j);
    }
    if ((app.inputs().flags & kImuFresh) != 0) {
      ASSERT_EQ(app.inputs().accel_count[2], 4096);
    }
    ASSERT_EQ(app.inputs().flags & kOverrun, 0);
  }
  EXPECT_EQ(app.inputs().tick, static_cast<std::uint32_t>(kTicks - 1));
  EXPECT_GT(fresh, kTicks * kJoints / 3);
  EXPECT_GT(app.crc_errors(), 100u);
  tap.faults_per_mille = 0;
  ticks(2);
  EXPECT_EQ(app.inputs().fresh, all());
}

TEST_F(AppLoop, TheSameRunGivesTheSameRecords) {
  const auto run = [this] {
    test::FakePlant twin;
    bus::VirtualBus twin_bus(params, twin);
    Tap twin_tap{twin_bus, {}};
    Script operator_script;
    Memory records;
    app::App<Tap, Script, Memory> twin_app{params, twin_tap, operator_script, records};
    twin_app.bring_up();
    wanted.torque_enable = all();
    for (int i = 0; i < 30; ++i) twin_app.tick();
    return twin_tap.frames;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace verp
