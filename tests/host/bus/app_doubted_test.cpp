#include "tests/host/bus/app_fixture.hpp"

namespace verp::test {
namespace {

using DoubtedServos = AppLoop;

// A servo that lost power is limp, with factory gains: torque would throw it at its goal.
TEST_F(DoubtedServos, AServoThatLostItsPowerIsGoneUntilTheRobotHasLetGo) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  const int lost[] = {1, 3, 5, 8, 11, 12};  // more than fit into a tick
  std::uint32_t lost_bits = 0;
  for (int joint : lost) {
    lost_bits |= 1u << joint;
    bus.set_powered(params.joint[joint].servo_id, false);
  }
  ticks(12);
  for (int joint : lost) {
    bus.set_powered(params.joint[joint].servo_id, true);
    ASSERT_NE(plant.setpoint(joint).p_gain, 3500);
    ASSERT_NE(plant.setpoint(joint).profile_ms, 10u);
  }
  for (int tick = 0; tick < 50; ++tick) {
    ticks(1);
    EXPECT_EQ(app.inputs().fresh, all() & ~lost_bits) << "tick " << tick;
    for (int joint : lost) EXPECT_FALSE(plant.setpoint(joint).torque_on) << "tick " << tick;
  }
  wanted.torque_enable = 0;
  ticks(20);
  EXPECT_EQ(app.inputs().fresh, all());
  wanted.torque_enable = all();
  ticks(5);
  for (int joint : lost) {
    EXPECT_TRUE(plant.setpoint(joint).torque_on) << joint;
    EXPECT_EQ(plant.setpoint(joint).p_gain, 3500) << joint;
    EXPECT_EQ(plant.setpoint(joint).d_gain, 20) << joint;
    EXPECT_EQ(plant.setpoint(joint).profile_ms, 10u) << joint;
  }
}

TEST_F(DoubtedServos, ServosThatWereOnlySilentKeepTheirTorqueAndCountAgain) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  for (int j = 0; j < kJoints; ++j) bus.set_connected(params.joint[j].servo_id, false);
  ticks(8);
  for (int j = 0; j < kJoints; ++j) bus.set_connected(params.joint[j].servo_id, true);
  for (int tick = 0; tick < 12; ++tick) {
    ticks(1);
    for (int j = 0; j < kJoints; ++j) EXPECT_TRUE(plant.setpoint(j).torque_on) << "tick " << tick;
  }
  EXPECT_EQ(app.inputs().fresh, all());
}

TEST_F(DoubtedServos, ADoubtedServoIsLetGoAllTheSame) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  for (int j = 0; j < kJoints; ++j) bus.set_connected(params.joint[j].servo_id, false);
  ticks(6);
  for (int j = 0; j < kJoints; ++j) bus.set_connected(params.joint[j].servo_id, true);
  wanted.torque_enable = 0;
  ticks(1);
  for (int j = 0; j < kJoints; ++j) EXPECT_FALSE(plant.setpoint(j).torque_on) << j;
}

TEST_F(DoubtedServos, AServoThatShutItsTorqueOffIsGoneUntilItIsRebooted) {
  ready();
  wanted.torque_enable = all();
  ticks(5);
  plant.measured[3].temperature_c = 90;
  ticks(kJoints + 1);
  ASSERT_FALSE(plant.setpoint(3).torque_on);
  EXPECT_EQ(app.inputs().fresh, all() & ~(1u << 3));
  plant.measured[3].temperature_c = 40;  // the error stays latched
  wanted.torque_enable = 0;
  ticks(20);
  EXPECT_EQ(app.inputs().fresh, all() & ~(1u << 3)) << "nothing may rise on it";
  bus.set_powered(params.joint[3].servo_id, false);
  bus.set_powered(params.joint[3].servo_id, true);
  ticks(5);
  EXPECT_EQ(app.inputs().fresh, all());
  wanted.torque_enable = all();
  ticks(5);
  EXPECT_TRUE(plant.setpoint(3).torque_on);
  EXPECT_EQ(plant.setpoint(3).p_gain, 3500);
}

}  // namespace
}  // namespace verp::test
