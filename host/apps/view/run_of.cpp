#include "host/apps/view/run_of.hpp"

#include <fmt/format.h>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/walk_files.hpp"
#include "host/apps/tool/walk_plan.hpp"
#include "host/apps/tool/walk_touch.hpp"

namespace verp::view {

RunSetup run_of(const tool::WalkOptions& options) {
  RunSetup setup;
  setup.world = tool::world_of(options);
  std::vector<session::WalkPlan> plans = tool::make_plans(options, setup.world);
  for (const session::WalkPlan& plan : plans) {
    if (plan.link.empty() && plan.board.empty()) continue;
    throw cli::ToolError(cli::kBadInput,
                         "verp view: --robot " + plan.name +
                             ": the window shows robots that this program drives; give the "
                             "others to `verp walk`");
  }
  setup.plan = std::move(plans.front());
  plans.erase(plans.begin());
  setup.others = std::move(plans);
  const std::string why = tool::offer_get_up_actions(setup.plan);
  if (!why.empty()) cli::complain("verp view: the robot cannot get up: " + why);
  tool::read_touch(options.touch, setup.plan, setup.others, setup.world);
  tool::draw(options, setup.plan, setup.world);
  setup.record_file = options.record_file;
  setup.metadata = {{"robot", setup.plan.params.name},
                    {"model_file", setup.plan.entity.file},
                    {"world_file", tool::world_file(options)},
                    {"seed", std::to_string(setup.plan.twin.seed)},
                    {"step_m", fmt::format("{}", options.step_m)},
                    {"cycle_s", fmt::format("{}", setup.plan.params.tuning.gait.cycle_s)},
                    {"velocity", options.velocity_text},
                    {"walk_s", fmt::format("{}", options.walk_s)},
                    {"controller", "this PC"},
                    {"watched", "in a window"}};
  return setup;
}

}  // namespace verp::view
