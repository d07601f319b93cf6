#pragma once
#include <memory>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

inline constexpr Point kGoalMiddle{3, 0};  ///< on the pitch
inline constexpr double kBallRadius_m = 0.05;

/// The robot with the shorter way walks the ball to the goal from behind; the other follows to the
/// side and watches it. Each sends its pose and where it sees the ball.
std::unique_ptr<Brain> make_player(const About& about);

}  // namespace verp::brain
