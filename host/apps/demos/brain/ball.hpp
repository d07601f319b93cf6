#pragma once
#include <memory>

#include "host/apps/demos/brain/brain.hpp"

namespace verp::brain {

inline constexpr Point kGoalMiddle{3, 0};  ///< of the pitch
inline constexpr double kBallRadius_m = 0.05;

/// One of two that bring an orange ball into a goal: the one that has less far to go gets behind
/// the ball and walks it there, the other one follows to the side and keeps an eye on it. They tell
/// each other where they are and where they see the ball.
std::unique_ptr<Brain> make_player(const About& about);

}  // namespace verp::brain
