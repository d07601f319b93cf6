#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "host/model/find.hpp"
#include "host/model/load.hpp"
#include "host/model/params.hpp"
#include "host/tool/console.hpp"
#include "host/tool/first_power.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/json.hpp"
#include "host/tool/setup_command.hpp"
#include "host/tool/setup_guide.hpp"
#include "host/tool/suggest.hpp"
#include "host/tool/walk_options.hpp"

namespace verp::tool {
namespace {

struct SetupWords {
  std::string model = "generic21", link, report;
  SetupChoice choice;
  bool json = false;
};

Params params_of(const std::string& model) {
  const model::Entity entity = model::load_robot(model::find_model(model));
  require_serial("verp bus setup", entity);
  return model::make_params(entity);
}

void check_joint(const Params& params, const std::string& wanted) {
  std::vector<std::string> names;
  for (int j = 0; j < params.joint_count; ++j) names.emplace_back(params.joint[j].name);
  if (wanted.empty() || std::find(names.begin(), names.end(), wanted) != names.end()) return;
  throw ToolError(kBadInput, fmt::format("verp bus setup: {} has no joint '{}'{}", params.name,
                                         wanted, did_you_mean(wanted, names)));
}

int set_up(const SetupWords& words) {
  const Params params = params_of(words.model);
  check_joint(params, words.choice.joint);
  SetupReport report(
      words.report.empty() ? fmt::format("{}-setup.json", params.name) : words.report, params,
      !words.choice.dry_run);
  const wire::Endpoint endpoint = wire::parse_endpoint(words.link);
  Answers answers;
  SetupGuide guide(params, endpoint, words.choice, report, answers);
  const bool done = guide.run();
  if (words.json) {
    Json json = report.json();
    if (report.written()) json["report"] = report.file();
    print_json(json);
  } else {
    const std::string kept = report.written() ? report.file() : "none: nothing was written";
    answer(report.text(params) + fmt::format("  {:<18}{}\n", "report", kept));
  }
  return done ? kGood : kRunFailed;
}

}  // namespace

Subcommand add_bus_setup(CLI::App& bus) {
  CLI::App* app =
      bus.add_subcommand("setup", "guided, joint by joint: ids, baud, zeros, directions");
  auto words = std::make_shared<SetupWords>();
  app->add_option("MODEL", words->model, "a robot of common/robots, or the path of an SDF file")
      ->capture_default_str();
  app->add_option("--link", words->link, "serial:/dev/ttyUSB0, pty:PATH, tcp:HOST:PORT, unix:PATH")
      ->required();
  app->add_option("--joint", words->choice.joint, "only this one, also if it is done");
  app->add_option("--report", words->report,
                  "what was set, and where to go on (default: ROBOT-setup.json)");
  app->add_flag("--wired", words->choice.wired,
                "all servos are connected and have their ids already");
  app->add_flag("--dry-run", words->choice.dry_run, "write nothing to any servo");
  add_json_flag(*app, words->json);
  return {app, [words] {
            catch_interrupts();
            return set_up(*words);
          }};
}

Subcommand add_bus_checklist(CLI::App& bus) {
  CLI::App* app = bus.add_subcommand("checklist", "what to check before servos are powered");
  struct Words {
    std::string model = "generic21", bus;
  };
  auto words = std::make_shared<Words>();
  app->add_option("MODEL", words->model, "a robot of common/robots, or the path of an SDF file")
      ->capture_default_str();
  add_bus_option(*app, words->bus);
  return {app, [words] {
            answer(first_power_checklist(model::make_params(
                model::load_robot(model::find_model(words->model), words->bus))));
            return int{kGood};
          }};
}

}  // namespace verp::tool
