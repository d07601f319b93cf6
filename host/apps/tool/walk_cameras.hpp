#pragma once
#include <memory>
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {

/// --cameras: pictures in the first robot's trace. A separate program renders (host/show/camera).
class WalkCameras final : public session::Observer {
 public:
  /// Throws ToolError without a camera, a trace or a renderer.
  WalkCameras(Walk& walk, record::TraceWriter* trace);
  ~WalkCameras() override;

  void join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) override;
  void end(session::Session& session) override;

  std::string text(double run_s) const;
  cli::Json json() const;
  /// Why pictures are missing, or empty.
  std::string failure() const;

 private:
  struct Seen;
  std::unique_ptr<Seen> seen_;
};

}  // namespace verp::tool
