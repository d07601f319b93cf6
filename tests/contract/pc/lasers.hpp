#pragma once
#include <memory>
#include <numbers>
#include <vector>

#include "hal/fake/memory_link.hpp"
#include "host/os/link/scip_range_finder.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/twin/sim/twin_range_finder.hpp"
#include "host/twin/sim/world.hpp"
#include "tests/support/scip_sensor.hpp"

/// 1 m ahead in the middle, nothing on the left.
namespace verp::test {

struct ScipLaser {
  static constexpr std::size_t kSteps = 21;
  static constexpr bool kBreaks = true;
  void turn() {
    std::vector<std::uint32_t> ranges(kSteps, 0);
    ranges[kSteps / 2] = 1000;
    sensor.scan(time_ms += 50, ranges);
  }
  void break_it(bool silent) { sensor.be_silent(silent); }
  void wait() {
    sensor.listen();
    time_ns += 30'000'000;
  }
  hal::RangeStatus read(hal::RangeScan& scan) {
    const hal::RangeStatus status = finder.read(scan);
    sensor.listen();
    return status;
  }
  std::uint32_t faults() const { return finder.faults(); }

  hal::MemoryWire line;
  ScipSensor<hal::MemoryLink> sensor{line.right()};
  static std::uint64_t now_ns() { return time_ns; }

  inline static std::uint64_t time_ns = 1;
  link::ScipRangeFinder<hal::MemoryLink, now_ns> finder{
      line.left(), {.first = 0, .last = kSteps - 1, .least_mm = 20, .silent_ms = 20}};
  std::uint32_t time_ms = 0;
};

struct TwinLaser {
  static constexpr std::size_t kSteps = 21;
  static constexpr bool kBreaks = false;

  static sim::WorldOptions walled() {
    auto scenery = std::make_shared<model::World>();
    model::WorldObject wall;
    wall.name = "wall";
    wall.pose.translation() = model::Vec3(1.1, 0, 1);
    model::WorldCollision shape;
    shape.shape.size_m = {0.2, 1, 2};
    wall.collisions = {shape};
    model::WorldObject floor;
    floor.name = "floor";
    model::WorldCollision plane;
    plane.shape.kind = model::Shape::Kind::kPlane;
    floor.collisions = {plane};
    scenery->objects = {floor, wall};
    sim::WorldOptions options;
    options.scenery = scenery;
    return options;
  }
  static model::Entity with_laser() {
    model::Entity entity = model::load_robot(model::find_model("generic21"));
    model::LaserSensor laser;
    laser.name = "laser";
    laser.rate_hz = 20;
    laser.samples = kSteps;
    laser.first_rad = -std::numbers::pi / 3;
    laser.last_rad = std::numbers::pi / 3;
    laser.max_m = 1.5;
    entity.lasers = {laser};
    return entity;
  }
  void turn() { world.advance_to(world.now_us() + 50'000); }
  void break_it(bool) {}
  void wait() {}
  hal::RangeStatus read(hal::RangeScan& scan) { return finder.read(scan); }
  std::uint32_t faults() const { return finder.faults(); }

  sim::World world{walled()};
  sim::TwinRobot twin{
      world,
      with_laser(),
      {.imperfections = sim::Imperfections::none(), .cradle = sim::Cradle::kAlways}};
  sim::TwinRangeFinder finder{twin, 0};
};

}  // namespace verp::test
