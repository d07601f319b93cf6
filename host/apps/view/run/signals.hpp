#pragma once
#include <string>
#include <vector>

#include "host/show/scene/snapshot.hpp"

namespace verp::view {

/// A number of one robot that can be plotted over time.
struct Signal {
  std::string group;  ///< "Joints/l_knee", "Centre of mass"
  std::string name;   ///< "goal"
  std::string unit;

  std::string label() const { return group + " " + name; }
};

/// All signals of such a robot, group by group; a signal's number is its place here. `beside`:
/// and of another one that is compared with it, joint by joint.
std::vector<Signal> signals_of(const scene::Entity& entity, bool beside = false);

/// Their values in one instant. What the source does not know is NaN.
std::vector<float> values_of(const scene::RobotView& robot, const scene::Entity& entity,
                             const scene::RobotView* beside = nullptr);

/// -1: none of that label.
int signal_number(const std::vector<Signal>& all, const std::string& label);

}  // namespace verp::view
