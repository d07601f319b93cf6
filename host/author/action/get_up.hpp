#pragma once
#include <string>

#include "host/run/session/plan.hpp"

namespace verp::action {

/// Loads the robot's actions into a plan that may get up. Throws LoadError if the action for a pose
/// in which the robot may lie is missing.
void take_get_up_actions(session::WalkPlan& plan);

/// Loads the actions also into a plan without get-ups, if the robot can get up from both sides.
/// Returns the error of its action files; empty: none.
std::string offer_get_up_actions(session::WalkPlan& plan);

}  // namespace verp::action
