#include <gtest/gtest.h>

#include <cmath>

#include "host/twin/sim/robot.hpp"
#include "tests/host/sim/test_robots.hpp"

namespace verp::sim {
namespace {

/// The second arm follows the first one's motor.
constexpr double kRotor_kg_m2 = 0.02;  ///< more than the coupling's share

model::Entity two_arms(double ratio, double offset_rad) {
  model::Entity entity = test::arm();
  entity.nodes.push_back(entity.nodes[1]);
  entity.nodes[2].name = "follower";
  entity.joints.push_back(test::joint("follower", 0, {0, 0.5, 0}, {0, 1, 0}));
  model::Joint& follower = entity.joints[1];
  follower.follows = 0;
  follower.ratio = ratio;
  follower.offset_rad = offset_rad;
  follower.servo = entity.joints[0].servo;
  entity.joints[0].servo.p_gain = follower.servo.p_gain = 3500;
  entity.joints[0].servo.gearbox.armature_kg_m2 = kRotor_kg_m2;
  return entity;
}

TwinOptions held() {
  TwinOptions options;
  options.imperfections = Imperfections::none();
  options.cradle = Cradle::kAlways;
  return options;
}

TEST(Coupling, MotorBearsBothWeights) {
  for (const double ratio : {-1.0, 2.0, 0.5}) {
    World world;
    const model::Entity entity = two_arms(ratio, 0.1);
    TwinRobot robot(world, entity, held());
    const double goal_rad = 0.6;
    robot.setpoint(0) = {.torque_on = true,
                         .goal_count = static_cast<std::int32_t>(
                             std::lround(count_of(entity.joints[0].servo, goal_rad))),
                         .p_gain = 3500};
    robot.advance_to(2'000'000);
    double motor_n_m = 0;  // mean: the servo hums by a count
    for (int ms = 1; ms <= 500; ++ms) {
      robot.advance_to(2'000'000 + 1000 * static_cast<std::uint64_t>(ms));
      motor_n_m += robot.truth().torque_n_m[0] / 500;
    }
    const Truth truth = robot.truth();
    const double driver_rad = truth.joint_rad[0], follower_rad = truth.joint_rad[1];
    const double weight_n_m = test::kArmMass * test::kGravity_m_s2 * test::kArmLength;
    const double follower_n_m = weight_n_m * std::sin(follower_rad);
    EXPECT_NEAR(follower_rad, ratio * driver_rad + 0.1 - follower_n_m / 500, 1e-4) << ratio;
    EXPECT_NEAR(motor_n_m, weight_n_m * std::sin(driver_rad) + ratio * follower_n_m, 5e-3) << ratio;
    // The follower has no servo.
    EXPECT_EQ(robot.measure(1).position_count, robot.measure(0).position_count);
    EXPECT_NEAR(truth.torque_n_m[1], 0, 1e-9);
  }
}

// One pendulum with both inertias and the rotor's: T = 2 pi sqrt(I / (m g l)) for small angles.
// Lost or added energy would change period and height.
TEST(Coupling, BothSwingAsOnePendulum) {
  for (const double ratio : {-1.0, 2.0}) {
    World world;
    const model::Entity entity = two_arms(ratio, 0);
    TwinOptions options = held();
    options.initial_rad = {0.1, 0.1 * ratio};
    TwinRobot robot(world, entity, options);
    const double arm_kg_m2 =
        test::kArmInertia + test::kArmMass * test::kArmLength * test::kArmLength;
    const double inertia = (1 + ratio * ratio) * arm_kg_m2 + kRotor_kg_m2;
    const double weight =
        (1 + ratio * ratio) * test::kArmMass * test::kGravity_m_s2 * test::kArmLength;
    const double period_s = 2 * M_PI * std::sqrt(inertia / weight);
    double crossed_s = 0, most_rad = 0;
    int crossings = 0;
    double before_rad = 0.1;
    for (int step = 1; step <= 3000; ++step) {
      robot.advance_to(static_cast<std::uint64_t>(step) * 1000);
      const double now_rad = robot.truth().joint_rad[0];
      if (before_rad > 0 && now_rad <= 0) {
        ++crossings;
        crossed_s = step * 1e-3 - 1e-3 * now_rad / (now_rad - before_rad);
      }
      if (step > 2000) most_rad = std::max(most_rad, std::abs(now_rad));
      before_rad = now_rad;
    }
    ASSERT_GT(crossings, 2) << ratio;
    const double measured_s = crossed_s / (crossings - 0.75);
    EXPECT_NEAR(measured_s, period_s, 0.02 * period_s) << ratio;
    EXPECT_LT(most_rad, 0.101) << "nothing pushes it";
  }
}

// Only the gears' twist remains.
TEST(Coupling, FollowerStaysWithAMovingMotor) {
  World world;
  const model::Entity entity = two_arms(-1, 0);
  TwinRobot robot(world, entity, held());
  robot.setpoint(0) = {.torque_on = true, .goal_count = 2048 + 800, .p_gain = 3500};
  double most_off_rad = 0;
  for (std::uint64_t ms = 1; ms <= 600; ++ms) {
    robot.advance_to(ms * 1000);
    const Truth truth = robot.truth();
    most_off_rad = std::max(most_off_rad, std::abs(truth.joint_rad[1] + truth.joint_rad[0]));
  }
  EXPECT_LT(most_off_rad, 0.02);
  EXPECT_GT(robot.truth().joint_rad[0], 1.0);
}

}  // namespace
}  // namespace verp::sim
