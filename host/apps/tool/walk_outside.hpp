#pragma once
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/run/session/plan.hpp"

/// What is known of a robot that somebody else drives: what it did, and not what it was told.
namespace verp::tool {

/// This PC, a board's name, or the link at whose other end the controller is.
std::string driver_of(const session::WalkPlan& plan);

/// Null: the controller is outside, and keeps its digest to itself.
cli::Json digest_json(const session::WalkPlan& plan, const session::WalkResult& result);

/// From where its body stood to where it was in the end, in the world.
sim::Vec2 way_of(const session::WalkPlan& plan, const session::WalkResult& result);

/// The text of such a robot's run, in place of a walk's.
std::string outside_text(const session::WalkPlan& plan, const session::WalkResult& result);

}  // namespace verp::tool
