#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/author/action/let_go.hpp"
#include "host/author/mjcf/mjcf.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/check.hpp"
#include "host/robot/model/export.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/run/scenario/field_bugs.hpp"
#include "host/run/session/servo_speed.hpp"

namespace verp::tool {
namespace {

int check_world(const std::string& name, bool json) {
  const model::World world = model::load_world(model::find_world(name));
  cli::answer(json ? model::describe_json(world) : model::describe(world));
  return cli::kGood;
}

void write_whole(const std::string& file, const std::string& text) {
  const files::Trouble trouble = files::replace(file, text);
  if (trouble.any()) throw cli::ToolError(cli::kBadInput, file + ": " + trouble.text());
}

/// As other programs read it; an empty name: not in that format.
void write_robot(const std::string& name, const std::string& bus, const std::string& urdf,
                 const std::string& mjcf) {
  const model::Entity entity = model::load_robot(model::find_model(name), bus);
  for (const auto& [file, text_of] :
       {std::pair{urdf, &mjcf::urdf_of}, std::pair{mjcf, &mjcf::mjcf_of}}) {
    if (file.empty()) continue;
    mjcf::Robot robot = mjcf::robot_of(entity);
    write_whole(file, text_of(robot, std::filesystem::absolute(file).parent_path().string()));
    std::string told = fmt::format("{}: written\n", file);
    for (const std::string& each : robot.left_out) told += "left out  " + each + "\n";
    cli::answer(told);
  }
}

/// Throws the model::LoadError that reports this mistake in the file.
void check_mistake(const std::string& fault, const model::Entity& entity) {
  try {
    const scenario::FieldBug& bug = scenario::field_bug(fault);
    if (bug.in_file()) static_cast<void>(scenario::params_of(bug, entity));
  } catch (const scenario::ScenarioError& error) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp check --fault: {}; `verp faults` lists them", error.what()));
  }
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp check --fault {}: no reading of the file shows this bug; "
                                   "give it to verp walk",
                                   fault));
}

int check_robot(const std::string& name, const std::string& bus, const std::string& fault,
                bool json) {
  const model::Entity entity = model::load_robot(model::find_model(name), bus);
  if (!fault.empty()) check_mistake(fault, entity);
  const action::LetGo ends = action::let_go(entity);
  const session::ServoSpeed speed = session::servo_speed(model::make_params(entity));
  if (!json) {
    cli::answer(model::describe(entity) + "servo speed: " + session::text_of(speed) +
                "\nletting go: " + ends.words(name) + "\n");
    return cli::kGood;
  }
  cli::Json out = cli::Json::parse(model::describe_json(entity));
  out["letting_go"] = {{"tried", ends.tried},         {"good", ends.good},
                       {"by_action", ends.by_action}, {"ends", ends.ends},
                       {"moved_rad", ends.moved_rad}, {"fall_percent", ends.fall_percent}};
  out["servo_speed"] = {{"walk_m_s", speed.walk_m_s},
                        {"most_m_s", speed.most_m_s},
                        {"joint", speed.fastest.joint},
                        {"needed_rad_s", session::needed_rad_s(speed.fastest)},
                        {"limit_rad_s", speed.fastest.limit_rad_s}};
  cli::print_json(out);
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_check(CLI::App& root) {
  struct Options {
    std::string model, bus, fault;
    bool json = false;
  };
  CLI::App* app = cli::declare_other(root, "check");
  auto options = std::make_shared<Options>();
  cli::add_model(*app, options->model)->required();
  cli::add_bus_option(*app, options->bus);
  app->add_option("--fault", options->fault, "put this field bug into the file (verp faults)");
  cli::add_json_flag(*app, options->json);
  return {app, [options] {
            return model::is_world(options->model)
                       ? check_world(options->model, options->json)
                       : check_robot(options->model, options->bus, options->fault, options->json);
          }};
}

cli::Subcommand add_export(CLI::App& root) {
  struct Options {
    std::string model, bus, folder, urdf, mjcf;
  };
  CLI::App* app = cli::declare_other(root, "export");
  auto options = std::make_shared<Options>();
  cli::add_model(*app, options->model)->required();
  cli::add_bus_option(*app, options->bus);
  app->add_option("-o,--output", options->folder, "folder of the Params image and its header");
  app->add_option("--urdf", options->urdf, "write a URDF here instead");
  app->add_option("--mjcf", options->mjcf, "write an MJCF file (MuJoCo) here instead");
  return {app, [options] {
            const bool as_robot = !options->urdf.empty() || !options->mjcf.empty();
            if (as_robot) write_robot(options->model, options->bus, options->urdf, options->mjcf);
            if (!options->folder.empty())
              return model::export_command(options->model, options->bus, options->folder);
            if (as_robot) return static_cast<int>(cli::kGood);
            throw cli::ToolError(cli::kBadInput,
                                 "nothing to write; give -o FOLDER, --urdf FILE or --mjcf FILE");
          }};
}

}  // namespace verp::tool
