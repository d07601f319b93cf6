#pragma once
#include <string>

#include "host/run/session/plan.hpp"

namespace verp::action {

/// Loads the actions of a plan that may get up. Throws LoadError if a needed action is missing.
void take_get_up_actions(session::WalkPlan& plan);

/// Loads them also without get-ups, if the robot can get up from both sides. Returns its files'
/// error, or empty.
std::string offer_get_up_actions(session::WalkPlan& plan);

}  // namespace verp::action
