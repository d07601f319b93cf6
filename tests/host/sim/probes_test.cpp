#include "host/twin/sim/probes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/twin/sim/robot.hpp"
#include "tests/host/sim/test_robots.hpp"

namespace verp::sim::test {
namespace {

int foot_node_of(const model::Entity& entity, std::size_t foot) {
  return entity.limbs[foot].joints.back() + 1;
}

model::Entity metered() {
  model::Entity entity = biped();
  for (std::size_t foot = 0; foot < 2; ++foot) {
    model::ForceTorqueSensor wrench;
    wrench.name = wrench.topic = foot == 0 ? "left_ankle" : "right_ankle";
    wrench.node = foot_node_of(entity, foot);
    wrench.rate_hz = 200;
    entity.force_torques.push_back(wrench);
    model::ContactSensor contact;
    contact.name = contact.topic = foot == 0 ? "left_sole" : "right_sole";
    contact.node = wrench.node;
    contact.rate_hz = 100;
    entity.contacts.push_back(contact);
  }
  model::TruthSensor truth;
  truth.name = "truth";
  truth.rate_hz = 50;
  truth.pose.translation() = Vec3(0.01, 0.02, 0.03);
  truth.pose.linear() = Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix();
  entity.truths.push_back(truth);
  return entity;
}

struct Standing {
  explicit Standing(const model::Entity& entity, bool noise = false, std::uint64_t seed = 1)
      : robot(world, entity,
              {.seed = seed,
               .imperfections = noise ? Imperfections{} : Imperfections::none(),
               .initial_rad = crouch(entity, 0.1505)}) {
    for (int j = 0; j < static_cast<int>(entity.joints.size()); ++j) {
      robot.setpoint(j).torque_on = true;
      robot.setpoint(j).p_gain = 3500;
    }
  }
  World world;
  TwinRobot robot;
};

TEST(Probes, OnAStandingRobotsFeetTheForcesSumToItsWeight) {
  // Contacts chatter: the mean of all steps.
  model::Entity entity = metered();
  for (model::ForceTorqueSensor& each : entity.force_torques) each.rate_hz = 1000;
  for (model::ContactSensor& each : entity.contacts) each.rate_hz = 1000;
  Standing standing(entity);
  standing.robot.advance_to(2'500'000);
  standing.robot.take_readings();
  standing.robot.advance_to(3'000'000);
  ASSERT_FALSE(standing.robot.truth().held);
  const ProbeReadings readings = standing.robot.take_readings();
  ASSERT_EQ(readings.wrenches.size(), 1000u);
  ASSERT_EQ(readings.contacts.size(), 1000u);
  Vec3 ankles_n = Vec3::Zero(), soles_n = Vec3::Zero();
  for (const WrenchReading& each : readings.wrenches) {
    const int node = entity.force_torques[each.sensor].node;
    ankles_n += standing.robot.body().link_pose(node).linear() * each.force_n / 500;
  }
  for (const ContactReading& each : readings.contacts) {
    for (const Touch& touch : each.touches) {
      EXPECT_EQ(touch.other, "world");
      EXPECT_NEAR(touch.position_world_m.z(), 0, 0.001);
      soles_n += touch.force_world_n / 500;
    }
  }
  const double weight_n = standing.robot.weight_n();
  double feet_n = 0;
  for (std::size_t foot = 0; foot < 2; ++foot)
    feet_n += kGravity_m_s2 * standing.robot.body().mass_kg(foot_node_of(entity, foot));
  // The robot sways by half a percent.
  EXPECT_NEAR(soles_n.z(), weight_n, 0.005 * weight_n);
  EXPECT_NEAR(ankles_n.z() + feet_n, weight_n, 0.005 * weight_n) << "feet are beyond the ankles";
  EXPECT_NEAR(ankles_n.head<2>().norm(), 0, 0.005 * weight_n);
}

/// The body is held: all forces are known.
TEST(Probes, AJointThatHoldsAnArmOutBearsItsWeightAndItsLever) {
  model::Entity entity = arm();
  model::ForceTorqueSensor wrench;
  wrench.name = wrench.topic = "shoulder_load";
  wrench.node = 1;
  wrench.rate_hz = 1000;
  entity.force_torques = {wrench, wrench, wrench};
  entity.force_torques[1].on_child = true;
  // Halfway down the arm, turned about z.
  entity.force_torques[2].pose.translation() = Vec3(0, 0, -kArmLength / 2);
  entity.force_torques[2].pose.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix();
  World world({.ground = false});
  TwinRobot robot(world, entity,
                  {.imperfections = Imperfections::none(), .cradle = Cradle::kAlways});
  robot.setpoint(0).torque_on = true;
  robot.setpoint(0).goal_count -= 1024;  // a quarter turn
  robot.advance_to(2'700'000);
  robot.take_readings();
  robot.advance_to(3'000'000);
  const ProbeReadings readings = robot.take_readings();
  const Transform pose = robot.body().link_pose(1);
  const Vec3 down_n(0, 0, -kArmMass * kGravity_m_s2);
  const auto in_arm = [&](const Vec3& world_vector) -> Vec3 {
    return pose.linear().transpose() * world_vector;
  };
  const Vec3 lever_m(0, 0, -kArmLength);
  ASSERT_GT(std::abs(pose.linear()(2, 0)), 0.9) << "it is held out";
  // Mean: the servo swings by a count.
  const auto of = [&](std::size_t sensor) {
    WrenchReading mean;
    for (const WrenchReading& each : readings.wrenches) {
      if (each.sensor != sensor) continue;
      mean.force_n += each.force_n / 300;
      mean.torque_n_m += each.torque_n_m / 300;
    }
    return mean;
  };
  constexpr double kTolerance = 0.002;  // 4.9 N at rest
  EXPECT_LT((of(0).force_n - in_arm(down_n)).norm(), kTolerance);
  EXPECT_LT((of(0).torque_n_m - lever_m.cross(in_arm(down_n))).norm(), kTolerance);
  EXPECT_LT((of(1).force_n + of(0).force_n).norm(), 1e-12) << "what it is given";
  EXPECT_LT((of(1).torque_n_m + of(0).torque_n_m).norm(), 1e-12);
  const Mat3 turned = entity.force_torques[2].pose.linear().transpose();
  EXPECT_LT((of(2).force_n - turned * in_arm(down_n)).norm(), kTolerance);
  EXPECT_LT((of(2).torque_n_m - turned * (lever_m / 2).cross(in_arm(down_n))).norm(), kTolerance);
}

TEST(Probes, TruthIsTheTwinsPoseAtThatMoment) {
  const model::Entity entity = metered();
  Standing standing(entity, true);
  standing.robot.body().release();
  for (int i = 1; i <= 25; ++i) {
    standing.robot.advance_to(20'000 * static_cast<std::uint64_t>(i));
    const ProbeReadings readings = standing.robot.take_readings();
    ASSERT_EQ(readings.truths.size(), 1u);
    const TruthReading& reading = readings.truths[0];
    EXPECT_EQ(reading.time_us, standing.world.now_us());
    const Truth truth = standing.robot.truth();
    const Transform meant = truth.body_world * entity.truths[0].pose;
    EXPECT_EQ(reading.world_sensor.matrix(), meant.matrix());
    const Vec3 lever = truth.body_world.linear() * entity.truths[0].pose.translation();
    const Vec3 velocity = truth.body_velocity_world_m_s + truth.body_rate_world_rad_s.cross(lever);
    EXPECT_LT((meant.linear() * reading.velocity_m_s - velocity).norm(), 1e-12);
    EXPECT_LT((meant.linear() * reading.rate_rad_s - truth.body_rate_world_rad_s).norm(), 1e-12);
  }
}

TEST(Probes, NoiseHasItsSizeAndLatencyItsLength) {
  model::Entity entity = metered();
  entity.truths.push_back(entity.truths[0]);
  model::TruthSensor& noisy = entity.truths[1];
  noisy.position_noise_m = 0.01;
  noisy.angle_noise_rad = 0.02;
  entity.force_torques.push_back(entity.force_torques[0]);
  model::ForceTorqueSensor& wrench = entity.force_torques.back();
  wrench.force_mean_n = Vec3(1, 0, 0);
  wrench.force_stddev_n = Vec3(0, 0, 0.5);
  entity.contacts[1].latency_s = 0.05;
  Standing standing(entity, true);
  standing.robot.advance_to(1'000'000);
  const ProbeReadings a = standing.robot.take_readings();
  ASSERT_EQ(a.truths.size(), 100u);
  double position = 0, angle = 0;
  std::vector<TruthReading> clean, seen;
  for (const TruthReading& each : a.truths) (each.sensor == 0 ? clean : seen).push_back(each);
  ASSERT_EQ(clean.size(), seen.size());
  for (std::size_t i = 0; i < clean.size(); ++i) {
    const Transform off = clean[i].world_sensor.inverse() * seen[i].world_sensor;
    position += off.translation().squaredNorm() / 3;
    angle += std::pow(Eigen::AngleAxisd(off.linear()).angle(), 2) / 3;
  }
  EXPECT_NEAR(std::sqrt(position / 50), 0.01, 0.0025);
  EXPECT_NEAR(std::sqrt(angle / 50), 0.02, 0.005);
  std::vector<Vec3> off_n;
  for (const WrenchReading& each : a.wrenches) {
    if (each.sensor == 0) off_n.push_back(-each.force_n);
  }
  std::size_t next = 0;
  double mean_x = 0, square_z = 0;
  for (const WrenchReading& each : a.wrenches) {
    if (each.sensor != 2) continue;
    const Vec3 off = off_n.at(next++) + each.force_n;
    mean_x += off.x() / 200;
    square_z += off.z() * off.z() / 200;
    EXPECT_NEAR(off.y(), 0, 1e-12);
  }
  EXPECT_EQ(next, 200u);
  EXPECT_NEAR(mean_x, 1, 1e-9);
  EXPECT_NEAR(std::sqrt(square_z), 0.5, 0.1);
  std::uint64_t prompt_us = 0, late_us = 0;
  for (const ContactReading& each : a.contacts)
    (each.sensor == 0 ? prompt_us : late_us) = each.time_us;
  EXPECT_EQ(prompt_us, 1'000'000u);
  EXPECT_EQ(late_us, 950'000u);
}

TEST(Probes, AndTheyChangeNoBitOfTheRun) {
  Standing with(metered(), true), without(biped(), true);
  for (Standing* each : {&with, &without}) each->robot.advance_to(2'000'000);
  EXPECT_EQ(with.robot.body().angles_rad(), without.robot.body().angles_rad());
  EXPECT_EQ(with.robot.body().rates_rad_s(), without.robot.body().rates_rad_s());
  EXPECT_EQ(with.robot.truth().body_world.matrix(), without.robot.truth().body_world.matrix());
  EXPECT_EQ(with.robot.imu().accel_count, without.robot.imu().accel_count);
}

}  // namespace
}  // namespace verp::sim::test
