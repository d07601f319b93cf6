#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "host/twin/sim/robot.hpp"
#include "host/twin/sim/scenery.hpp"
#include "tests/host/sim/test_robots.hpp"

// A reading at t shows t - latency.
namespace verp::sim::test {
namespace {

constexpr double kLate_s = 0.03;
constexpr std::uint64_t kLate_us = 30'000;

model::Entity falling_biped(double latency_s) {
  model::Entity entity = biped();
  for (model::Node& node : entity.nodes) node.collisions.clear();
  entity.imu->latency_s = latency_s;
  return entity;
}

struct Fall {
  explicit Fall(const model::Entity& entity, bool noise = true)
      : robot(world, entity,
              {.imperfections = noise ? Imperfections{} : Imperfections::none(),
               .start_m = {0, 0, 20},
               .cradle = Cradle::kNone,
               .cameras = true}) {}
  void step() { world.advance_to(world.now_us() + 1000); }
  World world{{.ground = false}};
  TwinRobot robot;
};

TEST(Latency, TheImuTellsWhatOneWithoutItToldSoManyStepsAgo) {
  Fall prompt(falling_biped(0)), late(falling_biped(kLate_s));
  std::vector<ImuMeasurement> told;
  for (std::size_t i = 0; i < 200; ++i) {
    for (Fall* each : {&prompt, &late}) {
      each->robot.body().add_velocity(Vec3::Zero(), Vec3(0.02, -0.01, 0.005));
      each->step();
    }
    told.push_back(prompt.robot.imu());
    const ImuMeasurement& meant = told[i < 30 ? 0 : i - 30];
    EXPECT_EQ(late.robot.imu().gyro_count, meant.gyro_count) << i;
    EXPECT_EQ(late.robot.imu().accel_count, meant.accel_count) << i;
  }
  EXPECT_NE(told[199].gyro_count, told[169].gyro_count) << "and that is another";
}

TEST(Latency, OfARateThatRisesEvenlyTheGyroLagsByItsSlopeTimesTheLatency) {
  model::ImuSensor sensor = *biped().imu;
  sensor.latency_s = kLate_s;
  ImuModel late(sensor, 0, false, 1);
  sensor.latency_s = 0;
  ImuModel prompt(sensor, 0, false, 1);
  constexpr double kSlope_rad_s2 = 20, kStep_s = 0.001;
  for (int i = 0; i < 500; ++i) {
    const Vec3 rate(kSlope_rad_s2 * kStep_s * i, 0, 0);
    for (ImuModel* each : {&late, &prompt})
      each->sample(Mat3::Identity(), rate, Vec3::Zero(), Vec3::Zero(), kStep_s);
  }
  // Both have the filter's lag.
  const int gap = prompt.measurement().gyro_count[0] - late.measurement().gyro_count[0];
  EXPECT_NEAR(gap * sensor.gyro_rad_s_per_count, kSlope_rad_s2 * kLate_s,
              sensor.gyro_rad_s_per_count);
}

TEST(Latency, ALaserSeesAWallThatComesWhereItWas) {
  model::WorldObject wall;
  wall.name = "wall";
  wall.kind = model::WorldObject::Kind::kMoving;
  wall.collisions.resize(1);
  wall.collisions[0].shape.size_m = {0.2, 4, 4};
  constexpr double kFrom_m = 3, kSpeed_m_s = 0.5;
  for (const double t_s : {0.0, 4.0}) {
    model::Waypoint point{.t_s = t_s, .pose = Transform::Identity()};
    point.pose.translation() = Vec3(kFrom_m + 0.1 - kSpeed_m_s * t_s, 0, 0);
    wall.waypoints.push_back(point);
  }
  wall.pose = wall.waypoints[0].pose;
  auto data = std::make_shared<model::World>();
  data->objects = {wall};
  model::Entity entity = arm();
  model::LaserSensor laser;
  laser.name = "laser";
  laser.rate_hz = 20;
  laser.max_m = 5;
  laser.latency_s = kLate_s;
  entity.lasers = {laser};
  World world({.ground = false, .scenery = data});
  TwinRobot robot(world, entity,
                  {.imperfections = Imperfections::none(), .cradle = Cradle::kAlways});
  const double at_m = robot.body().link_pose(0).translation().x();
  int scans = 0;
  for (std::uint64_t t_us = 1000; t_us <= 1'000'000; t_us += 1000) {
    world.advance_to(t_us);
    for (const Scan& scan : robot.take_scans()) {
      ++scans;
      EXPECT_EQ(scan.time_us, t_us - kLate_us);
      EXPECT_EQ(scan.time_us, 50'000u * static_cast<std::uint64_t>(scans));
      const double then_m = kFrom_m - kSpeed_m_s * 1e-6 * static_cast<double>(scan.time_us) - at_m;
      // A step moves the wall by 0.5 mm.
      EXPECT_NEAR(static_cast<double>(scan.range_m.at(0)), then_m, 0.6e-3) << t_us;
    }
  }
  EXPECT_EQ(scans, 19) << "that of 1 s is on its way";
}

TEST(Latency, ACameraShowsARobotThatFallsWhereItWas) {
  model::Entity entity = falling_biped(0);
  model::CameraSensor eye;
  eye.name = "eye";
  eye.rate_hz = 50;
  entity.cameras = {eye, eye, eye};
  entity.cameras[1].latency_s = entity.cameras[2].latency_s = kLate_s;
  Fall fall(entity, false);
  const double from_m = fall.robot.body().link_pose(0).translation().z();
  int prompt = 0, late = 0;
  for (int i = 0; i < 500; ++i) {
    fall.step();
    for (const Exposure& each : fall.robot.take_exposures()) {
      const bool is_late = each.cameras.size() == 2;
      ++(is_late ? late : prompt);
      EXPECT_EQ(each.cameras,
                is_late ? (std::vector<std::size_t>{1, 2}) : (std::vector<std::size_t>{0}));
      EXPECT_EQ(fall.world.now_us() - each.time_us, is_late ? kLate_us : 0);
      EXPECT_EQ(each.time_us % 20'000, 0u);
      const double t_s = 1e-6 * static_cast<double>(each.time_us);
      // By the engine's steps, z = -g t (t + h) / 2.
      EXPECT_NEAR(each.link_world.at(0).at(0).translation().z(),
                  from_m - kGravity_m_s2 * t_s * (t_s + 0.001) / 2, 1e-6);
    }
  }
  EXPECT_EQ(prompt, 25);
  EXPECT_EQ(late, 23);
}

TEST(Latency, ACameraShowsTheOtherRobotsWhereTheyWereToo) {
  const model::Entity blind = falling_biped(0);
  model::Entity entity = blind;
  model::CameraSensor eye;
  eye.rate_hz = 50;
  eye.latency_s = kLate_s;
  entity.cameras = {eye};
  Fall fall(blind, false);
  constexpr double kBeside_m = 3;
  TwinRobot second(fall.world, entity,
                   {.imperfections = Imperfections::none(),
                    .start_m = {0, kBeside_m, 20},
                    .cradle = Cradle::kNone,
                    .cameras = true});
  const double from_m = fall.robot.body().link_pose(0).translation().z();
  int exposures = 0;
  for (int i = 0; i < 200; ++i) {
    fall.step();
    for (const Exposure& each : second.take_exposures()) {
      ++exposures;
      EXPECT_EQ(each.robot, 1u) << "who looks";
      ASSERT_EQ(each.link_world.size(), 2u);
      const double t_s = 1e-6 * static_cast<double>(each.time_us);
      for (std::size_t robot = 0; robot < 2; ++robot) {
        ASSERT_EQ(each.link_world[robot].size(), blind.nodes.size());
        const Vec3 there = each.link_world[robot][0].translation();
        EXPECT_NEAR(there.z(), from_m - kGravity_m_s2 * t_s * (t_s + 0.001) / 2, 1e-6);
        EXPECT_NEAR(there.y(), kBeside_m * static_cast<double>(robot), 0.01);
      }
    }
  }
  EXPECT_GT(exposures, 3);
}

TEST(Latency, OfSensorsThatTheControllerDoesNotHaveChangesNoBitOfTheRun) {
  model::Entity entity = falling_biped(0);
  model::LaserSensor laser;
  laser.rate_hz = 100;
  laser.noise_stddev_m = 0.01;
  entity.lasers = {laser};
  model::Entity slow = entity;
  slow.lasers[0].latency_s = kLate_s;
  Fall a(entity), b(slow);
  for (int i = 0; i < 100; ++i) {
    a.step();
    b.step();
  }
  EXPECT_EQ(a.robot.body().link_pose(0).matrix(), b.robot.body().link_pose(0).matrix());
  EXPECT_EQ(a.robot.body().angles_rad(), b.robot.body().angles_rad());
  EXPECT_EQ(a.robot.imu().gyro_count, b.robot.imu().gyro_count);
}

}  // namespace
}  // namespace verp::sim::test
