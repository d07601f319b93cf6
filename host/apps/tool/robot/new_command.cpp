#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>

#include "common/model/params.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/robot/new_controller.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/robot_table.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

struct NewRobotWords {
  std::string name, from, in;
};

void write_text(const fs::path& file, const std::string& text) {
  if (!files::write(file, text)) {
    throw cli::ToolError(cli::kBadInput,
                         file.string() + ": cannot be written; choose another place with --in");
  }
}

void check_robot_name(const std::string& name) {
  const bool good = !name.empty() && name.size() < kNameLength &&
                    std::all_of(name.begin(), name.end(), [](char c) {
                      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
                    });
  if (good) return;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp new robot: '{}' is no name; give up to {} small letters, digits "
                  "and _",
                  name, kNameLength - 1));
}

/// Shipped robots are found first: a new table would have no effect.
void refuse_shipped(const std::string& name, const fs::path& sdf) {
  std::string found;
  try {
    found = model::find_model(name);
  } catch (const model::LoadError&) {
    return;
  }
  std::error_code error;
  if (fs::equivalent(found, sdf, error)) return;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp new robot: there is a robot '{}' already, {}; choose "
                                   "another name",
                                   name, found));
}

/// The robot's table, or a table's path.
fs::path table_of(const std::string& from) {
  if (from.ends_with(".table")) return from;
  const fs::path folder = fs::path(model::find_model(from)).parent_path();
  const fs::path table = folder / (folder.filename().string() + ".table");
  std::error_code ignored;
  if (fs::exists(table, ignored)) return table;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp new robot: --from {}: has no table of its own; give a robot that "
                  "is made from one, such as generic21, or a .table file",
                  from));
}

/// The table with the new name and opening comment.
std::string table_for(const std::string& table, const NewRobotWords& options) {
  std::string out = fmt::format(
      "# {0}: lengths, masses and servos; begun as a copy of {1}. Change them here, then\n"
      "#   verp new robot {0}\n"
      "# generates robot.sdf beside this file anew. SI units; x forward, y left, z up; all lengths "
      "at "
      "the zero pose.\n",
      options.name, options.from);
  std::istringstream lines(table);
  bool begun = false;  // past the old opening comment
  for (std::string line; std::getline(lines, line);) {
    begun |= !line.empty() && line.front() != '#';
    if (!begun) continue;
    const bool name = line.starts_with("name ") || line.starts_with("name=");
    out += (name ? "name = " + options.name : line) + '\n';
  }
  return out;
}

std::string sdf_of(const fs::path& table) {
  model::RobotTable rows(table.string());
  std::string sdf = model::generate_sdf(rows);
  rows.require_all_read();
  return sdf;
}

fs::path place_for(const NewRobotWords& options) {
  if (!options.in.empty()) return fs::path(options.in) / options.name;
  const char* path = std::getenv("VERP_ROBOT_PATH");
  const std::string first =
      path == nullptr ? "" : std::string(path).substr(0, std::string(path).find(':'));
  return first.empty() ? fs::path(options.name) : fs::path(first) / options.name;
}

int new_robot(const NewRobotWords& options) {
  check_robot_name(options.name);
  const fs::path folder = place_for(options), sdf = folder / "robot.sdf";
  const fs::path table = folder / (options.name + ".table");
  if (options.in.empty()) refuse_shipped(options.name, sdf);
  std::error_code error;
  const bool again = fs::exists(table, error);
  if (!again && fs::exists(sdf, error)) {
    throw cli::ToolError(cli::kBadInput,
                         sdf.string() + ": is not made from a table here; choose another name");
  }
  if (again && !options.from.empty()) {
    throw cli::ToolError(cli::kBadInput, table.string() +
                                             ": is there already; leave --from out to generate "
                                             "robot.sdf from it, or choose another name");
  }
  if (!again) {
    NewRobotWords named = options;
    if (named.from.empty()) named.from = "generic21";
    const std::string text = table_for(files::read(table_of(named.from)).value_or(""), named);
    fs::create_directories(folder, error);
    write_text(table, text);
  }
  try {
    write_text(sdf, sdf_of(table));
  } catch (const model::LoadError&) {
    if (!again) fs::remove(table, error);  // nothing stays after a failure
    if (!again) fs::remove(folder, error);
    throw;
  }
  cli::answer(
      fmt::format("{}: made{} from {}\n", sdf.string(), again ? " anew" : "", table.string()));
  const std::string word = options.in.empty() ? options.name : sdf.string();
  cli::answer(fmt::format(
      "change the table, `verp new robot {}` again; then `verp check {}`, `verp walk {}`\n",
      options.name, word, word));
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_new(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "new");
  app->require_subcommand(1);
  CLI::App* robot = app->add_subcommand(
      "robot", "a table of lengths, masses and servos, and the robot that is generated from it");
  auto options = std::make_shared<NewRobotWords>();
  robot->add_option("NAME", options->name, "of the robot, and of its folder")->required();
  robot->add_option("--from", options->from,
                    "a robot that is made from a table, or a .table file (default: generic21)");
  robot->add_option("--in", options->in,
                    "folder (default: the first of VERP_ROBOT_PATH, else the working folder)");
  const cli::Subcommand controller = add_new_controller(*app);
  return {app, [options, controller] {
            return controller.app->parsed() ? controller.run() : new_robot(*options);
          }};
}

}  // namespace verp::tool
