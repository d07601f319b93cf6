#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>

#include "host/robot/model/load.hpp"
#include "host/twin/sim/robot.hpp"

namespace verp::sim {
namespace {

/// Like the firmware: the entity's gains, torque on, the stand pose.
void arm(Plant& plant, const TwinRobot& robot) {
  for (std::size_t j = 0; j < robot.entity().joints.size(); ++j) {
    const model::Joint& joint = robot.entity().joints[j];
    ServoSetpoint& setpoint = plant.setpoint(static_cast<int>(j));
    setpoint.torque_on = true;
    setpoint.p_gain = joint.servo.p_gain;
    setpoint.i_gain = joint.servo.i_gain;
    setpoint.d_gain = joint.servo.d_gain;
    setpoint.goal_count =
        static_cast<std::int32_t>(std::lround(count_of(joint.servo, joint.stand_rad)));
  }
}

// A crouch, hips 150 mm over the ankles, without balance feedback, with zero errors of half a
// degree, play, noise and a lean.
TEST(Generic21, StandsThreeSecondsOnItsServos) {
  const model::Entity entity =
      model::load_robot(VERP_SOURCE_DIR "/common/robots/generic21/robot.sdf");
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    World world;
    TwinOptions options;
    options.seed = seed;
    TwinRobot robot(world, entity, options);
    arm(robot, robot);
    const auto start = std::chrono::steady_clock::now();
    robot.advance_to(1'500'000);
    const Truth settled = robot.truth();
    robot.advance_to(4'500'000);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    const Truth truth = robot.truth();
    std::cout << "seed " << seed << ": real-time factor " << 4.5 / wall.count() << ", tilt "
              << truth.roll_rad << ' ' << truth.pitch_rad << ", supply " << robot.supply_v()
              << " V\n";
    EXPECT_FALSE(settled.held);
    EXPECT_FALSE(truth.fallen) << "seed " << seed;
    EXPECT_LT(std::hypot(truth.roll_rad, truth.pitch_rad), 0.1) << "seed " << seed;
    EXPECT_LT((truth.body_world.translation() - settled.body_world.translation()).norm(), 0.01)
        << "seed " << seed;
  }
}

}  // namespace
}  // namespace verp::sim
