#pragma once
#include <memory>
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {

/// Throws ToolError unless --radio has a use for these robots, or was not given.
void check_radio(const WalkOptions& options, const session::WalkPlan& first,
                 const std::vector<session::WalkPlan>& others);

/// `verp walk --radio`: the air between the robots of a walk (host/twin/radio), and a modem on the
/// bus of each one whose controller is outside. Robots have numbers in the order in which they were
/// named, from 0 on.
class WalkRadio {
 public:
  WalkRadio(const WalkOptions& options, session::Session& session, std::size_t robots);
  ~WalkRadio();
  WalkRadio(const WalkRadio&) = delete;
  WalkRadio& operator=(const WalkRadio&) = delete;

  /// Before that robot joins the session: its trace will have what it said and heard; the first's
  /// also what those did that have none.
  void watch(const session::WalkPlan& plan, session::Hooks& hooks);
  /// It has joined.
  void join(const session::WalkPlan& plan, session::Robot& robot);

  std::string text() const;
  cli::Json json() const;

 private:
  struct Air;
  std::unique_ptr<Air> air_;
};

}  // namespace verp::tool
