#include "host/study/identify/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "host/twin/sim/robot.hpp"
#include "tests/host/sim/test_robots.hpp"

// From motion alone, under encoder noise. Undetermined numbers are reported.

namespace verp::identify {
namespace {

constexpr std::uint16_t kP = 800, kD = 90;

model::Entity arm() {
  model::Entity entity = sim::test::arm();
  model::Servo& servo = entity.joints[0].servo;
  servo.p_gain = kP;
  servo.d_gain = kD;
  servo.loop_delay_s = 384e-6;
  servo.gearbox = {.armature_kg_m2 = 0.006,
                   .f_base_n_m = 0.03,
                   .f_strib_n_m = 0.04,
                   .l_base = 0.01,
                   .l_strib = 0.2,
                   .w_s_rad_s = 1.6,
                   .alpha = 1.3,
                   .f_visc_n_m_s = 0.01};
  return entity;
}

/// Fast for `fast_s`, then slowly.
Recording told(const model::Entity& entity, double fast_s, double length_s) {
  Recording recording;
  recording.params.joint_count = 1;
  recording.params.joint[0].counts_per_rad = 4096 / (2 * std::numbers::pi_v<float>);
  recording.params.servo[0].position_p_gain = kP;
  recording.params.servo[0].position_d_gain = kD;
  recording.params.servo[0].profile_ms = 10;
  recording.supply_v = 12;
  sim::World world;
  sim::TwinOptions options;
  options.seed = 7;
  options.cradle = sim::Cradle::kAlways;
  options.start_m = sim::Vec3(0, 0, 1);
  sim::TwinRobot robot(world, entity, options);
  robot.setpoint(0) = {.torque_on = true, .goal_count = 2048, .p_gain = kP, .d_gain = kD};
  robot.setpoint(0).profile_ms = 10;
  const TickTimes times = times_of(recording.params);
  const auto ticks = static_cast<std::uint32_t>(length_s * 100);
  for (std::uint32_t i = 0; i < ticks; ++i) {
    const double t = 0.01 * i;
    const double rad = t < fast_s ? 0.6 * std::sin(5 * t) + 0.3 * std::sin(14 * t)
                                  : 0.6 * std::sin(0.6 * (t - fast_s));
    robot.advance_to(10'000 * i + times.read_us);
    Recording::Tick& tick = recording.ticks.emplace_back();
    tick.slot = i;
    tick.fresh = 1;
    tick.position = {robot.measure(0).position_count};
    tick.goal = {static_cast<std::int32_t>(std::lround(2048 + 4096 * rad / 6.283185))};
    robot.advance_to(10'000 * i + times.goal_us);
    robot.setpoint(0).goal_count = tick.goal[0];
  }
  return recording;
}

model::Entity believed() {
  model::Entity entity = arm();
  double factor = 1.25;
  for (const Number& number : numbers()) {
    number.set(entity.joints[0].servo, factor * number.get(entity.joints[0].servo));
    factor = 1 / factor;
  }
  return entity;
}

TEST(Fit, FindsTheNumbersOfATwinThatWasGivenOthers) {
  model::Entity robot = arm();
  robot.joints[0].servo.goal_delay_s = 0.004;
  const Recording recording = told(robot, 5, 12);
  const model::Entity entity = believed();
  const survey::Watch nobody;
  Fit fit(entity, recording, "test", nobody);
  Estimate estimate = fit.start();
  fit.improve(estimate, recording.ticks.size(), 7);
  for (std::size_t i = 0; i < numbers().size(); ++i) {
    if (std::string(numbers()[i].name) == "backlash_rad") continue;  // this servo has no play
    const double truth = numbers()[i].get(robot.joints[0].servo);
    EXPECT_NEAR(estimate.value[i], truth, 0.1 * truth) << numbers()[i].name;
  }
  EXPECT_NEAR(estimate.value.back(), 4000, 500);
  const auto before = fit.predict(fit.start(), recording.ticks.size());
  const auto after = fit.predict(estimate, recording.ticks.size());
  EXPECT_LT(fit.rms_rad(after, 0, recording.ticks.size()),
            0.3 * fit.rms_rad(before, 0, recording.ticks.size()));
}

// The motion is too slow to show a delay of a few ms.
TEST(Fit, LeavesANumberThatTheMotionDoesNotTell) {
  const Recording recording = told(arm(), 0, 12);
  model::Entity entity = believed();
  entity.joints[0].servo.goal_delay_s = 0.002;
  const survey::Watch nobody;
  Fit fit(entity, recording, "test", nobody);
  Estimate estimate = fit.start();
  fit.improve(estimate, recording.ticks.size(), 3);
  fit.leave_what_is_not_told(estimate, recording.ticks.size());
  EXPECT_FALSE(estimate.free.back());
  EXPECT_EQ(estimate.value.back(), 2000);
}

}  // namespace
}  // namespace verp::identify
