#include "host/twin/sim/robot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>
#include <vector>

#include "tests/host/sim/test_robots.hpp"

namespace verp::sim {
namespace {

TwinOptions crouched(const model::Entity& entity, std::uint64_t seed = 1) {
  TwinOptions options;
  options.seed = seed;
  options.initial_rad = test::crouch(entity, 0.1505);
  return options;
}

/// By Plant alone: torque on, hold the present goal.
void arm_all(Plant& plant, int joints) {
  for (int j = 0; j < joints; ++j) {
    plant.setpoint(j).torque_on = true;
    plant.setpoint(j).p_gain = 3500;
  }
}

int joints_of(const model::Entity& entity) {
  return static_cast<int>(entity.joints.size());
}

TEST(Robot, StartsWithLevelSolesJustAboveTheGroundUnderItsStart) {
  World world;
  const model::Entity entity = test::biped();
  TwinOptions options = crouched(entity);
  options.imperfections = Imperfections::none();
  options.start_m = Vec3(1, 2, 0);
  options.start_yaw_rad = 0.5;
  // With bent hips, the body leans to keep the soles level.
  for (const model::Limb& limb : entity.limbs)
    options.initial_rad[static_cast<std::size_t>(limb.joints[2])] -= 0.2;
  TwinRobot robot(world, entity, options);
  const Truth truth = robot.truth();
  EXPECT_NEAR(truth.pitch_rad, 0.2, 1e-9);
  EXPECT_NEAR(truth.yaw_rad, 0.5, 1e-9);
  const Vec3 middle = (truth.foot[0].centroid_world_m + truth.foot[1].centroid_world_m) / 2;
  EXPECT_NEAR(middle.x(), 1, 1e-9);
  EXPECT_NEAR(middle.y(), 2, 1e-9);
  for (const FootTruth& foot : truth.foot) {
    for (const Vec3& corner : foot.corner_world_m) EXPECT_NEAR(corner.z(), 0.0002, 1e-9);
  }
}

TEST(Robot, StandsThreeSecondsOnItsServos) {
  World world;
  const model::Entity entity = test::biped();
  TwinRobot robot(world, entity, crouched(entity));
  arm_all(robot, joints_of(entity));
  robot.advance_to(4'200'000);
  EXPECT_FALSE(robot.truth().held);
  EXPECT_FALSE(robot.fallen());
  EXPECT_LT(std::abs(robot.truth().roll_rad), 0.05);
  EXPECT_LT(std::abs(robot.truth().pitch_rad), 0.05);
}

TEST(Robot, AtRestZmpIsTheProjectionOfTheCentreOfMassAndFeetCarryTheWeight) {
  World world;
  const model::Entity entity = test::biped();
  TwinRobot robot(world, entity, crouched(entity));
  arm_all(robot, joints_of(entity));
  robot.advance_to(2'000'000);
  robot.take_foot_loads();
  robot.advance_to(3'000'000);
  const FootLoads mean = robot.take_foot_loads();
  const Truth truth = robot.truth();
  ASSERT_TRUE(truth.zmp_valid);
  EXPECT_LT((mean.zmp_world_m() - truth.com_world_m.head<2>()).norm(), 0.0005);
  const double weight = robot.body().mass_kg() * test::kGravity_m_s2;
  EXPECT_NEAR(mean.force_n() / 1000, weight, 0.01 * weight);
  EXPECT_NEAR(truth.foot[0].normal_force_n + truth.foot[1].normal_force_n, weight, 0.02 * weight);
  double sensed = 0;
  for (int foot = 0; foot < 2; ++foot) {
    for (const std::uint16_t count : robot.foot_counts(foot)) sensed += count * 0.01;
  }
  EXPECT_NEAR(sensed, weight, 0.02 * weight);
  EXPECT_GE(truth.support_world_m.size(), 4U);  // 4 to 8: the soles are not quite parallel
}

TEST(Robot, FootSensorsKeepTheCentreOfPressure) {
  const model::Entity entity = test::biped();
  FootModel foot(entity.limbs[0], 0.001, false, Random(1, Draw::kFootNoise));
  foot.begin_step();
  foot.add_load(Vec3(0.026, -0.011, 0), 8.0);
  foot.end_step(0.001);
  const auto& n = foot.counts();
  const double sum = n[0] + n[1] + n[2] + n[3];
  EXPECT_NEAR(sum, 8000, 3);
  EXPECT_NEAR(0.052 * (n[0] + n[1] - n[2] - n[3]) / sum, 0.026, 1e-4);
  EXPECT_NEAR(0.033 * (n[0] + n[2] - n[1] - n[3]) / sum, -0.011, 1e-4);
}

// Mean of a second: servos hum by a count.
TEST(Robot, ImuReadsOneGUpwardAtRest) {
  World world;
  const model::Entity entity = test::biped();
  TwinOptions options = crouched(entity);
  options.imperfections = Imperfections::none();
  TwinRobot robot(world, entity, options);
  arm_all(robot, joints_of(entity));
  robot.advance_to(2'000'000);
  Vec3 accel = Vec3::Zero();
  Vec3 gyro = Vec3::Zero();
  for (int ms = 0; ms < 1000; ++ms) {
    robot.advance_to(robot.now_us() + 1000);
    const ImuMeasurement imu = robot.imu();
    accel += Vec3(imu.accel_count[0], imu.accel_count[1], imu.accel_count[2]) * 1e-6;
    gyro += Vec3(imu.gyro_count[0], imu.gyro_count[1], imu.gyro_count[2]) * 1e-6;
  }
  const double pitch = robot.truth().pitch_rad;
  EXPECT_NEAR(accel.z(), test::kGravity_m_s2 * std::cos(pitch), 0.01);
  EXPECT_NEAR(accel.x(), -test::kGravity_m_s2 * std::sin(pitch), 0.01);
  EXPECT_NEAR(accel.y(), 0, 0.01);
  EXPECT_LT(gyro.norm(), 0.002);
}

// It sees body x as its -y.
TEST(Robot, ImuMeasuresInItsOwnAxes) {
  model::ImuSensor sensor = *test::biped().imu;
  ImuModel imu(sensor, 0, false, 1);
  const Mat3 world_imu = Eigen::AngleAxisd(1.5707963267948966, Vec3::UnitZ()).toRotationMatrix();
  imu.sample(world_imu, Vec3(1.5, 0, 0), Vec3(2, 0, 0), Vec3(0, 0, test::kGravity_m_s2), 0.001);
  EXPECT_EQ(imu.measurement().gyro_count[1], -1500);
  EXPECT_EQ(imu.measurement().gyro_count[0], 0);
  EXPECT_EQ(imu.measurement().accel_count[1], -2000);
  EXPECT_EQ(imu.measurement().accel_count[2], 9807);
}

// A landing's jolt, shorter than a period, at any moment.
TEST(Robot, WhatTheGyroTellsOncePerPeriodAddsUpToTheTurn) {
  constexpr double kStep_s = 0.001, kMean_s = 0.01, kJolt_rad_s = 1;
  model::ImuSensor sensor;
  sensor.gyro_rad_s_per_count = 1e-4;
  for (int jolt_at = 100; jolt_at < 110; ++jolt_at) {
    ImuModel imu(sensor, kMean_s, false, 1);
    double turned_rad = 0;
    for (int i = 0; i < 200; ++i) {
      const bool jolts = i >= jolt_at && i < jolt_at + 5;
      imu.sample(Mat3::Identity(), Vec3(0, 0, jolts ? kJolt_rad_s : 0), Vec3::Zero(), Vec3::Zero(),
                 kStep_s);
      if (i % 10 == 9)
        turned_rad += kMean_s * sensor.gyro_rad_s_per_count * imu.measurement().gyro_count[2];
    }
    EXPECT_NEAR(turned_rad, 5 * kStep_s * kJolt_rad_s, 1e-5) << jolt_at;
  }
}

TEST(Robot, TheImuOfARobotIsMeantOverItsControlPeriod) {
  const auto falling = [](std::uint32_t period_us, World& world) {
    model::Entity entity = test::biped();
    entity.period_us = period_us;
    TwinOptions options = crouched(entity);
    options.imperfections = Imperfections::none();
    options.cradle = Cradle::kNone;
    return std::make_unique<TwinRobot>(world, entity, options);
  };
  World each_world, mean_world;
  const auto each = falling(1'000, each_world), mean = falling(10'000, mean_world);
  std::vector<double> counts;
  for (std::uint64_t t_us = 1'000; t_us <= 600'000; t_us += 1'000) {
    each->advance_to(t_us);
    mean->advance_to(t_us);
    counts.push_back(each->imu().gyro_count[1]);
    if (t_us < 500'000) continue;
    const double sum = std::accumulate(counts.end() - 10, counts.end(), 0.0);
    EXPECT_NEAR(mean->imu().gyro_count[1], sum / 10, 0.5) << t_us;
  }
  EXPECT_GT(std::abs(counts.back() - counts[counts.size() - 10]), 5) << "so that a mean is another";
}

// Density over the root of twice the time, whatever the physics step.
TEST(Robot, GyroNoiseOfAMeanIsThatOfItsDensity) {
  constexpr double kDensity = 3e-4, kMean_s = 0.01;
  model::ImuSensor sensor;
  sensor.gyro_rad_s_per_count = 1e-5;
  sensor.gyro_noise_rad_s_rthz = kDensity;
  for (const int step_ms : {1, 2}) {
    ImuModel imu(sensor, kMean_s, true, 7);
    double squares = 0;
    constexpr int kMeans = 200, kOfTicks = 100;
    for (int mean = 0; mean < kMeans; ++mean) {
      double sum_rad_s = 0;
      for (int tick = 0; tick < kOfTicks; ++tick) {
        for (int i = 0; i < 10 / step_ms; ++i)
          imu.sample(Mat3::Identity(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 1e-3 * step_ms);
        sum_rad_s += sensor.gyro_rad_s_per_count * imu.measurement().gyro_count[2];
      }
      squares += std::pow(sum_rad_s / kOfTicks, 2);
    }
    const double expected = kDensity / std::sqrt(2 * kMean_s * kOfTicks);
    // One sigma of 200 means is 5 %.
    EXPECT_NEAR(std::sqrt(squares / kMeans), expected, 0.2 * expected) << step_ms << " ms";
  }
}

TEST(Robot, ImuFeelsNothingInFreeFallAndSaturatesInsteadOfWrapping) {
  World world;
  const model::Entity entity = test::biped();
  TwinOptions options = crouched(entity);
  options.imperfections = Imperfections::none();
  options.cradle = Cradle::kNone;
  model::Entity floating = entity;
  for (model::Node& node : floating.nodes) node.collisions.clear();
  TwinRobot robot(world, floating, options);
  robot.advance_to(100'000);
  for (const std::int16_t count : robot.imu().accel_count) EXPECT_LE(std::abs(count), 20);
  ImuModel imu(*entity.imu, 0, false, 1);
  imu.sample(Mat3::Identity(), Vec3(1000, -1000, 0), Vec3::Zero(), Vec3(0, 0, test::kGravity_m_s2),
             0.001);
  EXPECT_EQ(imu.measurement().gyro_count[0], 32767);
  EXPECT_EQ(imu.measurement().gyro_count[1], -32768);
}

TEST(Robot, FallsWhenNobodyHoldsItAndTorqueIsOff) {
  World world;
  const model::Entity entity = test::biped();
  TwinOptions options = crouched(entity);
  options.cradle = Cradle::kNone;
  TwinRobot robot(world, entity, options);
  robot.advance_to(2'000'000);
  EXPECT_TRUE(robot.fallen());
}

// The height counts from its feet.
TEST(Robot, DownFromWhatItStoodOnIsNoFallUntilItLies) {
  World world;
  const model::Entity entity = test::biped();
  TwinOptions options = crouched(entity);
  options.cradle = Cradle::kNone;
  options.start_m.z() = 1;
  TwinRobot robot(world, entity, options);
  robot.advance_to(300'000);
  EXPECT_LT(robot.truth().body_world.translation().z(), 1) << "its feet stood there";
  EXPECT_FALSE(robot.fallen());
  robot.advance_to(3'000'000);
  EXPECT_TRUE(robot.fallen());
}

TEST(Robot, CradleHoldsUntilTheLegsAreArmed) {
  World world;
  const model::Entity entity = test::biped();
  TwinRobot robot(world, entity, crouched(entity));
  robot.advance_to(1'000'000);
  EXPECT_TRUE(robot.truth().held);
  EXPECT_FALSE(robot.fallen());
  for (int j = 0; j < joints_of(entity); ++j) {  // hold the dangling legs
    robot.setpoint(j).goal_count = robot.servo(j).measurement().position_count;
  }
  arm_all(robot, joints_of(entity));
  robot.advance_to(2'190'000);
  EXPECT_TRUE(robot.truth().held);
  robot.advance_to(2'210'000);
  EXPECT_FALSE(robot.truth().held);
}

TEST(Robot, IsSetOnItsFeetWhenItIsLimpAndHeldUntilItIsArmed) {
  World world;
  const model::Entity entity = test::biped();
  TwinRobot robot(world, entity, crouched(entity));
  robot.advance_to(100'000);
  for (int time = 0; time < 2; ++time) {
    robot.release();
    robot.advance_to(world.now_us() + 2'000'000);
    ASSERT_TRUE(robot.fallen());
    const Vec3 lies_m = robot.truth().body_world.translation();
    robot.setpoint(1).torque_on = true;
    EXPECT_FALSE(robot.set_upright()) << "its servos would fight the hands";
    EXPECT_TRUE(robot.fallen());
    robot.setpoint(1).torque_on = false;
    ASSERT_TRUE(robot.set_upright());
    const Transform stands = robot.truth().body_world;
    EXPECT_FALSE(robot.fallen());
    EXPECT_TRUE(robot.truth().held);
    EXPECT_GT(stands.linear()(2, 2), 0.99);
    EXPECT_LT((stands.translation() - lies_m).head<2>().norm(), 0.1) << "where it lay";
    robot.advance_to(world.now_us() + 1'000'000);
    EXPECT_TRUE(robot.truth().held) << "nobody has armed it";
    EXPECT_FALSE(robot.fallen());
  }
}

struct Sample {
  std::vector<std::int32_t> counts;
  Truth truth;
};

Sample run(std::uint64_t seed, bool read_often) {
  World world;
  const model::Entity entity = test::biped();
  TwinRobot robot(world, entity, crouched(entity, seed));
  arm_all(robot, joints_of(entity));
  Sample sample;
  for (std::uint64_t t = 10'000; t <= 1'000'000; t += 10'000) {
    for (const model::Limb& limb : entity.limbs) {
      const double knee = count_of(entity.joints[static_cast<std::size_t>(limb.joints[3])].servo,
                                   1.2 + 0.2 * std::sin(static_cast<double>(t) * 1e-5));
      robot.setpoint(limb.joints[3]).goal_count = static_cast<std::int32_t>(knee);
    }
    robot.advance_to(t);
    if (read_often) {
      robot.imu();
      robot.imu();
      robot.measure(3);
      robot.foot_counts(0);
    }
    for (int j = 0; j < joints_of(entity); ++j)
      sample.counts.push_back(robot.measure(j).position_count);
    for (const std::int16_t count : robot.imu().gyro_count) sample.counts.push_back(count);
    for (const std::int16_t count : robot.imu().accel_count) sample.counts.push_back(count);
    for (const std::uint16_t count : robot.foot_counts(1)) sample.counts.push_back(count);
  }
  sample.truth = robot.truth();
  return sample;
}

bool same_bits(const Truth& a, const Truth& b) {
  return std::memcmp(a.body_world.data(), b.body_world.data(), 16 * sizeof(double)) == 0 &&
         std::memcmp(a.joint_rad.data(), b.joint_rad.data(), a.joint_rad.size() * sizeof(double)) ==
             0 &&
         std::memcmp(a.zmp_world_m.data(), b.zmp_world_m.data(), 2 * sizeof(double)) == 0;
}

TEST(Determinism, OneSeedGivesOneRunToTheLastBit) {
  const Sample first = run(7, false);
  const Sample again = run(7, false);
  EXPECT_EQ(first.counts, again.counts);
  EXPECT_TRUE(same_bits(first.truth, again.truth));
}

TEST(Determinism, ReadingSensorsMoreOftenChangesNothing) {
  const Sample rare = run(7, false);
  const Sample often = run(7, true);
  EXPECT_EQ(rare.counts, often.counts);
  EXPECT_TRUE(same_bits(rare.truth, often.truth));
}

TEST(Determinism, SeedsDiffer) {
  EXPECT_NE(run(7, false).counts, run(8, false).counts);
}

TEST(Determinism, HowTimeIsCutIntoCallsDoesNotMatter) {
  const model::Entity entity = test::biped();
  std::vector<Truth> end;
  for (const std::uint64_t cut_us : {1'000U, 3'700U, 500'000U}) {
    World world;
    TwinRobot robot(world, entity, crouched(entity));
    arm_all(robot, joints_of(entity));
    for (std::uint64_t t = cut_us; t < 500'000; t += cut_us) robot.advance_to(t);
    robot.advance_to(500'000);
    EXPECT_EQ(robot.now_us(), 500'000U);
    robot.advance_to(400'000);  // never back
    EXPECT_EQ(robot.now_us(), 500'000U);
    end.push_back(robot.truth());
  }
  EXPECT_TRUE(same_bits(end[0], end[1]));
  EXPECT_TRUE(same_bits(end[0], end[2]));
}

TEST(Random, NormalHasMeanZeroAndDeviationOne) {
  Random random(3, Draw::kImuNoise);
  double sum = 0;
  double squares = 0;
  constexpr int kDraws = 200'000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.01);
  EXPECT_NEAR(squares / kDraws, 1, 0.01);
}

TEST(World, TwoRobotsStandSideBySide) {
  World world;
  const model::Entity entity = test::biped();
  TwinOptions left = crouched(entity, 1);
  TwinOptions right = crouched(entity, 2);
  left.start_m = Vec3(0, 0.3, 0);
  right.start_m = Vec3(0, -0.3, 0);
  TwinRobot a(world, entity, left);
  TwinRobot b(world, entity, right);
  arm_all(a, joints_of(entity));
  arm_all(b, joints_of(entity));
  a.advance_to(3'000'000);
  EXPECT_FALSE(a.fallen());
  EXPECT_FALSE(b.fallen());
  EXPECT_NEAR(b.truth().foot[0].normal_force_n + b.truth().foot[1].normal_force_n,
              b.body().mass_kg() * test::kGravity_m_s2, 1.0);
}

}  // namespace
}  // namespace verp::sim
