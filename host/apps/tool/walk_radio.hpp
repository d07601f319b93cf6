#pragma once
#include <memory>
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {

/// Throws ToolError if the scenario has a radio that its robots cannot use.
void check_radio(const Walk& walk);

/// `verp walk --radio`: the radio between the robots (host/twin/radio), and a modem on the bus of
/// each robot with a controller elsewhere. Stations have the numbers of the scenario's robots. A
/// robot's trace records the messages that it sent and received. The first robot's trace also
/// records the messages of robots without a trace.
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
