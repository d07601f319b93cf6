#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "host/twin/sim/robot.hpp"
#include "host/twin/sim/world.hpp"
#include "tests/hil/level_plant.hpp"
#include "tests/target/twin_run.hpp"

namespace verp::test {

class RunBody {
 public:
  RunBody(const Robot& robot, bool physics, std::uint32_t seed) {
    if (physics) {
      sim::TwinOptions options;
      options.seed = seed;
      world_.emplace();
      twin_.emplace(*world_, robot.entity, options);
      plant_.emplace(*twin_);
    } else {
      level_.emplace(robot.params);
      plant_.emplace(*level_);
    }
  }

  SickPlant& plant() { return *plant_; }
  /// Servos then reach goals on time, so reports are known.
  bool on_stand() const { return level_.has_value(); }
  Eigen::Vector2d position_m() const {
    if (!twin_) return Eigen::Vector2d::Zero();
    return twin_->truth().com_world_m.head<2>();
  }
  bool lies() const { return twin_ && twin_->truth().body_world.linear()(2, 2) < kLyingUp; }
  bool fallen() const { return twin_ && twin_->truth().fallen; }

 private:
  static constexpr double kLyingUp = 0.5;  // a tilt of 60 degrees; the table's fall is 46

  std::optional<sim::World> world_;
  std::optional<sim::TwinRobot> twin_;
  std::optional<LevelPlant> level_;
  std::optional<SickPlant> plant_;
};

}  // namespace verp::test
