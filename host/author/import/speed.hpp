#pragma once
#include <optional>
#include <vector>

#include "common/model/params.hpp"
#include "host/author/import/finding.hpp"

namespace verp::import {

struct SpeedChoice {
  std::optional<double> lift_m;  ///< lower than the robot's, so that its servos keep up
  std::vector<Finding> findings;
};

/// Are the servos fast enough to walk? `of_damping`: their speed is the file's torque over its
/// damping.
SpeedChoice choose_lift(Params params, bool of_damping);

}  // namespace verp::import
