#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/apps/tool/robot/first_power.hpp"
#include "host/apps/tool/robot/setup_command.hpp"
#include "host/apps/tool/robot/setup_guide.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::tool {
namespace {

struct SetupWords {
  std::string model = "generic21", bus, link, report;
  SetupChoice choice;
  bool json = false;
};

/// The maker's tool sets a CAN drive's id, bit rate and zero. Every start writes the rest
/// (firmware/app/node_settings.hpp).
[[noreturn]] void refuse_can(const SetupWords& words, const link::Endpoint& endpoint) {
  const bool named = endpoint.kind == link::Endpoint::Kind::kCan;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp bus setup: is for serial servos; give drives on CAN their ids, bit rate "
                  "and zeros (607Ch) with their maker's tool or switches: every start writes the "
                  "rest. `verp bus scan --link {}` shows who is there, `verp bus checklist {} "
                  "--bus {}` what else to check",
                  named ? words.link : "can:can0", words.model,
                  words.bus.empty() ? "NAME" : words.bus));
}

model::Entity robot_of(const SetupWords& words, const link::Endpoint& endpoint) {
  model::Entity entity = model::load_robot(model::find_model(words.model), words.bus);
  const bool can = entity.protocol == BusProtocol::kCia402;
  if (can || endpoint.kind == link::Endpoint::Kind::kCan) refuse_can(words, endpoint);
  return entity;
}

/// One report per bus, because a joint has another servo on each bus.
std::string report_of(const SetupWords& words, const model::Entity& entity) {
  if (!words.report.empty()) return words.report;
  const bool first = entity.bus == entity.buses.front();
  return fmt::format("{}{}-setup.json", entity.name, first ? "" : "-" + entity.bus);
}

void check_joint(const Params& params, const std::string& wanted) {
  std::vector<std::string> names;
  for (int j = 0; j < params.servo_count(); ++j) names.emplace_back(params.joint[j].name);
  if (wanted.empty() || std::find(names.begin(), names.end(), wanted) != names.end()) return;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp bus setup: {} has no joint '{}'{}", params.name, wanted,
                                   cli::did_you_mean(wanted, names)));
}

int set_up(const SetupWords& words) {
  const link::Endpoint endpoint = link::parse_endpoint(words.link);
  const model::Entity entity = robot_of(words, endpoint);
  const Params params = model::make_params(entity);
  check_joint(params, words.choice.joint);
  SetupReport report(report_of(words, entity), params, !words.choice.dry_run);
  cli::Answers answers;
  SetupGuide guide(params, endpoint, words.choice, report, answers);
  const bool done = guide.run();
  if (words.json) {
    cli::Json json = report.json();
    if (report.written()) json["report"] = report.file();
    cli::print_json(json);
  } else {
    const std::string kept = report.written() ? report.file() : "none: nothing was written";
    cli::answer(report.text(params) + fmt::format("  {:<18}{}\n", "report", kept));
  }
  return done ? cli::kGood : cli::kRunFailed;
}

}  // namespace

cli::Subcommand add_bus_setup(CLI::App& bus) {
  CLI::App* app = bus.add_subcommand(
      "setup", "serial servos, guided, joint by joint: ids, baud, zeros, directions");
  auto words = std::make_shared<SetupWords>();
  cli::add_model(*app, words->model)->capture_default_str();
  cli::add_bus_option(*app, words->bus);
  app->add_option("--link", words->link, "serial:/dev/ttyUSB0, pty:PATH, tcp:HOST:PORT, unix:PATH")
      ->required();
  app->add_option("--joint", words->choice.joint, "only this one, also if it is done");
  app->add_option("--report", words->report,
                  "what was set, and where to go on (default: ROBOT-setup.json)");
  app->add_flag("--wired", words->choice.wired,
                "all servos are connected and have their ids already");
  app->add_flag("--dry-run", words->choice.dry_run, "write nothing to any servo");
  cli::add_json_flag(*app, words->json);
  return {app, [words] {
            cli::catch_interrupts();
            return set_up(*words);
          }};
}

cli::Subcommand add_bus_checklist(CLI::App& bus) {
  CLI::App* app = bus.add_subcommand("checklist", "what to check before servos are powered");
  struct Words {
    std::string model = "generic21", bus;
  };
  auto words = std::make_shared<Words>();
  cli::add_model(*app, words->model)->capture_default_str();
  cli::add_bus_option(*app, words->bus);
  return {app, [words] {
            cli::answer(first_power_checklist(model::make_params(
                model::load_robot(model::find_model(words->model), words->bus))));
            return int{cli::kGood};
          }};
}

}  // namespace verp::tool
