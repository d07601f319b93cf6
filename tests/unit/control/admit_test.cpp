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

/// The first stage alone, fed with telemetry.
struct Telemetry {
  AdmitOut read(int joint, std::uint8_t temperature_c, std::uint8_t error = 0,
                std::uint16_t tenth_v = kGood_tenth_v) {
    inputs.flags = kSlowFresh;
    inputs.slow_joint = static_cast<std::uint8_t>(joint);
    inputs.slow_temperature_c = temperature_c;
    inputs.slow_error = error;
    inputs.slow_voltage_tenth_v = tenth_v;
    ++inputs.tick;
    return last = admit(kRobot, state, tuning, inputs);
  }
  /// A round of all servos, of which those in `bad` are too hot or have an error.
  AdmitOut round(std::uint32_t bad, bool error = false) {
    for (int j = 0; j < kJointCount; ++j) {
      const bool is_bad = (bad >> j & 1U) != 0;
      read(j, is_bad && !error ? kHot_c : kGood_c, is_bad && error ? 0x20 : 0);
    }
    return last;
  }
  bool power_bad() const { return (last.conditions & safety::kPowerBad) != 0; }

  AdmitState state;
  Tuning tuning = kRobot.tuning;
  Inputs inputs;
  AdmitOut last;
};

// Whatever the others tell in between, and whichever it is.
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

// One bad reading is noise: of every servo one, one after the other, or of one now and then.
TEST(Admit, BadReadingsThatAreNotOneServosInARowAreNoise) {
  Telemetry telemetry;
  for (int n = 1; n < kAlarmReadings; ++n) telemetry.round(~0U);
  EXPECT_FALSE(telemetry.power_bad());
  telemetry.round(0);
  for (int n = 0; n < 20; ++n) {
    telemetry.round(n % kAlarmReadings != 0 ? 1U << 5 : 0U);
    EXPECT_FALSE(telemetry.power_bad()) << "round " << n;
    EXPECT_EQ(telemetry.last.faults, 0U);
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

// The supply is one for all: readings of any servos count together.
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

// Telemetry of a joint that is none is no reading, however its byte came about.
TEST(Admit, TelemetryOfNoServoIsIgnored) {
  Telemetry telemetry;
  for (int n = 0; n < 3 * kSupplyReadings; ++n) {
    telemetry.read(kJointCount + n % (256 - kJointCount), kHot_c, 1, kLow_tenth_v);
    EXPECT_FALSE(telemetry.power_bad());
  }
}

// Through the whole tick: one hot knee ends the walk on both feet, and keeps it from another.
TEST(Admit, OneHotServoEndsTheWalk) {
  static Loop loop;
  loop = Loop{};
  loop.walk(1000);
  ASSERT_GE(loop.until(safety::Mode::kWalking, 600), 0);
  const auto round = [] {
    loop.inputs.flags |= kSlowFresh;
    loop.inputs.slow_joint = static_cast<std::uint8_t>((loop.inputs.slow_joint + 1) % kJointCount);
    loop.inputs.slow_voltage_tenth_v = kGood_tenth_v;
    loop.inputs.slow_temperature_c = loop.inputs.slow_joint == 3 ? kHot_c : kGood_c;
    loop.tick();
  };
  for (int i = 0; i < (kAlarmReadings + 1) * kJointCount; ++i) round();
  EXPECT_NE(loop.outputs.faults & safety::kFaultTemperature, 0U);
  for (int i = 0; i < 300; ++i) round();
  EXPECT_TRUE(loop.is_in(safety::Mode::kStanding));
  EXPECT_EQ(loop.outputs.stance, gait::kBoth);
}

}  // namespace
}  // namespace verp::control
