#pragma once
#include <string>
#include <vector>

#include "host/author/mjcf/mjcf.hpp"

namespace verp::mjcf {

/// Two bodies that a weld or a connect joins: their ways to a common body are a loop. -1: the
/// world.
struct Closure {
  int first = -1, second = -1;
};

/// Many joints of limbs are turned by a motor beside them, through gears or rods, and have no
/// actuator of their own. They get that motor: of a gear (a follower whose driver moves nothing
/// else) by its ratio, of rods 1 to 1, a guess. Such followers are erased. Returns a line each.
std::vector<std::string> move_motors(Robot& robot, const std::vector<Closure>& closures);

}  // namespace verp::mjcf
