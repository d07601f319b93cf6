#pragma once
#include <memory>

#include "host/apps/demos/brain/route.hpp"

namespace verp::brain {

/// A robot's place in a column two abreast: so far behind the guide along the guide's way, and so
/// far to the left of that. The right one of each two stands a little back, where its laser, which
/// looks half around, still has the left one.
struct Slot {
  double back_m = 0, left_m = 0;
};
Slot column_slot(int number);

/// The guide (number 0), left in front, walks a way and tells of it. Each other one walks the same
/// way in its slot, faster or slower where the column wheels. It knows where it is by its odometry,
/// and better by seeing those before it, who tell where they are.
std::unique_ptr<Brain> make_guide(const About& about, double speed_m_s);
std::unique_ptr<Brain> make_file(const About& about);
Route columns_way();

}  // namespace verp::brain
