#pragma once
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// A servo whose P gain the robot's file leaves open.
struct OpenGain {
  Servo* servo = nullptr;
  bool takes_d_gain = false;  ///< an eighth of it
};

/// Gives each the P gain that fits the robot. The controller has room for 4 kinds of settings:
/// where that is too few, the nearest gains become one. Adds to `entity.defaults`.
void fit_gains(Entity& entity, const std::vector<OpenGain>& open);

}  // namespace verp::model
