#pragma once
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/run/session/plan.hpp"

/// The run that the options of `verp walk` mean.
namespace verp::tool {

/// Gives the plan the velocity that the options ask for, or as much of it as the robot's servos can
/// follow, and the length of the walk. The plan has its Params by then.
void ask_for_walk(const WalkOptions& options, session::WalkPlan& plan);

/// Those of the robot's actions that it gets up by, for the way that it lies. Throws LoadError.
void take_get_up_actions(session::WalkPlan& plan);

/// The same if it has them, of a robot that nobody lets get up yet: who drives it may. Else none,
/// and why, if it is not that there are none.
std::string offer_get_up_actions(session::WalkPlan& plan);

/// How it is put down: --start.
sim::Lies lies_of(const WalkOptions& options);

/// That, and with it or --get-up the actions that it gets up by. Throws ToolError and LoadError.
void prepare_falls(const WalkOptions& options, session::WalkPlan& plan);

/// Throws ToolError and LoadError.
session::WalkPlan make_plan(const WalkOptions& options);

/// That robot alone; or those of --robots and --robot, or that the world has of its own, which all
/// walk likewise, each with a seed of its own (the next one's is one more). Report and pictures are
/// of the first. Throws ToolError and LoadError.
std::vector<session::WalkPlan> make_plans(const WalkOptions& options,
                                          const sim::WorldOptions& world);

/// What the robot and its world became by --vary.
struct Drawn {
  cli::Json json = cli::Json::object();
  std::string text;
};

/// Draws robot and world anew if --vary asks for it.
Drawn draw(const WalkOptions& options, session::WalkPlan& plan, sim::WorldOptions& world);

}  // namespace verp::tool
