#include "host/twin/sim/vary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "tests/host/sim/test_robots.hpp"

namespace verp::sim {
namespace {

constexpr int kRobots = 1000;

model::Entity robot() {
  model::Entity entity = test::biped();
  for (model::Joint& joint : entity.joints) {
    joint.servo.gearbox = {0.01, 0.05, 0.02, 0.01, 0.2, 1.5, 1.3, 0.015};
    joint.servo.armature_band = 0.5;
    joint.servo.friction_band = 0.3;
  }
  return entity;
}

Varied varied(std::uint64_t seed, const VaryBands& bands = {}) {
  return vary(robot(), {.seed = seed}, {}, bands);
}

struct Drawn {
  const char* name;
  double low, high;
  std::function<double(const Varied&)> value;
};

const std::vector<Drawn>& numbers() {
  static const model::Entity nominal = robot();
  static const std::vector<Drawn> kNumbers = {
      {"mass of a link", 0.9, 1.1,
       [](const Varied& v) { return v.entity.nodes[4].mass_kg / nominal.nodes[4].mass_kg; }},
      {"friction", 0.4, 1.0, [](const Varied& v) { return v.world.ground_surface.friction; }},
      {"delay", 0, 0.020, [](const Varied& v) { return v.twin.goal_delay_s; }},
      {"backlash", 0, 0.017453,
       [](const Varied& v) { return v.entity.joints[3].servo.backlash_rad; }},
      {"strength", 2.7, 3.3,
       [](const Varied& v) { return v.entity.joints[5].servo.stall_torque_n_m; }},
      {"rotor", 0.005, 0.015,
       [](const Varied& v) { return v.entity.joints[1].servo.gearbox.armature_kg_m2; }},
      {"gear friction", 0.035, 0.065,
       [](const Varied& v) { return v.entity.joints[1].servo.gearbox.f_base_n_m; }},
      {"gyro bias", -0.087266, 0.087266,
       [](const Varied& v) { return v.twin.gyro_bias_rad_s.y(); }},
      {"floor tilt", 0, 0.017453, [](const Varied& v) { return std::acos(v.world.up.z()); }},
      {"downhill", -3.14159266, 3.14159266,
       [](const Varied& v) { return std::atan2(v.world.up.y(), v.world.up.x()); }},
      {"supply", 11.1, 12.6, [](const Varied& v) { return v.twin.supply_v.value(); }},
  };
  return kNumbers;
}

TEST(Vary, NumbersFillTheirRangesEvenly) {
  for (const Drawn& number : numbers()) {
    std::vector<double> parts;
    for (std::uint64_t seed = 1; seed <= kRobots; ++seed) {
      const double value = number.value(varied(seed));
      ASSERT_GE(value, number.low - 1e-6) << number.name;
      ASSERT_LE(value, number.high + 1e-6) << number.name;
      parts.push_back((value - number.low) / (number.high - number.low));
    }
    // Kolmogorov-Smirnov: one in 10,000 sets of 1000 strays by more than 0.07.
    std::sort(parts.begin(), parts.end());
    for (int i = 0; i < kRobots; ++i)
      ASSERT_NEAR(parts[static_cast<std::size_t>(i)], (i + 0.5) / kRobots, 0.07) << number.name;
  }
}

TEST(Vary, EqualSeedsGiveEqualRobotsAndOthersDiffer) {
  EXPECT_EQ(varied(7).drawn, varied(7).drawn);
  EXPECT_NE(varied(7).drawn, varied(8).drawn);
  for (const Drawn& number : numbers()) {
    EXPECT_EQ(number.value(varied(7)), number.value(varied(7))) << number.name;
    EXPECT_NE(number.value(varied(7)), number.value(varied(8))) << number.name;
  }
}

TEST(Vary, DrawsAreIndependent) {
  std::map<std::string, std::vector<double>> drawn;
  for (std::uint64_t seed = 1; seed <= kRobots; ++seed) {
    const Varied v = varied(seed);
    for (const Drawn& number : numbers()) {
      drawn[number.name].push_back((number.value(v) - (number.low + number.high) / 2) /
                                   (number.high - number.low));
    }
  }
  for (const auto& [a, first] : drawn) {
    for (const auto& [b, second] : drawn) {
      if (a >= b) continue;
      double sum = 0;
      for (std::size_t i = 0; i < first.size(); ++i) sum += first[i] * second[i];
      EXPECT_LT(std::abs(12 * sum / kRobots), 0.16) << a << " and " << b;  // five sigma
    }
  }
  model::Entity fewer = robot();
  fewer.joints.resize(6);
  fewer.nodes.resize(7);
  const Varied small = vary(fewer, {.seed = 5}, {}), whole = varied(5);
  for (const Drawn& number : numbers())
    EXPECT_EQ(number.value(small), number.value(whole)) << number.name;
}

TEST(Vary, WithoutBandsTheRobotStaysAsItIs) {
  const Varied same = varied(3, {0, 0.8, 0.8, 0, 0, 0, 0, 0, 1, 1});
  const model::Entity nominal = robot();
  for (std::size_t n = 0; n < nominal.nodes.size(); ++n)
    EXPECT_EQ(same.entity.nodes[n].mass_kg, nominal.nodes[n].mass_kg);
  EXPECT_EQ(same.world.up, Vec3(0, 0, 1));
  EXPECT_EQ(same.twin.supply_v.value(), 12.0);
  EXPECT_EQ(same.twin.goal_delay_s, 0.0);
}

TEST(Vary, WhatWasDrawnIsSaid) {
  const Varied v = varied(9);
  const std::map<std::string, double> said(v.drawn.begin(), v.drawn.end());
  EXPECT_EQ(said.at("friction"), v.world.ground_surface.friction);
  EXPECT_EQ(said.at("goal_delay_s"), v.twin.goal_delay_s);
  EXPECT_EQ(said.at("supply_v"), v.twin.supply_v.value());
  EXPECT_NEAR(said.at("floor_tilt_rad"), std::acos(v.world.up.z()), 1e-9);
  EXPECT_LT(said.at("mass_factor_least"), said.at("mass_factor_most"));
}

TEST(GoalDelay, AServoActsWhenItsGoalArrives) {
  for (const std::uint32_t step_us : {1000U, 2000U}) {
    World world({.step_us = step_us, .gravity_m_s2 = 0, .ground = false});
    TwinRobot arm(
        world, test::arm(),
        {.imperfections = Imperfections::none(), .goal_delay_s = 0.02, .cradle = Cradle::kAlways});
    arm.setpoint(0).torque_on = true;
    arm.setpoint(0).goal_count = 3000;
    arm.advance_to(20'000);
    EXPECT_EQ(arm.body().angle_rad(0), 0.0) << step_us;
    arm.advance_to(24'000);
    EXPECT_GT(arm.body().angle_rad(0), 0.0) << step_us;
  }
}

// A level robot on a sloping floor feels gravity at that angle.
TEST(FloorTilt, TheAccelerometerFeelsTheSlope) {
  WorldOptions options;
  options.up = Vec3(std::sin(0.1), 0, std::cos(0.1));
  World world(options);
  TwinRobot biped(world, test::biped(),
                  {.imperfections = Imperfections::none(),
                   .gyro_bias_rad_s = Vec3(0.05, 0, -0.02),
                   .cradle = Cradle::kAlways});
  biped.advance_to(200'000);
  EXPECT_NEAR(biped.imu().accel_count[0] * 1e-3, 9.80665 * std::sin(0.1), 0.01);
  EXPECT_NEAR(biped.imu().accel_count[2] * 1e-3, 9.80665 * std::cos(0.1), 0.01);
  EXPECT_NEAR(biped.imu().gyro_count[0] * 1e-3, 0.05, 0.002);
  EXPECT_NEAR(biped.imu().gyro_count[2] * 1e-3, -0.02, 0.002);
}

}  // namespace
}  // namespace verp::sim
