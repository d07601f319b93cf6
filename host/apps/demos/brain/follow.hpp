#pragma once
#include <deque>
#include <memory>
#include <optional>

#include "host/apps/demos/brain/route.hpp"

namespace verp::brain {

/// How far behind the one ahead a follower walks.
inline constexpr double kGap_m = 0.8;

/// The first walks along a way that nobody else knows, and tells how fast it is. Each other one
/// follows the one before it: it sees that one by its laser, remembers where it saw it, and walks
/// there, slower where it is near and faster where it is far.
std::unique_ptr<Brain> make_leader(const About& about, double speed_m_s);
std::unique_ptr<Brain> make_follower(const About& about);

/// The leader's, from where it stands.
Route leaders_way();

}  // namespace verp::brain
