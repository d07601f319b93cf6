#include "tests/host/bus/app_fixture.hpp"

namespace verp::test {
namespace {

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

std::int64_t read_i32(bus::VirtualBus& bus, int joint, std::uint16_t address) {
  std::uint8_t frame[dxl::kMaxPacket], reply[dxl::kMaxPacket];
  const auto id = static_cast<std::uint8_t>(joint + 1);
  bus.send(frame, dxl::encode_read(frame, sizeof frame, id, address, 4));
  const std::size_t count = bus.poll(reply, sizeof reply, 10'000);
  dxl::Parser parser;
  for (std::size_t i = 0; i < count; ++i) {
    if (parser.push(reply[i]))
      return static_cast<std::int32_t>(dxl::get_u32(parser.packet().parameters));
  }
  return INT64_MIN;
}

// The servo's limits hold even if the controller is silent or wrong.
TEST_F(AppLoop, BringUpWritesEachJointsLimitsIntoItsServo) {
  for (int j = 0; j < kJoints; ++j) {
    JointParams& joint = params.joint[j];
    joint.counts_per_rad = j % 2 == 0 ? 651.9F : -651.9F;  // mounted backwards
    joint.lower_rad = -0.1F * static_cast<float>(j + 1);
    joint.upper_rad = 0.5F;
  }
  ready();
  for (int j = 0; j < kJoints; ++j) {
    const JointParams& joint = params.joint[j];
    const std::int32_t a = model::count_of(joint, joint.lower_rad);
    const std::int32_t b = model::count_of(joint, joint.upper_rad);
    EXPECT_EQ(read_i32(bus, j, dxl::address::kMinPositionLimit), std::min(a, b) - 1);
    EXPECT_EQ(read_i32(bus, j, dxl::address::kMaxPositionLimit), std::max(a, b) + 1);
  }
}

TEST_F(AppLoop, LimitsBeyondTheTurnAreTheTurns) {
  params.joint[0].lower_rad = -9;
  params.joint[0].upper_rad = 9;
  ready();
  EXPECT_EQ(read_i32(bus, 0, dxl::address::kMinPositionLimit), 0);
  EXPECT_EQ(read_i32(bus, 0, dxl::address::kMaxPositionLimit), 4095);
}

TEST_F(AppLoop, BringUpWritesEepromOnlyOnce) {
  ready();
  const int writes = frames_of(dxl::Instruction::kWrite);
  tap.frames.clear();
  ready();
  EXPECT_GT(writes, 4 * kJoints);
  EXPECT_EQ(frames_of(dxl::Instruction::kWrite), 2 * kJoints)
      << "torque and Bus Watchdog off, and nothing else";
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
  ticks(4);  // the first three switch torque off
  const std::uint64_t first_us = bus.now_us();
  ticks(97);
  EXPECT_EQ(bus.now_us() - first_us, 97u * params.period_us);
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

TEST_F(AppLoop, ATickNeedsTwoPollsAndSixFrames) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  tap.frames.clear();
  tap.polls = 0;
  ticks(10);
  EXPECT_EQ(tap.polls, 20);
  EXPECT_EQ(tap.frames.size(), 60u);
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
  for (int tick = 0; tick < 2; ++tick) {
    ticks(1);
    EXPECT_EQ(plant.setpoint(0).goal_count, 1000);
    EXPECT_EQ(plant.setpoint(1).goal_count, 0);
    EXPECT_FALSE(plant.setpoint(0).torque_on) << "a frame before it may have been lost";
  }
  tap.frames.clear();
  ticks(1);
  ASSERT_GE(tap.frames.size(), 3u);
  EXPECT_EQ(tap.frames[tap.frames.size() - 3][8], dxl::address::kGoalPosition);
  EXPECT_EQ(tap.frames[tap.frames.size() - 2][8], dxl::address::kTorqueEnable);
  EXPECT_EQ(tap.frames.back()[8], dxl::address::kBusWatchdog);
  EXPECT_TRUE(plant.setpoint(0).torque_on);
  EXPECT_EQ(plant.setpoint(0).goal_count, 1000);
  EXPECT_FALSE(plant.setpoint(1).torque_on);
  EXPECT_EQ(plant.setpoint(1).goal_count, 0);
  EXPECT_TRUE(plant.setpoint(2).torque_on);
  ticks(1);
  EXPECT_EQ(app.inputs().position_count[2], 1002);
}

// The limp robot was moved; any two frames are lost.
TEST_F(AppLoop, LostFramesWakeNoServoWithOldOrders) {
  params.rise_torque_percent = 30;
  constexpr int kOld = 1000, kNew = 3000, kTicks = 8;
  const auto wake = [&](std::set<std::size_t> lost) {
    FakePlant twin;
    bus::VirtualBus twin_bus(params, twin);
    Tap twin_tap{twin_bus};
    Memory records;
    app::App<Tap, Script, Memory> loop{params, twin_tap, script, records};
    EXPECT_EQ(loop.bring_up().status, app::BringUpStatus::kReady);
    const auto run = [&](safety::Mode mode, std::uint32_t torque, int goal, int count) {
      wanted.mode = static_cast<std::uint8_t>(mode);
      wanted.torque_enable = torque;
      for (int j = 0; j < kJoints; ++j) wanted.goal_count[j] = goal;
      for (int tick = 0; tick < count; ++tick) {
        loop.tick();
        for (int j = 0; j < kJoints && goal == kNew; ++j) {
          if (!twin.setpoint(j).torque_on) continue;
          EXPECT_EQ(twin.setpoint(j).goal_count, kNew) << "joint " << j << ", tick " << tick;
          EXPECT_EQ(twin.setpoint(j).pwm_limit, dxl::kFullPwm * 30 / 100) << "joint " << j;
        }
      }
    };
    run(safety::Mode::kStanding, all(), kOld, 5);
    run(safety::Mode::kFallen, 0, kOld, 30);
    for (auto& joint : twin.measured) joint.position_count = kNew;
    twin_tap.frames.clear();
    twin_tap.lost = std::move(lost);
    run(safety::Mode::kRising, all(), kNew, kTicks);
    for (int j = 0; j < kJoints; ++j) EXPECT_TRUE(twin.setpoint(j).torque_on) << "joint " << j;
    return twin_tap.frames.size();
  };
  const std::size_t frames = wake({});
  ASSERT_GE(frames, kTicks * std::size_t{6});
  for (std::size_t one = 0; one < frames / 2; ++one) {
    for (std::size_t other = one; other < frames / 2; ++other) wake({one, other});
  }
}

// A servo refuses a Goal PWM above its PWM limit.
TEST_F(AppLoop, AServosOwnLimitIsItsFullStrength) {
  std::uint8_t frame[32];
  const std::uint8_t own[2] = {200, 0};
  bus.send(frame, dxl::encode_write(frame, sizeof frame, params.joint[1].servo_id,
                                    dxl::address::kPwmLimit, own, sizeof own));
  params.rise_torque_percent = 50;
  ready();
  wanted.torque_enable = 0b111;
  wanted.mode = static_cast<std::uint8_t>(safety::Mode::kRising);
  ticks(1);
  EXPECT_EQ(plant.setpoint(0).pwm_limit, dxl::kFullPwm / 2);
  EXPECT_EQ(plant.setpoint(1).pwm_limit, 100);
  wanted.mode = static_cast<std::uint8_t>(safety::Mode::kWalking);
  ticks(1);
  EXPECT_EQ(plant.setpoint(0).pwm_limit, dxl::kFullPwm);
  EXPECT_EQ(plant.setpoint(1).pwm_limit, 200);
}

TEST_F(AppLoop, TorqueIsLimitedInEveryModeIfSomebodySaysSo) {
  ready();
  app.limit_torque(30);
  wanted.torque_enable = all();
  for (int mode = 0; mode < safety::kModes; ++mode) {
    wanted.mode = static_cast<std::uint8_t>(mode);
    ticks(1);
    for (int j = 0; j < kJoints; ++j) {
      EXPECT_EQ(plant.setpoint(j).pwm_limit, dxl::kFullPwm * 30 / 100) << "mode " << mode;
    }
  }
}

TEST_F(AppLoop, ARiseIsTorqueLimitedFromBeforeTorqueUntilItsEnd) {
  params.rise_torque_percent = 40;
  ready();
  const auto rising = static_cast<std::uint8_t>(safety::Mode::kRising);
  const auto standing = static_cast<std::uint8_t>(safety::Mode::kStanding);
  constexpr std::uint16_t kLimited = dxl::kFullPwm * 40 / 100;
  wanted.torque_enable = 0b111;
  wanted.mode = rising;
  bool seen_torque = false;
  for (int tick = 0; tick < 30; ++tick) {
    ticks(1);
    for (int j = 0; j < kJoints; ++j) {
      if (!plant.setpoint(j).torque_on) continue;
      seen_torque = true;
      EXPECT_EQ(plant.setpoint(j).pwm_limit, kLimited) << "joint " << j << ", tick " << tick;
    }
  }
  EXPECT_TRUE(seen_torque);
  wanted.mode = standing;
  ticks(1);
  for (int j = 0; j < 3; ++j) EXPECT_EQ(plant.setpoint(j).pwm_limit, dxl::kFullPwm);
}

TEST_F(AppLoop, AServoThatMissedItsStrengthHearsItAgain) {
  ready();
  wanted.torque_enable = 0b111;
  wanted.mode = static_cast<std::uint8_t>(safety::Mode::kStanding);
  ticks(5);
  std::uint8_t frame[32];
  const std::uint8_t weak[2] = {100, 0};
  bus.send(frame, dxl::encode_write(frame, sizeof frame, params.joint[1].servo_id,
                                    dxl::address::kGoalPwm, weak, sizeof weak));
  std::uint8_t reply[32];
  while (bus.poll(reply, sizeof reply, 1000) > 0) {
  }
  EXPECT_EQ(plant.setpoint(1).pwm_limit, 100);
  ticks(kJoints);
  EXPECT_EQ(plant.setpoint(1).pwm_limit, dxl::kFullPwm);
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

// An MX has no Fast Sync Read.
TEST_F(AppLoop, ServosOfEveryModelAreBroughtUpAndRead) {
  for (const dxl::ServoModel& model : dxl::kServoModels) {
    SCOPED_TRACE(model.name);
    Params robot = test::bus_params(kJoints, model.has(dxl::kFastSyncRead));
    robot.servo[0].model_number = model.number;
    test::FakePlant own_plant;
    own_plant.rated.nominal_v = model.nominal_dv / 10.0;
    for (auto& each : own_plant.measured) each.voltage_v = own_plant.rated.nominal_v;
    bus::VirtualBus own(robot, own_plant);
    Tap own_tap{own};
    app::App<Tap, Script, Memory> own_app{robot, own_tap, script, memory};
    ASSERT_EQ(own_app.bring_up().status, app::BringUpStatus::kReady);
    for (int i = 0; i < 3; ++i) own_app.tick();
    EXPECT_EQ(own_app.inputs().fresh, all());
  }
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

TEST_F(AppLoop, AListenerHearsEveryByteAtItsTime) {
  struct Heard {
    std::uint64_t begin_ns, end_ns;
    std::size_t bytes;
    bool master;
  };
  std::vector<Heard> all;
  bus.set_listener([&all](bool master, auto bytes, auto begin_ns, auto end_ns) {
    all.push_back({begin_ns, end_ns, bytes.size(), master});
  });
  ready();
  wanted.torque_enable = this->all();
  ticks(20);
  std::sort(all.begin(), all.end(),
            [](const Heard& a, const Heard& b) { return a.begin_ns < b.begin_ns; });
  std::size_t bytes = 0, sent = 0, sent_by_master = 0;
  std::uint64_t free_ns = 0;
  for (const Heard& each : all) {
    EXPECT_GE(each.begin_ns, free_ns) << "one at a time";
    EXPECT_EQ(each.end_ns - each.begin_ns, each.bytes * 10 * 1'000'000'000 / params.baud);
    free_ns = each.end_ns;
    bytes += each.bytes;
    sent_by_master += each.master ? each.bytes : 0;
  }
  for (const auto& frame : tap.frames) sent += frame.size();
  EXPECT_EQ(bytes, bus.bytes_on_wire());
  EXPECT_EQ(sent_by_master, sent);
}

TEST_F(AppLoop, TheSameRunGivesTheSameRecords) {
  const auto run = [this] {
    test::FakePlant twin;
    bus::VirtualBus twin_bus(params, twin);
    Tap twin_tap{twin_bus};
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
}  // namespace verp::test
