#pragma once
#include <deque>
#include <memory>
#include <optional>

#include "host/apps/demos/brain/route.hpp"

namespace verp::brain {

/// Distance between a follower and the robot ahead.
inline constexpr double kGap_m = 0.8;

/// The leader walks a route that the others do not know and reports its speed. Each follower tracks
/// the robot ahead with its laser, remembers where it saw it, and walks there: slower when near,
/// faster when far.
std::unique_ptr<Brain> make_leader(const About& about, double speed_m_s);
std::unique_ptr<Brain> make_follower(const About& about);

/// The leader's route, from its start pose.
Route leaders_way();

}  // namespace verp::brain
