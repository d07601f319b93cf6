#pragma once
#include <string>

#include "host/apps/cli/progress.hpp"
#include "host/run/session/plan.hpp"
#include "host/run/session/session.hpp"

/// Sessions as this program runs them: they show how far they are, and Ctrl-C ends them.
namespace verp::tool {

using session::WalkPlan;
using session::WalkResult;

/// Of a robot that may get up, has it said on stderr what becomes of it when it falls.
void tell_falls(const WalkPlan& plan, cli::Progress& progress, const std::string& command,
                session::Hooks& hooks);

/// The program's hooks for one robot. `trace` may be null; what is given must outlive the run.
session::Hooks shown(const WalkPlan& plan, record::TraceWriter* trace, cli::Progress& progress,
                     const std::string& label, bool keep_series);

/// session::walk() with these, in such a world.
WalkResult walk(const WalkPlan& plan, record::TraceWriter* trace, cli::Progress& progress,
                const std::string& label, bool keep_series, const sim::WorldOptions& world = {});

}  // namespace verp::tool
