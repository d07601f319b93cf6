#pragma once
#include <string>

#include "host/run/session/plan.hpp"

namespace verp::action {

/// Loads the actions of a plan that may get up. Throws LoadError if a needed action is missing.
void take_get_up_actions(session::WalkPlan& plan);

/// Loads them also without get-ups, if the robot can get up from both sides; else as
/// take_lie_down(). Returns its files' error, or empty.
std::string offer_get_up_actions(session::WalkPlan& plan);

/// Into a plan without actions: the robot's lie_down, if it has one. Throws LoadError.
void take_lie_down(session::WalkPlan& plan);

}  // namespace verp::action
