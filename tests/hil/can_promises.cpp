#include "tests/hil/can_promises.hpp"

#include <gtest/gtest.h>

#include "common/safety/machine.hpp"

namespace verp::test {
namespace {

using dxl::controller::DeviceState;

constexpr int kBus = dxl::controller::kDeviceBus;
constexpr int kImu = dxl::controller::kDeviceImu;

void shows_each_lost_answer(const CanFaultResult& result) {
  EXPECT_GT(result.damage.lost_answers, 0u);
  EXPECT_GE(result.after.timeouts + result.after.missed_reports(), result.damage.lost_answers);
}
}  // namespace

void lost_few(const CanFaultResult& result) {
  EXPECT_GT(result.damage.lost, 0u);
  shows_each_lost_answer(result);
  keeps_walking(result);
}
void lost_many(const CanFaultResult& result) {
  EXPECT_GT(result.damage.lost, 50u);
  shows_each_lost_answer(result);
  keeps_walking(result);
}
void missed(const CanFaultResult& result) {
  EXPECT_GT(result.damage.missed, 10u);
  EXPECT_GE(result.after.timeouts + result.after.missed_reports(), result.damage.lost_answers);
  keeps_walking(result);
}
void doubled(const CanFaultResult& result) {
  EXPECT_GT(result.damage.doubled, 10u);
  keeps_walking(result);
}
void overtaken(const CanFaultResult& result) {
  EXPECT_GT(result.damage.overtaken, 10u);
  keeps_walking(result);
}
void delayed(const CanFaultResult& result) {
  EXPECT_GT(result.damage.late, 0u);
  EXPECT_GT(result.after.strays, 0u) << "what comes too late belongs to nobody";
  keeps_walking(result);
}
// The gateway delivers all a period late, so nothing may count as fresh.
void held_back(const CanFaultResult& result) {
  EXPECT_GT(result.damage.late, 0u);
  EXPECT_EQ(result.during.fresh, 0u);
  EXPECT_NE(result.during.state[kBus], DeviceState::kGood);
  EXPECT_TRUE(was(result, kHolding));
}
void everything(const CanFaultResult& result) {
  EXPECT_GT(result.damage.lost * result.damage.missed, 0u);
  EXPECT_GT(result.damage.doubled * result.damage.overtaken * result.damage.late, 0u);
  EXPECT_GT(result.after.timeouts, 0u);
  EXPECT_GT(result.after.missed_reports(), 0u);
}
void errors(const CanFaultResult& result) {
  EXPECT_GT(result.damage.broken, 0u);
  EXPECT_GE(result.after.crc_errors, result.damage.broken * 9 / 10)
      << "two errors within one interrupt are one";
  EXPECT_EQ(result.bus.bus_offs, 0u);
  keeps_walking(result);
}
void bus_off(const CanFaultResult& result) {
  EXPECT_EQ(result.bus.bus_offs, 1u);
  EXPECT_GT(result.after.noise, 0u) << "what it dropped";
  EXPECT_GT(result.after.crc_errors, 31u);
  keeps_walking(result);
}
void bus_offs(const CanFaultResult& result) {
  EXPECT_GT(result.bus.bus_offs, 10u);
  EXPECT_GT(result.after.noise, 0u) << "what it dropped";
  EXPECT_GT(result.after.refused, 0u);
  cut(result);
}
void reboots(const CanFaultResult& result) {
  EXPECT_GT(result.during.errors[row(result)], 0u);
  EXPECT_TRUE(was(result, kHolding));
  let_go(result);
  EXPECT_EQ(result.after.state[row(result)], DeviceState::kGood) << "it is set up again";
}
void many_reboot(const CanFaultResult& result) {
  EXPECT_GT(result.events, 1u);
  EXPECT_TRUE(was(result, kHolding));
  let_go(result);
  EXPECT_GT(result.after.missed_reports(), 0u);
}
void all_reboot(const CanFaultResult& result) {
  EXPECT_TRUE(was(result, kHolding));
  let_go(result);
  EXPECT_NE(result.before.fresh, 0u);
  EXPECT_EQ(result.after.fresh, result.before.fresh);
}
void imu_reboots(const CanFaultResult& result) {
  EXPECT_NE(result.after.faults & safety::kFaultImuSilent, 0u);
  EXPECT_GT(result.after.errors[kImu], 0u);
  EXPECT_EQ(result.after.state[kImu], DeviceState::kGood) << "it is back";
  EXPECT_TRUE(was(result, kHolding));
  EXPECT_FALSE(was(result, kSitting)) << "it was back before stale_release_s";
}
void foot_reboots(const CanFaultResult& result) {
  EXPECT_GT(result.after.timeouts, 0u);
  EXPECT_GT(result.after.missed_reports(), 0u);
  keeps_walking(result);
}
void urgent(const CanFaultResult& result) {
  EXPECT_GT(result.intruder, 100u);
  EXPECT_GE(result.after.strays, result.intruder * 9 / 10);
  keeps_walking(result);
}
void crowd(const CanFaultResult& result) {
  EXPECT_GT(result.intruder, 1000u);
  EXPECT_GT(result.after.timeouts, 0u);
}
void flood(const CanFaultResult& result) {
  EXPECT_GT(result.intruder, 1000u);
  cut(result);
}
void foreign(const CanFaultResult& result) {
  EXPECT_GT(result.intruder, 100u);
  EXPECT_GT(result.after.strays, result.intruder / 4);
  keeps_walking(result);
}
void unasked(const CanFaultResult& result) {
  EXPECT_GT(result.intruder, 100u);
  EXPECT_GE(result.after.strays, result.intruder * 9 / 10);
  keeps_walking(result);
}
// It is unknown which of the two is the drive, so its position does not count.
void twin(const CanFaultResult& result) {
  EXPECT_GE(result.intruder, 100u);
  EXPECT_EQ(result.during.fresh >> row(result) & 1u, 0u);
  EXPECT_TRUE(was(result, kHolding));
  let_go(result);
}
void foreign_sync(const CanFaultResult& result) {
  EXPECT_GT(result.intruder, 0u);
  keeps_walking(result);
}
void down(const CanFaultResult& result) {
  EXPECT_GT(result.damage.down, 0u);
  EXPECT_GT(result.after.refused, 0u);
  cut(result);
}

}  // namespace verp::test
