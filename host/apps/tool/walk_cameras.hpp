#pragma once
#include <memory>
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {

/// Records the camera pictures of the first robot in its trace (--cameras). A separate program
/// renders them (host/show/camera).
class WalkCameras final : public session::Observer {
 public:
  /// Makes the first robot's twin report its exposures. Throws ToolError if the robot has no
  /// camera, the walk has no trace, or no renderer is available.
  WalkCameras(Walk& walk, record::TraceWriter* trace);
  ~WalkCameras() override;

  void join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) override;
  /// Waits for the last pictures.
  void end(session::Session& session) override;

  std::string text(double run_s) const;
  cli::Json json() const;
  /// Why pictures are missing; empty: none is.
  std::string failure() const;

 private:
  struct Seen;
  std::unique_ptr<Seen> seen_;
};

}  // namespace verp::tool
