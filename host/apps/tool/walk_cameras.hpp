#pragma once
#include <memory>
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/apps/tool/walk_plan.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {

/// What the cameras of the robot that walks see, into its trace: --cameras. A program beside this
/// one draws it (host/show/camera).
class WalkCameras {
 public:
  /// Has the plan's twin say when its cameras look. Throws ToolError: there is no camera, no trace,
  /// or nothing that draws.
  WalkCameras(const WalkOptions& options, WalkPlan& plan, const std::vector<WalkPlan>& others,
              const sim::WorldOptions& world, record::TraceWriter* trace);
  ~WalkCameras();

  /// The hooks of the robot that walks, before it is added to the session.
  void watch(const WalkPlan& plan, session::Hooks& hooks);
  /// Waits for the last pictures.
  void finish();

  std::string text(double run_s) const;
  cli::Json json() const;
  /// Why there are no more pictures; empty: there are all.
  std::string failure() const;

 private:
  struct Seen;
  std::unique_ptr<Seen> seen_;
};

}  // namespace verp::tool
