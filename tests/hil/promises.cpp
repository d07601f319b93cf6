#include "tests/hil/promises.hpp"

#include <gtest/gtest.h>

#include "common/safety/machine.hpp"

namespace verp::test {
namespace {

using dxl::controller::DeviceState;

constexpr int kBus = dxl::controller::kDeviceBus;

/// Walking, standing, sitting, relaxed, whatever is asked.
void stops_walking(const RunResult& result, std::uint32_t fault) {
  EXPECT_EQ(result.before.faults & fault, 0u);
  EXPECT_EQ(result.during.faults & fault, fault);
  EXPECT_EQ(result.during.mode, kRelaxed) << kModeNames[result.during.mode];
  EXPECT_TRUE(was(result, kSitting));
  EXPECT_EQ(result.changes, 3u);
  EXPECT_FALSE(was(result, kHolding)) << "nobody was silent";
}

void no_imu(const RunResult& result) {
  EXPECT_NE(result.during.faults & safety::kFaultImuSilent, 0u);
  EXPECT_EQ(result.during.faults & safety::kFaultServoSilent, 0u);
  EXPECT_TRUE(was(result, kHolding));
  EXPECT_TRUE(was(result, kSitting)) << "silent for longer than stale_release_s";
}

}  // namespace

void keeps_walking(const RunResult& result) {
  EXPECT_EQ(result.walking_ticks, result.ticks) << "left its walk";
  EXPECT_FALSE(result.fallen);
}

void gone_briefly(const RunResult& result) {
  EXPECT_EQ(result.during.state[row(result)], DeviceState::kStale);
  EXPECT_GE(result.during.errors[row(result)], 9u);
  EXPECT_EQ(result.during.fresh >> row(result) & 1u, 0u);
  EXPECT_TRUE(was(result, kHolding));
  EXPECT_EQ(result.after.state[row(result)], DeviceState::kGood) << "it is back";
}

void let_go(const RunResult& result) {
  EXPECT_TRUE(was(result, kSitting));
  EXPECT_TRUE(was(result, kRelaxed));
}

void gone_for_good(const RunResult& result) {
  EXPECT_EQ(result.after.state[row(result)], DeviceState::kLost);
  EXPECT_GE(result.after.age[row(result)], 250u);
  EXPECT_EQ(result.after.state[kBus], DeviceState::kGood) << "one servo is not the bus";
  EXPECT_TRUE(was(result, kHolding));
  EXPECT_TRUE(was(result, kSitting) || was(result, kFallen));
  EXPECT_TRUE(result.after.mode == kRelaxed || result.after.mode == kFallen);
}

void repeats(const RunResult& result) {
  EXPECT_GT(result.during.errors[row(result)], 0u);
  EXPECT_EQ(result.during.missed_reports(), result.during.errors[row(result)]) << "others are well";
  EXPECT_EQ(result.during.timeouts, 0u) << "the bus is well";
  EXPECT_EQ(result.after.state[row(result)], DeviceState::kGood);
  EXPECT_NE(result.during.faults & safety::kFaultNotFollowing, 0u);
  EXPECT_EQ(result.during.faults & safety::kFaultServoSilent, 0u);
  EXPECT_TRUE(was(result, kHolding)) << "a knee that stays where it is while its goals swing";
}

void late(const RunResult& result) {
  EXPECT_GE(result.after.misses, result.events) << "each was longer than a period";
  EXPECT_GE(result.after.overruns, result.events);
  keeps_walking(result);
}

void cut(const RunResult& result) {
  EXPECT_GT(result.during.timeouts, 0u);
  EXPECT_NE(result.during.state[kBus], DeviceState::kGood);
  EXPECT_EQ(result.during.fresh, 0u);
  EXPECT_TRUE(was(result, kHolding));
  EXPECT_EQ(result.after.state[kBus], DeviceState::kGood) << "the bus is back";
}

void reset(const RunResult& result) {
  constexpr int kWatchdog = static_cast<int>(dxl::controller::ResetCause::kWatchdog);
  EXPECT_EQ(result.after.reset_cause, kWatchdog);
  EXPECT_LT(result.after.tick, result.before.tick + result.ticks) << "it counts anew";
}

void hot(const RunResult& result) {
  stops_walking(result, safety::kFaultTemperature);
}

void low_voltage(const RunResult& result) {
  stops_walking(result, safety::kFaultVoltage);
}

void sags(const RunResult& result) {
  stops_walking(result, safety::kFaultVoltage);
}

void flutters(const RunResult& result) {
  EXPECT_EQ(result.during.faults & safety::kFaultFlutter, safety::kFaultFlutter + 0u);
  EXPECT_EQ(result.during.mode, kRelaxed) << kModeNames[result.during.mode];
  EXPECT_TRUE(was(result, kSitting));
  EXPECT_LE(result.changes, 12u);
  EXPECT_EQ(result.after.faults & safety::kFaultFlutter, 0u) << "acknowledged";
}

void joint_beyond(const RunResult& result) {
  EXPECT_EQ(result.during.mode, kRelaxed) << kModeNames[result.during.mode];
  EXPECT_EQ(result.during.faults & safety::kFaultJointBeyond, safety::kFaultJointBeyond + 0u);
  EXPECT_EQ(result.during.refused_joint, result.joint_id) << "it is named";
  EXPECT_EQ(result.after.refused_joint, 0xFF) << "nobody is";
}

// A servo that shut itself off does not count.
void overheated(const RunResult& result) {
  constexpr std::uint32_t kBoth = safety::kFaultServoError | safety::kFaultTemperature;
  EXPECT_EQ(result.after.faults & kBoth, kBoth);
  EXPECT_TRUE(was(result, kHolding));
  EXPECT_EQ(result.after.mode, kRelaxed) << kModeNames[result.after.mode];
}

void imu_gone(const RunResult& result) {
  constexpr int kImu = dxl::controller::kDeviceImu;
  EXPECT_EQ(result.during.state[kImu], DeviceState::kLost);
  EXPECT_EQ(result.after.state[kImu], DeviceState::kGood) << "it is back";
  no_imu(result);
}

void imu_repeats(const RunResult& result) {
  constexpr int kImu = dxl::controller::kDeviceImu;
  EXPECT_EQ(result.during.state[kImu], DeviceState::kStale);
  EXPECT_GT(result.during.errors[kImu], 0u);
  EXPECT_EQ(result.during.timeouts, 0u) << "the bus is well";
  EXPECT_EQ(result.after.state[kImu], DeviceState::kGood) << "it is back";
  no_imu(result);
}

void walks_again(const RunResult& result) {
  EXPECT_EQ(result.after.mode, kWalking) << kModeNames[result.after.mode];
}

}  // namespace verp::test
