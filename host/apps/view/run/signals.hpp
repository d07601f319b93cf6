#pragma once
#include <string>
#include <vector>

#include "host/show/scene/snapshot.hpp"

namespace verp::view {

struct Signal {
  std::string group;  ///< "Joints/l_knee", "Centre of mass"
  std::string name;   ///< "goal"
  std::string unit;

  std::string label() const { return group + " " + name; }
};

/// A signal's number is its index. `beside` adds a second robot and compares the joints.
std::vector<Signal> signals_of(const scene::Entity& entity, bool beside = false);

/// NaN: unknown.
std::vector<float> values_of(const scene::RobotView& robot, const scene::Entity& entity,
                             const scene::RobotView* beside = nullptr);

/// -1: no signal has that label.
int signal_number(const std::vector<Signal>& all, const std::string& label);

}  // namespace verp::view
