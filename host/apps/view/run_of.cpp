#include "host/apps/view/run_of.hpp"

#include <utility>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/walk_scenario.hpp"
#include "host/author/action/get_up.hpp"

namespace verp::view {

RunSetup run_of(const tool::WalkOptions& options) {
  tool::Walk walk = tool::walk_of(options);
  for (const session::WalkPlan& plan : walk.run.plans) {
    if (plan.link.empty() && plan.board.empty()) continue;
    throw cli::ToolError(cli::kBadInput,
                         "verp view: --robot " + plan.name +
                             ": the window shows robots that this program drives; give the "
                             "others to `verp walk`");
  }
  session::WalkPlan& first = walk.run.plans.front();
  const std::string why = action::offer_get_up_actions(first);
  if (!why.empty()) cli::complain("verp view: the robot cannot get up: " + why);
  record::mcap::StringMap metadata = scenario::metadata_of(first, walk.scenario);
  metadata.erase("own_controller");
  metadata["watched"] = "in a window";
  return {.run = std::move(walk.run),
          .beside = {},
          .record_file = options.record_file,
          .metadata = std::move(metadata)};
}

}  // namespace verp::view
