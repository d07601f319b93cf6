#pragma once
#include <memory>
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {

/// Throws ToolError if robots cannot use the scenario's radio.
void check_radio(const Walk& walk);

/// `verp walk --radio` (host/twin/radio), with a modem on the bus of each robot with a controller
/// elsewhere. Stations are numbered as the scenario's robots. A trace records its robot's messages;
/// the first also those of robots without a trace.
class WalkRadio final : public session::Observer {
 public:
  explicit WalkRadio(const scenario::Scenario& scenario);
  ~WalkRadio() override;

  void join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) override;
  void begin(session::Session& session) override;
  void tick(std::size_t index, session::Robot& robot) override;

  std::string text() const;
  cli::Json json() const;

 private:
  struct Air;
  std::unique_ptr<Air> air_;
};

}  // namespace verp::tool
