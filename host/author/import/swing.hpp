#pragma once
#include <string>
#include <utility>
#include <vector>

#include "common/model/params.hpp"
#include "host/author/import/finding.hpp"

namespace verp::import {

struct SwingChoice {
  std::vector<std::pair<std::string, double>> tuning;  ///< where it differs from the robot's own
  std::vector<Finding> findings;
};

/// How high the feet swing: as usual, unless the servos would be too slow for it, or the planner
/// would shorten the steps until the robot stops. `of_damping`: the servos' speed is the file's
/// torque over its damping.
SwingChoice choose_swing(Params params, bool of_damping);

}  // namespace verp::import
