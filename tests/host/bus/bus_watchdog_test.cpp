#include "tests/host/bus/app_fixture.hpp"

/// A servo that lost the bus stops and takes no goal until its watchdog is rearmed.
namespace verp::test {
namespace {

namespace at = dxl::address;

class BusWatchdog : public AppLoop {
 protected:
  std::uint8_t write(std::uint8_t id, std::uint16_t address, std::vector<std::uint8_t> data) {
    std::vector<std::uint8_t> frame(64);
    bus.send(frame.data(),
             dxl::encode_write(frame.data(), frame.size(), id, address, data.data(), data.size()));
    return reply().error;
  }
  std::uint8_t watchdog(std::uint8_t id) {
    std::vector<std::uint8_t> frame(64);
    bus.send(frame.data(), dxl::encode_read(frame.data(), frame.size(), id, at::kBusWatchdog, 1));
    const dxl::Packet packet = reply();
    return packet.size == 1 ? packet.parameters[0] : std::uint8_t{0x55};
  }
  void quiet(std::uint32_t time_us) {
    std::uint8_t byte = 0;
    ASSERT_EQ(bus.poll(&byte, 1, time_us), 0u);
  }
  bool tripped(int joint) {
    return watchdog(params.joint[joint].servo_id) == dxl::kBusWatchdogTripped;
  }

 private:
  dxl::Packet reply() {
    std::uint8_t buffer[128];
    const std::size_t count = bus.poll(buffer, sizeof buffer, 100000);
    parser_.reset();
    for (std::size_t i = 0; i < count; ++i) {
      if (parser_.push(buffer[i])) return parser_.packet();
    }
    ADD_FAILURE() << "no reply";
    return {};
  }
  dxl::Parser parser_;
};

constexpr std::uint32_t kUnit = dxl::kBusWatchdogUnit_us;

TEST_F(BusWatchdog, StopsTheServoWhereItIsWhenNoPacketComes) {
  EXPECT_EQ(write(1, at::kGoalPosition, {0x00, 0x08, 0, 0}), 0);
  EXPECT_EQ(write(1, at::kBusWatchdog, {5}), 0);
  EXPECT_EQ(write(1, at::kTorqueEnable, {1}), 0);
  quiet(4 * kUnit);
  EXPECT_EQ(watchdog(1), 5);
  plant.measured[0].position_count = 1234;
  plant.setpoint(0).goal_count = 1234;  // the present position
  quiet(6 * kUnit);
  EXPECT_EQ(watchdog(1), dxl::kBusWatchdogTripped);
  EXPECT_EQ(plant.setpoint(0).goal_count, 1234);
  EXPECT_TRUE(plant.setpoint(0).torque_on) << "it holds";
}

TEST_F(BusWatchdog, IsFedByAnyPacket) {
  EXPECT_EQ(write(1, at::kBusWatchdog, {5}), 0);
  EXPECT_EQ(write(1, at::kTorqueEnable, {1}), 0);
  for (int i = 0; i < 10; ++i) {
    quiet(4 * kUnit);
    EXPECT_EQ(write(2, at::kLed, {1}), 0);
  }
  EXPECT_EQ(watchdog(1), 5);
}

TEST_F(BusWatchdog, WatchesOnlyWithTorqueOn) {
  EXPECT_EQ(write(1, at::kBusWatchdog, {5}), 0);
  quiet(100 * kUnit);
  EXPECT_EQ(watchdog(1), 5);
}

TEST_F(BusWatchdog, RefusesGoalsUntilZeroIsWritten) {
  EXPECT_EQ(write(1, at::kBusWatchdog, {5}), 0);
  EXPECT_EQ(write(1, at::kTorqueEnable, {1}), 0);
  quiet(6 * kUnit);
  const auto range = static_cast<std::uint8_t>(dxl::Error::kDataRange);
  EXPECT_EQ(write(1, at::kGoalPosition, {0, 4, 0, 0}), range);
  EXPECT_EQ(write(1, at::kGoalPwm, {10, 0}), range);
  EXPECT_EQ(write(1, at::kBusWatchdog, {5}), range);
  EXPECT_EQ(write(1, at::kLed, {1}), 0);
  EXPECT_EQ(write(1, at::kTorqueEnable, {0}), 0) << "torque can always be taken away";
  EXPECT_EQ(write(1, at::kBusWatchdog, {0}), 0);
  EXPECT_EQ(write(1, at::kGoalPosition, {0, 4, 0, 0}), 0);
}

TEST_F(BusWatchdog, GoesWithTheTorque) {
  ready();
  ticks(3);
  EXPECT_EQ(watchdog(1), 0);
  wanted.torque_enable = all();
  ticks(3);
  const int units = app::bus_watchdog_units(params);
  for (int j = 0; j < kJoints; ++j) EXPECT_EQ(watchdog(params.joint[j].servo_id), units);
  EXPECT_GT(static_cast<float>(units) * 1e-6F * kUnit, params.tuning.safety.stale_release_s);
  wanted.torque_enable = 0;
  ticks(3);
  EXPECT_EQ(watchdog(1), 0);
}

TEST_F(BusWatchdog, ARobotCutOffForSecondsArmsAgain) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  quiet(2'000'000);  // the controller restarts
  EXPECT_TRUE(tripped(0) && tripped(kJoints - 1));
  ready();
  wanted.torque_enable = 0;
  ticks(2);
  for (int j = 0; j < kJoints; ++j) EXPECT_FALSE(tripped(j));
  wanted.torque_enable = all();
  wanted.goal_count[4] = 2500;
  ticks(2);
  EXPECT_EQ(plant.setpoint(4).goal_count, 2500);
}

TEST_F(BusWatchdog, ARobotThatArmsAsSoonAsTheBusIsBackMoves) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  for (int j = 0; j < kJoints; ++j) bus.set_connected(params.joint[j].servo_id, false);
  ticks(100);
  wanted.torque_enable = 0;
  ticks(10);
  for (int j = 0; j < kJoints; ++j) bus.set_connected(params.joint[j].servo_id, true);
  EXPECT_TRUE(tripped(0) && tripped(kJoints - 1));
  wanted.torque_enable = all();
  for (int j = 0; j < kJoints; ++j) wanted.goal_count[j] = 2500;
  ticks(1);
  for (int j = 0; j < kJoints; ++j) EXPECT_EQ(plant.setpoint(j).goal_count, 2500) << j;
}

// The bus returns while the robot sits down: servos must accept goals before torque goes off. One
// frame may be lost.
TEST_F(BusWatchdog, ARobotWhoseBusComesBackUnderTorqueMoves) {
  ready();
  wanted.torque_enable = all();
  ticks(30);
  for (int j = 0; j < kJoints; ++j) bus.set_connected(params.joint[j].servo_id, false);
  ticks(100);
  for (int j = 0; j < kJoints; ++j) bus.set_connected(params.joint[j].servo_id, true);
  EXPECT_TRUE(tripped(0) && tripped(kJoints - 1));
  for (int j = 0; j < kJoints; ++j) wanted.goal_count[j] = 2500;
  ticks(1);
  for (int j = 0; j < kJoints; ++j) EXPECT_EQ(plant.setpoint(j).goal_count, 2500) << j;
  ticks(3);
  for (int j = 0; j < kJoints; ++j)
    EXPECT_EQ(watchdog(params.joint[j].servo_id), app::bus_watchdog_units(params)) << j;
}

TEST_F(BusWatchdog, AServoThatComesBackAloneMoves) {
  ready();
  wanted.torque_enable = all();
  ticks(30);
  bus.set_connected(params.joint[4].servo_id, false);
  ticks(100);
  bus.set_connected(params.joint[4].servo_id, true);
  wanted.goal_count[4] = 2500;
  ticks(3);
  EXPECT_EQ(plant.setpoint(4).goal_count, 2500);
}

// Longer than the watchdogs wait.
TEST_F(BusWatchdog, APauseOfTheControllerLeavesNoServoBehind) {
  ready();
  wanted.torque_enable = all();
  ticks(30);
  quiet(3'000'000);
  wanted.goal_count[4] = 2500;
  ticks(2);
  EXPECT_EQ(plant.setpoint(4).goal_count, 2500);
  for (int j = 0; j < kJoints; ++j) EXPECT_FALSE(tripped(j));
}

}  // namespace
}  // namespace verp::test
