#pragma once
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/run/session/plan.hpp"

/// Reports a robot with a controller elsewhere. Only its motion is known, not its orders.
namespace verp::tool {

/// The controller's place: this PC, a board's name, or a link.
std::string driver_of(const session::WalkPlan& plan);

/// Null for a controller elsewhere, which reports no digest.
cli::Json digest_json(const session::WalkPlan& plan, const session::WalkResult& result);

/// Way of the body from its start to its end, in the world.
sim::Vec2 way_of(const session::WalkPlan& plan, const session::WalkResult& result);

/// Replaces the text of a walk.
std::string outside_text(const session::WalkPlan& plan, const session::WalkResult& result);

}  // namespace verp::tool
