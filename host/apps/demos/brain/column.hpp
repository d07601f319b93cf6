#pragma once
#include <memory>

#include "host/apps/demos/brain/route.hpp"

namespace verp::brain {

/// A robot's place in a column two abreast: distance behind the guide along the guide's way, and
/// distance to the left of it. The right robot of each pair stands slightly back, so that its
/// laser, which covers half a circle, still sees the left one.
struct Slot {
  double back_m = 0, left_m = 0;
};
Slot column_slot(int number);

/// The guide (number 0), front left, walks a route and reports its progress by radio. Each other
/// robot walks the same route in its slot, faster or slower where the column wheels. It corrects
/// its odometry by seeing the robots ahead of it, which report their poses.
std::unique_ptr<Brain> make_guide(const About& about, double speed_m_s);
std::unique_ptr<Brain> make_file(const About& about);
Route columns_way();

}  // namespace verp::brain
