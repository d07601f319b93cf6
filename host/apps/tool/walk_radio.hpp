#pragma once
#include <memory>
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {

/// Throws ToolError unless the robots have a use for radios, or have none.
void check_radio(const Walk& walk);

/// `verp walk --radio`: the air between the robots of a walk (host/twin/radio), and a modem on the
/// bus of each robot whose controller is outside. Robots have numbers in the order of the scenario.
/// A robot's trace has what it said and heard, and the first one's also what robots without a trace
/// did.
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
