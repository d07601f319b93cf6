#pragma once
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/run/session/plan.hpp"

namespace verp::tool {

/// The controller's place: this PC, a board or a link.
std::string driver_of(const session::WalkPlan& plan);

/// Null for a controller elsewhere, which reports no digest.
cli::Json digest_json(const session::WalkPlan& plan, const session::WalkResult& result);

/// The body's way in the world.
sim::Vec2 way_of(const session::WalkPlan& plan, const session::WalkResult& result);

std::string outside_text(const session::WalkPlan& plan, const session::WalkResult& result);

}  // namespace verp::tool
