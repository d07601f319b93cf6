#include "host/apps/tool/robot/action_send.hpp"

#include <fmt/format.h>

#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/controller_table.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/author/action/folder.hpp"
#include "host/author/action/kept.hpp"
#include "host/author/action/send.hpp"

namespace verp::tool {
namespace {

std::unique_ptr<action::ActionPort> open(const SendWords& send) {
  const link::Endpoint endpoint = link::parse_endpoint(send.link);
  const bool can = endpoint.kind == link::Endpoint::Kind::kCan;
  const int usual = can ? canopen::plan::kControllerNode : dxl::controller::kDefaultId;
  const auto id = static_cast<std::uint8_t>(send.id >= 0 ? send.id : usual);
  return can ? action::can_action_port(endpoint, id) : action::serial_action_port(endpoint, id);
}

void require_actions(const ActionRobot& robot) {
  if (!robot.made.documents.empty()) return;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp action send: {} has no actions in {}; write one: "
                  "host/guide/actions.md has the words",
                  robot.entity.name, action::folder_of(robot.entity.file).string()));
}

}  // namespace

int send_actions(const ActionWords& words, const SendWords& send) {
  if (!words.action.empty() && !words.action.ends_with(".action")) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp action send: --add {}: actions are *.action; all "
                                     "of the robot's own are sent anyway",
                                     words.action));
  }
  const ActionRobot robot = load_action_robot(words);
  require_actions(robot);
  const std::vector<std::uint8_t> image = action::kept_image(robot.made, robot.params);
  const int count = static_cast<int>(robot.made.documents.size());
  const auto port = open(send);
  cli::Progress progress(!words.json);
  const auto all = static_cast<double>(image.size());
  const bool sent = action::send_actions(
      *port, image, {.robot = robot.params.name, .actions = count, .went = [&](std::size_t bytes) {
                       progress.show(static_cast<double>(bytes) / all,
                                     fmt::format("{} bytes", bytes));
                       return !cli::interrupted();
                     }});
  progress.clear();
  if (!sent) {
    cli::complain(send.link + ": interrupted; the controller keeps the actions that it has");
    return cli::kRunFailed;
  }
  cli::print_answer(words.json,
                    {{"model", robot.entity.name}, {"actions", count}, {"bytes", image.size()}},
                    fmt::format("{}: {} actions of {}, {} bytes, in force\n", port->place(), count,
                                robot.entity.name, image.size()));
  return cli::kGood;
}

}  // namespace verp::tool
