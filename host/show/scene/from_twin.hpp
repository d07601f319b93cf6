#pragma once
#include "host/run/session/plan.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/twin/sim/robot.hpp"

namespace verp::scene {

/// Call it in session::Hooks::ticked. It changes no bit of the run.
RobotView look(const session::Tick& tick, const Entity& entity, const Params& params);

Snapshot snapshot(const session::Tick& tick, const Entity& entity, const Params& params);

}  // namespace verp::scene
