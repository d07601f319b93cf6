#include "host/twin/sim/servo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "host/twin/sim/robot.hpp"
#include "tests/host/sim/test_robots.hpp"

namespace verp::sim {
namespace {

using test::kArmInertia;
using test::kArmLength;
using test::kArmMass;

constexpr double kStepS = 0.001;

TwinOptions bench() {
  TwinOptions options;
  options.imperfections = Imperfections::none();
  options.cradle = Cradle::kAlways;
  options.start_m = Vec3(0, 0, 1);
  return options;
}

struct BareServo {
  model::Joint joint = test::joint("j", 0, Vec3::Zero(), Vec3::UnitZ());
  ServoSetpoint setpoint{.torque_on = true, .goal_count = 2048, .p_gain = 3500};

  ServoModel model() const {
    return ServoModel(joint, {.encoder = false}, Random(1, Draw::kEncoder), 0.0);
  }
};

TEST(Servo, GivesStallTorqueAtStandstill) {
  BareServo bare;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;
  const Drive drive = servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS);
  EXPECT_NEAR(drive.torque_n_m(0), 3.0, 1e-9);
  EXPECT_TRUE(servo.saturated());
  servo.finish(0, kStepS);
  EXPECT_NEAR(servo.measurement().current_a, 2.3, 1e-9);
  EXPECT_NEAR(servo.torque_use(), 1.0, 1e-9);
}

TEST(Servo, GivesNoMoreThanItsDrivesPeak) {
  BareServo bare;
  bare.joint.servo.peak_torque_n_m = 1.0;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;
  EXPECT_NEAR(servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS).torque_n_m(0), 1.0, 1e-9);
  const Drive fast = bare.model().drive(bare.setpoint, 0, 6.0, 0, 12.0, kStepS);
  EXPECT_NEAR(fast.torque_n_m(6.0), 0.75, 1e-9) << "beyond it the motor's line holds";
}

TEST(Servo, WarmsAsItsHousingSays) {
  BareServo bare;
  bare.joint.servo.heat_capacity_j_k = 20;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;
  servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS);
  servo.finish(0, kStepS);
  EXPECT_NEAR(servo.measurement().temperature_c, 25 + 12 * 2.3 / 20 * kStepS, 1e-9);
}

TEST(Servo, HasNoTorqueLeftAtNoLoadSpeedAndHalfAtHalf) {
  BareServo bare;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;
  const Drive drive = servo.drive(bare.setpoint, 0, 8.0, 0, 12.0, kStepS);
  EXPECT_NEAR(drive.torque_n_m(8.0), 0, 1e-9);
  EXPECT_NEAR(drive.torque_n_m(4.0), 1.5, 1e-9);
}

TEST(Servo, WeakensWithTheSupply) {
  BareServo bare;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;
  EXPECT_NEAR(servo.drive(bare.setpoint, 0, 0, 0, 9.0, kStepS).torque_n_m(0), 3.0 * 9 / 12, 1e-9);
}

TEST(Servo, ObeysItsPwmLimit) {
  BareServo bare;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;
  bare.setpoint.pwm_limit = 177;  // 20 %
  EXPECT_NEAR(servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS).torque_n_m(0), 0.6, 1e-9);
  EXPECT_NEAR(servo.measurement().duty, 0.2, 1e-9);
}

TEST(Servo, IsLimitedByItsCurrentWhenDrivenBackwards) {
  BareServo bare;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;
  EXPECT_NEAR(servo.drive(bare.setpoint, 0, -8.0, 0, 12.0, kStepS).torque_n_m(-8.0), 1.4 * 3.0,
              1e-9);
}

TEST(Servo, CountsBackwardsWhenMountedBackwards) {
  BareServo bare;
  bare.joint.servo.direction = -1;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;
  EXPECT_NEAR(servo.drive(bare.setpoint, 0.5, 0, 0, 12.0, kStepS).torque_n_m(0), -3.0, 1e-9);
  EXPECT_EQ(servo.measurement().position_count, 2048 - 326);
  EXPECT_GT(servo.measurement().duty, 0);
}

TEST(Servo, ProfileIsAStraightLineOverItsTime) {
  BareServo bare;
  ServoModel servo = bare.model();
  servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS);
  bare.setpoint.profile_ms = 10;
  bare.setpoint.goal_count = 2048 + 100;
  for (int ms = 1; ms <= 10; ++ms) {
    servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS);
    EXPECT_NEAR(count_of(bare.joint.servo, servo.profile_rad()), 2048 + 10.0 * ms, 1e-6) << ms;
  }
  bare.setpoint.goal_count = 2048;
  for (int ms = 1; ms <= 5; ++ms) servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS);
  EXPECT_NEAR(count_of(bare.joint.servo, servo.profile_rad()), 2048 + 50, 1e-6);
  bare.setpoint.goal_count = 2048 + 100;
  for (int ms = 1; ms <= 5; ++ms) servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS);
  EXPECT_NEAR(count_of(bare.joint.servo, servo.profile_rad()), 2048 + 75, 1e-6);
}

TEST(Servo, HoldsTheAngleThatItsZeroErrorMakesOfTheGoal) {
  BareServo bare;
  ServoModel servo(bare.joint, {.encoder = false, .zero_error_rad = 0.01},
                   Random(1, Draw::kEncoder), 0.0);
  servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS);
  EXPECT_NEAR(servo.profile_rad(), -0.01, 1e-12);
  EXPECT_EQ(servo.measurement().position_count, 2048 + 7);  // 0.01 rad is 6.5 counts
}

TEST(Servo, PushesNothingInsideItsPlay) {
  BareServo bare;
  bare.joint.servo.backlash_rad = 0.02;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;  // at 8 rad/s, 8 mrad a step
  EXPECT_EQ(servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS).torque_n_m(0), 0);
  EXPECT_NEAR(servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS).torque_n_m(0), 3.0, 1e-9);
  bare.setpoint.goal_count = 0;  // the other flank is 20 mrad away
  for (int step = 0; step < 2; ++step) {
    EXPECT_EQ(servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS).torque_n_m(0), 0);
  }
  EXPECT_NEAR(servo.drive(bare.setpoint, 0, 0, 0, 12.0, kStepS).torque_n_m(0), -3.0, 1e-9);
}

TEST(Servo, WarmsByItsCurrentAndThenGivesLess) {
  BareServo bare;
  ServoModel servo = bare.model();
  bare.setpoint.goal_count = 4000;
  double torque = 0;
  for (int s = 0; s < 100; ++s) {  // only heat matters here
    torque = servo.drive(bare.setpoint, 0, 0, 0, 12.0, 1.0).torque_n_m(0);
    servo.finish(0, 1.0);
  }
  // 27.6 W into 74 J/K.
  EXPECT_GT(servo.measurement().temperature_c, 45);
  EXPECT_LT(servo.measurement().temperature_c, 25 + 27.6 * 100 / 74);
  EXPECT_LT(torque, 2.9);
}

TEST(Servo, NamesTheJointWhoseFactsAreImpossible) {
  BareServo bare;
  bare.joint.name = "l_knee";
  bare.joint.servo.stall_torque_n_m = 0;
  try {
    bare.model();
    FAIL() << "accepted a servo without torque";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("l_knee"), std::string::npos);
  }
}

// Duty times stall torque balances gravity: K = P/128 * counts/rad / 885 * stall.
TEST(ServoInOde, SagsByTorqueOverStiffness) {
  World world;
  TwinOptions options = bench();
  const double level = -1.5707963267948966;
  options.initial_rad = {level};
  TwinRobot robot(world, test::arm(), options);
  robot.setpoint(0).torque_on = true;
  robot.setpoint(0).p_gain = 3500;
  robot.advance_to(2'000'000);
  const double stiffness =
      3500.0 / 128 * (4096 / 6.283185307179586) / 885 * 3.0 * (robot.supply_v() / 12);
  const double load = kArmMass * 9.80665 * kArmLength;
  const double goal = -1024.0 * 6.283185307179586 / 4096;
  const double sag = std::abs(robot.truth().joint_rad[0] - goal);
  EXPECT_NEAR(sag, load / stiffness, 0.6 * 6.283185307179586 / 4096);  // one encoder count
  EXPECT_GT(robot.truth().torque_use[0], 0.9 * load / 3.0);
}

// J dw/dt = stall * (1 - w / w0): a time constant of J w0 / stall.
TEST(ServoInOde, SpeedsUpAsTheTorqueSpeedLineSays) {
  WorldOptions weightless;
  weightless.gravity_m_s2 = 0;
  weightless.step_us = 100;
  World world(weightless);
  model::Entity entity = test::arm();
  entity.joints[0].lower_rad = -100;
  entity.joints[0].upper_rad = 100;
  TwinOptions options = bench();
  options.supply_ohm = 0;
  TwinRobot robot(world, entity, options);
  robot.setpoint(0).torque_on = true;
  robot.setpoint(0).p_gain = 16000;
  robot.setpoint(0).goal_count = 1'000'000;
  const double inertia = kArmInertia + 1e-7 + kArmMass * kArmLength * kArmLength;
  const double time_constant_s = inertia * 8.0 / 3.0;
  for (int k = 1; k <= 5; ++k) {
    const auto time_us = static_cast<std::uint64_t>(k * time_constant_s * 1e6 / 100) * 100;
    robot.advance_to(time_us);
    const double expected =
        8.0 * (1 - std::exp(-static_cast<double>(time_us) * 1e-6 / time_constant_s));
    EXPECT_NEAR(robot.truth().joint_rad_s[0], expected, 0.03) << k;
  }
}

// J x'' = K (goal - x) - D x' for a small step.
TEST(ServoInOde, StepResponseIsThatOfASecondOrderSystem) {
  WorldOptions weightless;
  weightless.gravity_m_s2 = 0;
  weightless.step_us = 100;
  World world(weightless);
  TwinOptions options = bench();
  options.supply_ohm = 0;
  model::Entity entity = test::arm();
  entity.joints[0].servo.counts_per_rev = 4096 * 64;  // quantisation does not show
  entity.joints[0].servo.loop_s = 0.0001;             // sampling does not show
  entity.joints[0].servo.offset_count = 0;
  TwinRobot robot(world, entity, options);
  const double goal = 0.02;
  robot.setpoint(0).torque_on = true;
  robot.setpoint(0).p_gain = 100;
  robot.setpoint(0).goal_count = static_cast<int>(count_of(entity.joints[0].servo, goal));
  const double inertia = kArmInertia + 1e-7 + kArmMass * kArmLength * kArmLength;
  const double stiffness = 100.0 / 128 * (4096 * 64 / 6.283185307179586) / 885 * 3.0;
  const double damping = 3.0 / 8.0;
  const double decay = damping / (2 * inertia);
  const double wave = std::sqrt(stiffness / inertia - decay * decay);
  ASSERT_GT(wave, 0);
  for (int ms = 5; ms <= 100; ms += 5) {
    robot.advance_to(static_cast<std::uint64_t>(ms) * 1000);
    const double t = ms * 1e-3;
    const double expected =
        goal *
        (1 - std::exp(-decay * t) * (std::cos(wave * t) + decay / wave * std::sin(wave * t)));
    EXPECT_NEAR(robot.truth().joint_rad[0], expected, 0.02 * goal) << ms << " ms";
  }
}

TEST(ServoInOde, FallsWhenTorqueIsOffAndFrictionBrakesIt) {
  double frictionless = 0;
  for (const double friction : {0.0, 0.1}) {
    World world;
    model::Entity entity = test::arm();
    entity.joints[0].friction_n_m = friction;
    TwinOptions options = bench();
    options.initial_rad = {-1.5};
    TwinRobot robot(world, entity, options);
    robot.advance_to(150'000);
    const double fallen = robot.truth().joint_rad[0] + 1.5;
    EXPECT_GT(fallen, 0.2);
    if (friction == 0)
      frictionless = fallen;
    else
      EXPECT_LT(fallen, 0.9 * frictionless);
    EXPECT_EQ(robot.measure(0).current_a, 0);
  }
}

TEST(ServoInOde, StopsAtTheJointLimitEvenAtFullPower) {
  World world;
  model::Entity entity = test::arm();
  entity.joints[0].upper_rad = 0.3;
  TwinRobot robot(world, entity, bench());
  robot.setpoint(0).torque_on = true;
  robot.setpoint(0).goal_count = 4000;
  robot.setpoint(0).p_gain = 3500;
  robot.advance_to(500'000);
  EXPECT_NEAR(robot.truth().joint_rad[0], 0.3, 0.01);
}

TEST(ServoInOde, SupplySagsUnderLoad) {
  World world;
  model::Entity entity = test::arm();
  entity.joints[0].upper_rad = 0.1;
  TwinRobot robot(world, entity, bench());
  robot.setpoint(0).torque_on = true;
  robot.setpoint(0).goal_count = 4000;
  robot.setpoint(0).p_gain = 3500;
  robot.advance_to(500'000);  // 2.3 A through 0.1 ohm
  EXPECT_NEAR(robot.measure(0).voltage_v, 12 - 0.23, 0.01);
}

TEST(ServoInOde, SupplySagsByTheSamePartAtAnyVoltage) {
  for (const double nominal_v : {5.0, 24.0}) {
    World world;
    model::Entity entity = test::arm();
    entity.joints[0].upper_rad = 0.1;
    entity.joints[0].servo.stall_current_a *= 12 / nominal_v;
    entity.joints[0].servo.nominal_v = nominal_v;
    TwinRobot robot(world, entity, bench());
    robot.setpoint(0).torque_on = true;
    robot.setpoint(0).goal_count = 4000;
    robot.setpoint(0).p_gain = 3500;
    robot.advance_to(500'000);
    EXPECT_NEAR(robot.measure(0).voltage_v / nominal_v, 1 - 0.23 / 12, 0.001) << nominal_v << " V";
  }
}

}  // namespace
}  // namespace verp::sim
