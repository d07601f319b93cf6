#pragma once
#include <memory>
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {

/// What the cameras of the robot that walks see, into its trace: --cameras. A program beside this
/// one draws it (host/show/camera).
class WalkCameras final : public session::Observer {
 public:
  /// Has the first robot's twin say when its cameras look. Throws ToolError: there is no camera, no
  /// trace, or nothing that draws.
  WalkCameras(Walk& walk, record::TraceWriter* trace);
  ~WalkCameras() override;

  void join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) override;
  /// Waits for the last pictures.
  void end(session::Session& session) override;

  std::string text(double run_s) const;
  cli::Json json() const;
  /// Why there are no more pictures; empty: there are all.
  std::string failure() const;

 private:
  struct Seen;
  std::unique_ptr<Seen> seen_;
};

}  // namespace verp::tool
