#pragma once
#include "host/run/session/plan.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/twin/sim/robot.hpp"

namespace verp::scene {

/// A robot's view at a tick, for session::Hooks::ticked. Only reads: the run has the same bits with
/// and without it.
RobotView look(const session::Tick& tick, const Entity& entity, const Params& params);

/// Snapshot of one robot's run.
Snapshot snapshot(const session::Tick& tick, const Entity& entity, const Params& params);

}  // namespace verp::scene
