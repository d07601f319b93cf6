#include "host/twin/sim/scenery.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "host/twin/sim/laser.hpp"
#include "host/twin/sim/quantities.hpp"
#include "tests/host/sim/test_robots.hpp"
#include "tests/support/leak.hpp"

// Hand-calculated distances.

namespace verp::sim::test {
namespace {

using Kind = model::WorldObject::Kind;
using ShapeKind = model::Shape::Kind;

model::WorldObject object(const char* name, ShapeKind shape, const Vec3& size_m, const Vec3& at_m,
                          Kind kind = Kind::kStatic) {
  model::WorldObject out;
  out.name = name;
  out.kind = kind;
  out.pose.translation() = at_m;
  out.mass_kg = 0.1;
  out.inertia_kg_m2 = Mat3::Identity() * 1e-4;
  out.collisions.resize(1);
  out.collisions[0].shape.kind = shape;
  out.collisions[0].shape.size_m = size_m;
  return out;
}

model::WorldObject floor_at(double z_m) {
  return object("floor", ShapeKind::kPlane, {10, 10, 0}, {0, 0, z_m});
}

struct Place {
  explicit Place(std::vector<model::WorldObject> objects) {
    data = std::make_shared<model::World>();
    data->objects = std::move(objects);
    world = std::make_unique<World>(WorldOptions{.ground = false, .scenery = data});
  }
  Vec3 at(std::size_t index) const { return world->scenery()->pose(index).translation(); }
  std::shared_ptr<model::World> data;
  std::unique_ptr<World> world;
};

// ODE aborts on a NaN; one robot must not end a campaign.
TEST(World, PhysicsThatDivergesIsAnErrorOfItsRun) {
  Place place({floor_at(0),
               object("box", ShapeKind::kBox, {0.1, 0.1, 0.1}, {0, 0.01, 0.04}, Kind::kDynamic)});
  place.world->set_gravity(1e160);
  const verp::test::SomebodyElsesLeak ode_forgets_the_step_that_it_gave_up;
  EXPECT_THROW(place.world->advance_to(1'000'000), Diverged);
  EXPECT_THROW(place.world->advance_to(2'000'000), Diverged) << "whoever else is in it";
}

TEST(Scenery, EachShapeHoldsABallWhereItsSurfaceIs) {
  auto field = std::make_shared<model::Heightfield>();
  *field = {.columns = 5,
            .rows = 5,
            .size_x_m = 2,
            .size_y_m = 2,
            .height_m = std::vector<double>(25, 0.3)};
  auto roof = std::make_shared<model::Mesh>();
  roof->vertex_m = {{-1, -1, 0.4}, {1, -1, 0.4}, {1, 1, 0.4}, {-1, 1, 0.4}};
  roof->triangle = {{0, 1, 2}, {0, 2, 3}};
  struct Case {
    ShapeKind kind;
    Vec3 size_m, at_m;
    double top_m;
  };
  for (const Case& each : {Case{ShapeKind::kPlane, {2, 2, 0}, {0, 0, 0.1}, 0.1},
                           Case{ShapeKind::kBox, {1, 1, 0.4}, {0, 0, 0.2}, 0.4},
                           Case{ShapeKind::kSphere, {0.3, 0, 0}, {0, 0, 0.1}, 0.4},
                           Case{ShapeKind::kCylinder, {0.3, 0, 0.5}, {0, 0, 0}, 0.25},
                           Case{ShapeKind::kCapsule, {0.1, 0, 0.5}, {0, 0, 0}, 0.35},
                           Case{ShapeKind::kHeightfield, {0, 0, 0}, {0, 0, 0}, 0.3},
                           Case{ShapeKind::kMesh, {0, 0, 0}, {0, 0, 0}, 0.4}}) {
    model::WorldObject base = object("base", each.kind, each.size_m, each.at_m);
    base.collisions[0].shape.heightfield = field;
    base.collisions[0].shape.mesh = roof;
    Place place(
        {base, object("ball", ShapeKind::kSphere, {0.05, 0, 0}, {0, 0, 0.6}, Kind::kDynamic)});
    const Place bare({base});
    EXPECT_NEAR(bare.world->height_m(0, 0, 0.001), each.top_m, 1e-4) << static_cast<int>(each.kind);
    place.world->advance_to(1'500'000);
    EXPECT_NEAR(place.at(1).z(), each.top_m + 0.05, 1e-3) << static_cast<int>(each.kind);
  }
}

TEST(Scenery, AHeightfieldHasItsSlopeWhereTheFileHasIt) {
  auto field = std::make_shared<model::Heightfield>();
  *field = {.columns = 3,
            .rows = 2,
            .size_x_m = 2,
            .size_y_m = 1,
            .height_m = {0, 0.1, 0.2, 0.5, 0.6, 0.7}};
  model::WorldObject base = object("base", ShapeKind::kHeightfield, {0, 0, 0}, {0, 0, 0});
  base.collisions[0].shape.heightfield = field;
  const Place place({base});
  EXPECT_NEAR(place.world->height_m(-0.999, -0.499, 1e-6), 0, 2e-3);
  EXPECT_NEAR(place.world->height_m(0.999, -0.499, 1e-6), 0.2, 2e-3);
  EXPECT_NEAR(place.world->height_m(-0.999, 0.499, 1e-6), 0.5, 2e-3);
  EXPECT_NEAR(place.world->height_m(0, 0, 1e-6), 0.35, 2e-3);
}

TEST(Scenery, WhatMovesByItselfKeepsItsTimesAndPushes) {
  model::WorldObject cart =
      object("cart", ShapeKind::kBox, {0.2, 0.2, 0.2}, {0, 0, 0.1}, Kind::kMoving);
  for (const double t_s : {0.0, 2.0, 3.0}) {
    model::Waypoint point{.t_s = t_s, .pose = cart.pose};
    point.pose.translation().x() = t_s == 2 ? 1 : 0;
    cart.waypoints.push_back(point);
  }
  cart.loops = true;
  Place place({floor_at(0), cart,
               object("ball", ShapeKind::kSphere, {0.05, 0, 0}, {0.4, 0, 0.05}, Kind::kDynamic)});
  place.world->advance_to(1'000'000);
  EXPECT_NEAR(place.at(1).x(), 0.5, 1e-3);
  EXPECT_GT(place.at(2).x(), 0.6);
  EXPECT_NEAR(pose_at(cart, 2.5).translation().x(), 0.5, 1e-12);
  EXPECT_NEAR(pose_at(cart, 4.0).translation().x(), 0.5, 1e-12) << "it goes round";
}

TEST(Scenery, ItsQuantitiesCanBeSetByName) {
  Place place({floor_at(0),
               object("ball", ShapeKind::kSphere, {0.05, 0, 0}, {0, 0, 0.05}, Kind::kDynamic)});
  Quantities q(*place.world);
  q.add(*place.world->scenery());
  q.set("ball.position_m.z", 1);
  q.set("ball.mass_kg", 0.5);
  q.set("floor.friction", 0.1);
  q.push("ball", {1, 0, 0}, 0.1);
  place.world->advance_to(200'000);
  EXPECT_NEAR(q.read("ball.velocity_m_s.x"), 0.2, 1e-9);
  EXPECT_NEAR(q.read("floor.friction"), 0.1, 0);
  EXPECT_NEAR(q.read("ball.position_m.z"), 1 - 9.80665 * 0.2 * 0.201 / 2, 1e-6);
}

/// A laser 0.2 m above the floor, walls at x = 1 and y = -0.8.
Place room() {
  return Place({floor_at(0), object("front", ShapeKind::kBox, {0.2, 9, 2}, {1.1, 0, 1}),
                object("right", ShapeKind::kBox, {9, 0.2, 2}, {0, -0.9, 1})});
}

model::LaserSensor laser() {
  model::LaserSensor laser;
  laser.name = "laser";
  laser.rate_hz = 20;
  laser.samples = 181;
  laser.first_rad = -std::numbers::pi / 2;
  laser.last_rad = std::numbers::pi / 2;
  laser.max_m = 3;
  return laser;
}

std::vector<Scan> scans_of(const model::LaserSensor& sensor, bool noise, std::uint64_t seed = 1) {
  const Place place = room();
  model::Entity entity = arm();
  entity.lasers = {sensor};
  Imperfections perfect = Imperfections::none();
  perfect.lasers = noise;
  TwinRobot robot(
      *place.world, entity,
      {.seed = seed, .imperfections = perfect, .start_m = {0, 0, 0.2}, .cradle = Cradle::kAlways});
  place.world->advance_to(500'000);
  return robot.take_scans();
}

TEST(Laser, MeasuresTheWallsOfARoom) {
  const std::vector<Scan> scans = scans_of(laser(), false);
  ASSERT_EQ(scans.size(), 10u) << "20 a second";
  EXPECT_EQ(scans[0].time_us, 50'000u);
  const model::LaserSensor sensor = laser();
  for (int i = 0; i < sensor.samples; ++i) {
    const double angle = sensor.angle_rad(i);
    double expected = 1 / std::cos(angle);
    if (angle < 0) expected = std::min(expected, 0.8 / -std::sin(angle));
    const float range_m = scans[9].range_m[static_cast<std::size_t>(i)];
    if (expected > 3) {
      EXPECT_TRUE(std::isinf(range_m)) << i;
    } else {
      EXPECT_NEAR(static_cast<double>(range_m), expected, 1e-5) << i;
    }
  }
}

TEST(Laser, ASingleRayLooksDownAndCountsInItsResolution) {
  model::LaserSensor ray = laser();
  ray.samples = 1;
  ray.first_rad = ray.last_rad = 0;
  ray.resolution_m = 0.01;
  ray.pose.linear() = Eigen::AngleAxisd(0.3, Vec3::UnitY()).toRotationMatrix();
  const std::vector<Scan> scans = scans_of(ray, false);
  ASSERT_FALSE(scans.empty());
  ASSERT_EQ(scans[0].range_m.size(), 1u);
  const double floor_m = 0.2 / std::sin(0.3);  // 0.6768
  EXPECT_NEAR(static_cast<double>(scans[0].range_m[0]), 0.01 * std::round(100 * floor_m), 1e-6);
}

TEST(Laser, NoiseHasItsSizeAndIsOfTheSeed) {
  model::LaserSensor sensor = laser();
  sensor.noise_stddev_m = 0.02;
  sensor.noise_mean_m = 0.05;
  const std::vector<Scan> noisy = scans_of(sensor, true), again = scans_of(sensor, true),
                          other = scans_of(sensor, true, 2), clean = scans_of(sensor, false);
  EXPECT_EQ(noisy.back().range_m, again.back().range_m);
  EXPECT_NE(noisy.back().range_m, other.back().range_m);
  double sum = 0, squares = 0;
  int count = 0;
  for (std::size_t s = 0; s < noisy.size(); ++s) {
    for (std::size_t i = 0; i < noisy[s].range_m.size(); ++i) {
      if (std::isinf(clean[s].range_m[i])) continue;
      const double error = static_cast<double>(noisy[s].range_m[i] - clean[s].range_m[i]);
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean, 0.05, 0.003);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.02, 0.002);
}

}  // namespace
}  // namespace verp::sim::test
