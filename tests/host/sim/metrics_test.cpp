#include "host/twin/sim/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/gait/types.hpp"
#include "tests/host/sim/test_robots.hpp"

namespace verp::sim {
namespace {

constexpr double kTickS = 0.01;
constexpr int kTicksPerStep = 20;  // 5 in double support, then 15 in single

/// Along `heading`, with the ZMP at a given distance from the carrying foot.
struct ScriptedWalk {
  double heading_rad = 0;
  double step_m = 0.04;
  double zmp_off_m = 0.01;
  double turn_rad_per_step = 0;
  int start_steps = 2, transition_steps = 40, final_steps = 2;
  double fall_at_s = 1e9;
  int touch_every = 0;  ///< ticks
  double sole_n = 0;    ///< load on either sole
  WalkMeter meter{test::biped()};
  Observation now{};
  int ticks = 0;

  void place(double forward_m, double yaw_rad) {
    const Vec3 ahead(std::cos(heading_rad), std::sin(heading_rad), 0);
    const Vec3 left(-ahead.y(), ahead.x(), 0);
    for (std::size_t foot = 0; foot < 2; ++foot) {
      FootTruth& truth = now.truth.foot[foot];
      truth.present = truth.contact = true;
      truth.normal_force_n = sole_n;
      truth.sole_world.linear() = Eigen::AngleAxisd(heading_rad, Vec3::UnitZ()).toRotationMatrix();
      truth.sole_world.translation() = ahead * forward_m + left * (foot == 0 ? 0.04 : -0.04);
      truth.centroid_world_m = truth.sole_world.translation();
    }
    now.truth.yaw_rad = std::remainder(yaw_rad, 6.283185307179586);
  }

  void tick(gait::Phase phase, std::uint8_t stance, std::uint8_t state, int carrying) {
    now.truth.t_s = ticks * kTickS;
    now.truth.fallen = now.truth.t_s >= fall_at_s;
    now.steps = static_cast<std::uint64_t>(ticks) * 10;
    now.saturated_steps.assign(12, 0);
    now.saturated_steps[3] = now.steps / 4;
    if (touch_every > 0) now.self_contact_steps = static_cast<std::uint64_t>(ticks / touch_every);
    now.self_contact_nodes = {0, 3};
    now.supply_energy_j = 0.5 * ticks;
    now.joint_work_j = 0.2 * ticks;
    now.weight_n = 20;
    now.truth.torque_use.assign(12, phase == gait::Phase::kIdle ? 2.0 : 0.25);
    if (ticks == 300) now.truth.torque_use[4] = 0.75;
    now.loads = FootLoads{};
    const Vec3 sole = now.truth.foot[static_cast<std::size_t>(carrying)].centroid_world_m;
    now.loads.add(sole + Vec3(zmp_off_m, 0, 0), Vec3(0, 0, 30));
    Outputs outputs;
    outputs.gait_phase = static_cast<std::uint8_t>(phase);
    outputs.stance = stance;
    outputs.gait_state = state;
    meter.tick(now, outputs);
    ++ticks;
  }

  WalkMetrics run() {
    place(0, heading_rad);
    for (int i = 0; i < 10; ++i) tick(gait::Phase::kIdle, gait::kBoth, 0, 0);
    const int steps = start_steps + transition_steps + final_steps;
    for (int step = 0; step < steps; ++step) {
      const gait::Phase phase = step < start_steps                      ? gait::Phase::kStart
                                : step < start_steps + transition_steps ? gait::Phase::kTransition
                                                                        : gait::Phase::kFinal;
      const auto carrying = static_cast<std::uint8_t>(step % 2);
      for (int i = 0; i < kTicksPerStep; ++i) {
        const double done = step + static_cast<double>(i) / kTicksPerStep;
        place(done * step_m, heading_rad + done * turn_rad_per_step);
        const bool both = i < 5;
        // Loads are of the tick before.
        const int loaded = i == 0 ? 1 - carrying : carrying;
        tick(phase, both ? gait::kBoth : carrying, both ? 3 : 7, loaded);
      }
    }
    place(steps * step_m, heading_rad + steps * turn_rad_per_step);
    for (int i = 0; i < 10; ++i) tick(gait::Phase::kIdle, gait::kBoth, 0, (steps - 1) % 2);
    return meter.result();
  }
};

TEST(Metrics, MeasureAStraightWalkInAnyDirection) {
  for (const double heading : {0.0, 2.0}) {
    ScriptedWalk walk;
    walk.heading_rad = heading;
    const WalkMetrics m = walk.run();
    EXPECT_NEAR(m.duration_s, 8.99, 1e-9);
    EXPECT_NEAR(m.walk_s, 44 * 0.2, 1e-9);
    EXPECT_NEAR(m.distance_m, 44 * 0.04, 1e-9);
    EXPECT_NEAR(m.speed_mean_m_s.value_or(-1), 0.2, 1e-9);
    EXPECT_NEAR(m.speed_steady_m_s.value_or(-1), 0.2, 1e-9);
    EXPECT_NEAR(m.ahead_m, m.distance_m, 0.1) << "the last step is no whole cycle";
    EXPECT_NEAR(m.lateral_drift_m, 0, 1e-9);
    EXPECT_NEAR(m.yaw_drift_deg, 0, 1e-9);
    EXPECT_FALSE(m.fallen);
  }
}

TEST(Metrics, ZmpBiasIsTakenFromTheCarryingSoleAndInDoubleSupportFromTheNext) {
  ScriptedWalk walk;
  const WalkMetrics m = walk.run();
  EXPECT_NEAR(m.zmp_bias_by_state_mm[3].value_or(-1), 10, 1e-6);
  EXPECT_NEAR(m.zmp_bias_by_state_mm[7].value_or(-1), 10, 1e-6);
  EXPECT_FALSE(m.zmp_bias_by_state_mm[0]);
  EXPECT_NEAR(m.zmp_bias_mean_mm.value_or(-1), 10, 1e-6);
}

// The carrying sole slides for 15 of 20 ticks.
TEST(Metrics, OnlyASoleOnTheGroundSlips) {
  ScriptedWalk slides, floats;
  slides.heading_rad = 2.0;
  slides.sole_n = 30;
  EXPECT_NEAR(slides.run().slip_steady_m_s.value_or(-1), 0.75 * 0.2, 1e-9);
  EXPECT_NEAR(floats.run().slip_steady_m_s.value_or(-1), 0, 1e-9);
}

TEST(Metrics, YawIsCountedBeyondHalfATurn) {
  ScriptedWalk walk;
  walk.turn_rad_per_step = 0.1;
  EXPECT_NEAR(walk.run().yaw_drift_deg, 44 * 0.1 * 180 / 3.141592653589793, 1e-6);
}

// 880 ticks; standing does not count.
TEST(Metrics, TransportAndTorqueAreThoseOfTheWalkAlone) {
  ScriptedWalk walk;
  const WalkMetrics m = walk.run();
  EXPECT_NEAR(m.supply_energy_j, 0.5 * 880, 1e-9);
  EXPECT_NEAR(m.cost_of_transport.value_or(-1), 0.5 * 880 / (20 * m.distance_m), 1e-9);
  EXPECT_NEAR(m.cost_of_transport_mechanical.value_or(-1), 0.2 * 880 / (20 * m.distance_m), 1e-9);
  ASSERT_EQ(m.torque_use.size(), 12u);
  EXPECT_NEAR(m.torque_use[3].mean, 0.25, 1e-12);
  EXPECT_NEAR(m.torque_use[4].mean, 0.25 + 0.5 / 880, 1e-12);
  EXPECT_EQ(m.torque_use[4].peak, 0.75);
  ScriptedWalk shuffle;
  shuffle.step_m = 0.001;
  EXPECT_FALSE(shuffle.run().cost_of_transport) << "4 cm are no way";
}

TEST(Metrics, SaturationIsPerJointAndStep) {
  ScriptedWalk walk;
  const WalkMetrics m = walk.run();
  EXPECT_EQ(m.servo_saturation_worst_joint, 3);
  EXPECT_NEAR(m.servo_saturation_worst.value_or(-1), 0.25, 0.001);
  EXPECT_NEAR(m.servo_saturation.value_or(-1), 0.25 / 12, 0.0001);
}

TEST(Metrics, TouchingItselfIsCountedInTicksOfTheWalk) {
  ScriptedWalk walk;
  walk.touch_every = 40;
  const WalkMetrics m = walk.run();
  EXPECT_EQ(m.self_contact_ticks, 22U) << "880 ticks, one in 40";
  EXPECT_EQ(m.self_contact_links[0], "body");
  EXPECT_EQ(m.self_contact_links[1], "thigh");
  EXPECT_EQ(ScriptedWalk{}.run().self_contact_ticks, 0U);
}

TEST(Metrics, StopCountingWhenTheRobotFalls) {
  ScriptedWalk walk;
  walk.fall_at_s = 2.0;
  const WalkMetrics m = walk.run();
  EXPECT_TRUE(m.fallen);
  EXPECT_NEAR(m.walk_s, 1.9, 0.011);
  EXPECT_NEAR(m.distance_m, 1.9 / 0.2 * 0.04, 0.005);
}

TEST(Metrics, TooShortAWalkHasNoSteadySpeed) {
  ScriptedWalk walk;
  walk.transition_steps = 8;
  EXPECT_FALSE(walk.run().speed_steady_m_s);
}

TEST(Metrics, OfARobotThatStandsAreZeroOrMissing) {
  World world;
  const model::Entity entity = test::biped();
  TwinRobot robot(world, entity);
  WalkMeter meter(entity);
  for (std::uint64_t t = 0; t < 100'000; t += 10'000) {
    robot.advance_to(t);
    meter.tick(observe(robot), Outputs{});
  }
  const WalkMetrics m = meter.result();
  EXPECT_EQ(m.distance_m, 0);
  EXPECT_EQ(m.walk_s, 0);
  EXPECT_FALSE(m.zmp_bias_mean_mm);
  EXPECT_FALSE(m.speed_mean_m_s);
  EXPECT_FALSE(m.servo_saturation);
  ASSERT_EQ(meter.series().size(), 10U);
  EXPECT_NEAR(meter.series()[9].t_s, 0.09, 1e-12);
  EXPECT_EQ(meter.series()[9].goal_rad.size(), entity.joints.size());
}

TEST(Metrics, HullOfTwoSolesIsConvexAndCounterClockwise) {
  const std::vector<Vec2> hull =
      convex_hull({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {3, 0}, {3, 1}, {2, 0}, {2, 1}});
  ASSERT_EQ(hull.size(), 4U);
  double area = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2& a = hull[i];
    const Vec2& b = hull[(i + 1) % 4];
    area += (a.x() * b.y() - b.x() * a.y()) / 2;
  }
  EXPECT_NEAR(area, 3, 1e-12);
}

}  // namespace
}  // namespace verp::sim
