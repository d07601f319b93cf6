#include "common/control/admit.hpp"

#include <gtest/gtest.h>

#include "common/safety/machine.hpp"
#include "tests/unit/control/loop.hpp"

namespace verp::control {
namespace {

using test::kJointCount;
using test::kRobot;
using test::Loop;

constexpr std::uint8_t kGood_c = 40, kHot_c = 99;
constexpr std::uint16_t kGood_tenth_v = 120, kLow_tenth_v = 90;

struct Telemetry {
  AdmitOut read(int joint, std::uint8_t temperature_c, std::uint8_t error = 0,
                std::uint16_t tenth_v = kGood_tenth_v) {
    inputs.flags = kSlowFresh;
    inputs.slow_joint = static_cast<std::uint8_t>(joint);
    inputs.slow_temperature_c = temperature_c;
    inputs.slow_error = error;
    inputs.slow_voltage_tenth_v = tenth_v;
    ++inputs.tick;
    return last = admit(*robot, state, tuning, inputs);
  }
  /// Servos in `bad` are too hot or report an error.
  AdmitOut round(std::uint32_t bad, bool error = false) {
    for (int j = 0; j < kJointCount; ++j) {
      const bool is_bad = (bad >> j & 1U) != 0;
      read(j, is_bad && !error ? kHot_c : kGood_c, is_bad && error ? 0x20 : 0);
    }
    return last;
  }
  bool power_bad() const { return (last.conditions & safety::kTrouble) != 0; }

  const Params* robot = &kRobot;
  AdmitState state;
  Tuning tuning = kRobot.tuning;
  Inputs inputs;
  AdmitOut last;
};

TEST(Admit, OneServoThatStaysBadIsFound) {
  for (int j = 0; j < kJointCount; ++j) {
    for (const bool error : {false, true}) {
      Telemetry telemetry;
      for (int n = 1; n < kAlarmReadings; ++n) {
        telemetry.round(1U << j, error);
        EXPECT_FALSE(telemetry.power_bad()) << "joint " << j << " after " << n;
      }
      telemetry.round(1U << j, error);
      EXPECT_TRUE(telemetry.power_bad()) << "joint " << j;
      const AdmitOut out = telemetry.read(j, error ? kGood_c : kHot_c, error ? 0x20 : 0);
      EXPECT_EQ(out.faults & (safety::kFaultTemperature | safety::kFaultServoError),
                error ? safety::kFaultServoError : safety::kFaultTemperature);
    }
  }
}

TEST(Admit, AllServosButOneThatStayBadAreFound) {
  Telemetry telemetry;
  for (int n = 0; n < kAlarmReadings; ++n) telemetry.round((1U << kJointCount) - 2U);
  EXPECT_TRUE(telemetry.power_bad());
}

TEST(Admit, BadReadingsThatAreNotOneServosInARowAreNoise) {
  Telemetry telemetry;
  for (int n = 1; n < kAlarmReadings; ++n) telemetry.round(~0U);
  EXPECT_FALSE(telemetry.power_bad());
  telemetry.round(0);
  for (int n = 0; n < 20; ++n) {
    telemetry.round(n % kAlarmReadings != 0 ? 1U << 5 : 0U);
    EXPECT_FALSE(telemetry.power_bad()) << "round " << n;
    EXPECT_EQ(telemetry.last.faults & safety::kFaultTemperature, 0U);
  }
}

TEST(Admit, ServoThatIsWellAgainClearsItselfAndNoOther) {
  Telemetry telemetry;
  for (int n = 0; n < kAlarmReadings; ++n) telemetry.round(1U << 3 | 1U << 9);
  telemetry.round(1U << 9);
  EXPECT_TRUE(telemetry.power_bad());
  telemetry.round(0);
  EXPECT_FALSE(telemetry.power_bad());
}

// All servos share the supply.
TEST(Admit, LowSupplyIsFoundWhicheverServosTellOfIt) {
  Telemetry telemetry;
  for (int n = 1; n < kSupplyReadings; ++n) {
    telemetry.read(n * 5 % kJointCount, kGood_c, 0, kLow_tenth_v);
    EXPECT_FALSE(telemetry.power_bad()) << n;
  }
  telemetry.read(2, kGood_c, 0, kLow_tenth_v);
  EXPECT_TRUE(telemetry.power_bad());
  EXPECT_EQ(telemetry.last.faults & safety::kFaultVoltage, safety::kFaultVoltage + 0U);
  telemetry.read(3, kGood_c);
  EXPECT_FALSE(telemetry.power_bad()) << "a peak of the current is over";
}

TEST(Admit, TelemetryOfNoServoIsIgnored) {
  Telemetry telemetry;
  for (int n = 0; n < 3 * kSupplyReadings; ++n) {
    telemetry.read(kJointCount + n % (256 - kJointCount), kHot_c, 1, kLow_tenth_v);
    EXPECT_FALSE(telemetry.power_bad());
  }
}

TEST(Admit, OneHotServoEndsTheWalk) {
  Loop& loop = test::fresh_loop();
  loop.walk(1000);
  ASSERT_GE(loop.until(safety::Mode::kWalking, 600), 0);
  const auto round = [&loop] {
    loop.inputs.flags |= kSlowFresh;
    loop.inputs.slow_joint = static_cast<std::uint8_t>((loop.inputs.slow_joint + 1) % kJointCount);
    loop.inputs.slow_voltage_tenth_v = kGood_tenth_v;
    loop.inputs.slow_temperature_c = loop.inputs.slow_joint == 3 ? kHot_c : kGood_c;
    loop.tick();
  };
  for (int i = 0; i < (kAlarmReadings + 1) * kJointCount; ++i) round();
  EXPECT_NE(loop.outputs.faults & safety::kFaultTemperature, 0U);
  for (int i = 0; i < 300 && !loop.is_in(safety::Mode::kStanding); ++i) round();
  EXPECT_TRUE(loop.is_in(safety::Mode::kStanding));
  EXPECT_EQ(loop.outputs.stance, gait::kBoth);
  for (int i = 0; i < 300; ++i) round();
  EXPECT_TRUE(loop.is_in(safety::Mode::kRelaxed)) << "though a walk is asked";
}

constexpr int kHold_ticks = 5;  // stale_hold_s at 10 ms

struct Senses {
  AdmitOut tick(std::uint32_t periods = 1) {
    inputs.tick += periods;
    if (noise) inputs.gyro_count[0] = static_cast<std::int16_t>(inputs.gyro_count[0] ^ 1);
    if (state.started == 0) start(*robot, inputs, state);
    return last = admit(*robot, state, tuning, inputs);
  }
  bool is(safety::Condition condition) const { return (last.conditions & condition) != 0; }

  Senses() {
    inputs.flags = kImuFresh | kFeetFresh | kCommandFresh;
    inputs.fresh = ~0U;
    inputs.accel_count[2] = 8172;
  }
  const Params* robot = &kRobot;
  AdmitState state;
  Tuning tuning = kRobot.tuning;
  Inputs inputs;
  AdmitOut last;
  bool noise = true;
};

TEST(Admit, FirstTickMayHaveAnyNumberAndTheCountMayWrap) {
  for (const std::uint32_t first : {0U, 1U, 12345U, 0x80000000U, 0xFFFFFFF0U, 0xFFFFFFFFU}) {
    Senses senses;
    senses.inputs.tick = first - 1;
    for (int i = 0; i < 40; ++i) {
      senses.tick();
      ASSERT_EQ(senses.last.faults, 0U) << "first " << first << ", tick " << i;
      ASSERT_FALSE(senses.is(safety::kStale)) << "first " << first << ", tick " << i;
    }
  }
}

TEST(Admit, ControllerThatStoodStillIsStale) {
  for (const std::uint32_t skipped : {0U, 1U, 4U, 5U, 6U, 49U, 50U, 300U, 100'000U, 0xFFFFFFF0U}) {
    Senses senses;
    for (int i = 0; i < 10; ++i) senses.tick();
    senses.tick(1 + skipped);
    EXPECT_EQ(senses.is(safety::kStale), skipped >= kHold_ticks + 0U) << skipped << " skipped";
    EXPECT_EQ(senses.is(safety::kLost), skipped >= 50U) << skipped << " skipped";
    senses.tick();
    EXPECT_FALSE(senses.is(safety::kStale)) << "in time again";
  }
}

TEST(Admit, AgesAreTimesNotTicks) {
  for (const std::uint32_t periods : {1U, 2U, 4U}) {
    Senses servo, imu, person;
    for (Senses* each : {&servo, &imu, &person}) each->tick();
    const std::uint32_t begun = servo.inputs.tick;
    servo.inputs.fresh = ~(1U << 7);
    imu.inputs.flags = kFeetFresh | kCommandFresh;
    person.inputs.flags = kImuFresh | kFeetFresh;
    while (servo.inputs.tick - begun < 60) {
      for (Senses* each : {&servo, &imu, &person}) each->tick(periods);
      const std::uint32_t silent = servo.inputs.tick - begun;
      EXPECT_EQ(servo.is(safety::kStale), silent >= 5) << silent << " by " << periods;
      EXPECT_EQ(imu.is(safety::kStale), silent >= 5) << silent << " by " << periods;
      EXPECT_EQ(servo.is(safety::kLost), silent >= 50) << silent << " by " << periods;
      EXPECT_EQ(person.is(safety::kOperatorQuiet), silent > 50) << silent << " by " << periods;
    }
  }
}

// A clock that runs backwards is invalid.
TEST(Admit, TickThatDoesNotComeIsNoReasonToBeYoung) {
  Senses stopped;
  stopped.tick();
  stopped.inputs.fresh = 0;
  for (int i = 0; i < kHold_ticks; ++i) stopped.tick(0);
  EXPECT_TRUE(stopped.is(safety::kStale));
  Senses back;
  for (int i = 0; i < 10; ++i) back.tick();
  back.tick(0U - 3U);
  EXPECT_TRUE(back.is(safety::kStale));
}

TEST(Admit, AgesOfAnOperatorWhoIsGoneForEverDoNotWrap) {
  Senses senses;
  senses.tick();
  senses.inputs.flags = kImuFresh;
  for (int i = 0; i < 5; ++i) {
    senses.tick(0x7FFFFFFFU);
    EXPECT_TRUE(senses.is(safety::kOperatorGone));
  }
}

// Noise moves a live IMU by at least one count on any of six axes.
TEST(Admit, ImuThatRepeatsItselfIsSilentAndOneThatStirsIsNot) {
  for (int axis = 0; axis < 6; ++axis) {
    Senses senses;
    senses.noise = false;
    for (std::uint32_t i = 0; i < 5 * kFrozenReadings; ++i) {
      std::int16_t& count =
          axis < 3 ? senses.inputs.gyro_count[axis] : senses.inputs.accel_count[axis - 3];
      if (i % (kFrozenReadings - 1) == 0) count = static_cast<std::int16_t>(count ^ 1);
      senses.tick();
      ASSERT_TRUE(senses.last.imu_fresh) << "axis " << axis << ", reading " << i;
    }
    std::uint32_t alike = 1;
    for (; senses.last.imu_fresh && alike < 100; ++alike) {
      senses.tick();
    }
    EXPECT_LE(alike, kFrozenReadings + 1);
    for (int i = 0; i < kHold_ticks - 1; ++i) {
      senses.tick();
    }
    EXPECT_TRUE(senses.is(safety::kStale));
    EXPECT_EQ(senses.last.faults, safety::kFaultImuSilent + 0U);
    ++senses.inputs.accel_count[1];
    senses.tick();
    EXPECT_TRUE(senses.last.imu_fresh) << "alive again";
    EXPECT_FALSE(senses.is(safety::kStale));
  }
}

TEST(Admit, FrozenImuStopsTheWalk) {
  Loop& loop = test::fresh_loop();
  loop.walk(1000);
  ASSERT_GE(loop.until(safety::Mode::kWalking, 600), 0);
  loop.noise = false;
  const int held = loop.until(safety::Mode::kHolding, 100);
  EXPECT_GE(held, static_cast<int>(kFrozenReadings));
  EXPECT_LE(held, static_cast<int>(kFrozenReadings) + kHold_ticks + 1);
  EXPECT_NE(loop.outputs.faults & safety::kFaultImuSilent, 0U);
  EXPECT_GE(loop.until(safety::Mode::kSitting, 100), 0);
}

TEST(Admit, WalkEndsWhereTheControllerStoodStill) {
  Loop& loop = test::fresh_loop();
  loop.walk(1000);
  ASSERT_GE(loop.until(safety::Mode::kWalking, 600), 0);
  loop.inputs.tick += kHold_ticks - 1;
  loop.tick();
  EXPECT_TRUE(loop.is_in(safety::Mode::kWalking)) << "what a missed deadline takes";
  loop.inputs.tick += 300;
  loop.tick();
  EXPECT_TRUE(loop.is_in(safety::Mode::kHolding));
  loop.tick();
  EXPECT_TRUE(loop.is_in(safety::Mode::kRising));
  EXPECT_GE(loop.until(safety::Mode::kWalking, 600), 100) << "by way of a stand";
}

TEST(Admit, ImuMountedAskewIsReadInTheBodysAxes) {
  Params& params = test::changed_robot();
  ImuParams& imu = params.imu;
  test::Random random(5);
  for (int round = 0; round < 40; ++round) {
    imu.gyro_rad_s_per_count = random.between(1e-4F, 1e-2F);
    imu.accel_m_s2_per_count = random.between(1e-4F, 1e-2F);
    for (float& each : imu.body_imu) each = random.between(-1, 1);
    Senses senses;
    senses.robot = &params;
    for (std::int16_t& count : senses.inputs.gyro_count) count = std::int16_t(random.bits());
    for (std::int16_t& count : senses.inputs.accel_count) count = std::int16_t(random.bits());
    senses.tick();
    ASSERT_TRUE(senses.last.imu_fresh);
    for (int row = 0; row < 3; ++row) {
      double gyro = 0, accel = 0;
      for (int i = 0; i < 3; ++i) {
        const double part = imu.body_imu[3 * row + i];
        gyro += part * senses.inputs.gyro_count[i] * double{imu.gyro_rad_s_per_count};
        accel += part * senses.inputs.accel_count[i] * double{imu.accel_m_s2_per_count};
      }
      EXPECT_NEAR(senses.last.gyro_body_rad_s(row), gyro, 1e-4);
      EXPECT_NEAR(senses.last.accel_body_m_s2(row), accel, 1e-4);
    }
  }
}

TEST(Admit, OrdersAreTakenInTheirUnits) {
  test::Random random(6);
  Senses senses;
  Command& command = senses.inputs.command;
  for (int round = 0; round < 50; ++round) {
    for (std::int16_t* const value :
         {&command.vx_tenth_mm_s, &command.vy_tenth_mm_s, &command.wz_mrad_s,
          &command.head_pan_mrad, &command.head_tilt_mrad}) {
      *value = std::int16_t(random.bits());
    }
    senses.tick();
    EXPECT_NEAR(senses.last.vx_m_s, command.vx_tenth_mm_s / 1e4, 1e-6);
    EXPECT_NEAR(senses.last.vy_m_s, command.vy_tenth_mm_s / 1e4, 1e-6);
    EXPECT_NEAR(senses.last.wz_rad_s, command.wz_mrad_s / 1e3, 1e-5);
    EXPECT_NEAR(senses.last.head_pan_rad, command.head_pan_mrad / 1e3, 1e-5);
    EXPECT_NEAR(senses.last.head_tilt_rad, command.head_tilt_mrad / 1e3, 1e-5);
  }
}

TEST(Admit, EachJointOfTheLargestRobotHasItsOwnAlarm) {
  Params& params = test::changed_robot();
  params.joint_count = kMaxJoints;
  for (int j = 0; j < kMaxJoints; ++j) {
    Telemetry telemetry;
    telemetry.robot = &params;
    for (int n = 0; n < kAlarmReadings; ++n) telemetry.read(j, kHot_c);
    EXPECT_TRUE(telemetry.power_bad()) << j;
    telemetry.read((j + 1) % kMaxJoints, kGood_c);
    EXPECT_TRUE(telemetry.power_bad()) << "another joint is well, not " << j;
    telemetry.read(j, kGood_c);
    EXPECT_FALSE(telemetry.power_bad()) << j;
  }
}

}  // namespace
}  // namespace verp::control
