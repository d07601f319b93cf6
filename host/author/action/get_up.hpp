#pragma once
#include <string>

#include "host/run/session/plan.hpp"

namespace verp::action {

/// Gives a plan that may get up the robot's actions for it, from how it lies. Throws LoadError.
void take_get_up_actions(session::WalkPlan& plan);

/// The same for a robot that nobody lets get up yet, if it has such actions. Returns why it has
/// none; empty if there is nothing to say.
std::string offer_get_up_actions(session::WalkPlan& plan);

}  // namespace verp::action
