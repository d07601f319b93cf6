#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <regex>
#include <sstream>

#include "common/model/params.hpp"
#include "host/apps/cli/command.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/robot_table.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

struct NewControllerWords {
  std::string name, in = ".";
};

constexpr std::size_t kLongest = 40;
constexpr const char* kFiles[] = {"README.md",      "CMakeLists.txt",      "controller.hpp",
                                  "controller.cpp", "controller_test.cpp", ".gitignore"};

void check_name(const std::string& name) {
  const auto plain = [](unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '_'); };
  if (!name.empty() && name.size() <= kLongest &&
      std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
      std::all_of(name.begin(), name.end(), plain)) {
    return;
  }
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp new controller: '{}' is no name; give up to {} letters, "
                                   "digits and _, a letter first",
                                   name, kLongest));
}

std::string filled_in(const std::string& text, const std::string& name) {
  static const std::regex kName("\\bNAME\\b"), kRoot("@VERP_ROOT@");
  return std::regex_replace(std::regex_replace(text, kName, name), kRoot,
                            files::source_dir().string());
}

std::string template_of(const std::string& file) {
  if (file == ".gitignore") return "build/\nreport/\n";
  const fs::path source = files::source_dir() / "host/run/own/template" / file;
  if (const std::optional<std::string> text = files::read(source)) return *text;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp new controller: {} is not there: a controller is built on VERP's "
                  "sources, so begin with the ./verp of a clone",
                  source.string()));
}

int new_controller(const NewControllerWords& words) {
  check_name(words.name);
  std::error_code error;
  const fs::path folder = fs::absolute(words.in, error) / words.name;
  if (fs::exists(folder, error)) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: is there already; choose another name, or another "
                                     "place with --in",
                                     folder.lexically_normal().string()));
  }
  template_of(kFiles[0]);  // throws early
  fs::create_directories(folder, error);
  if (error) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: cannot be made ({}); choose another place with --in",
                                     folder.lexically_normal().string(), error.message()));
  }
  for (const char* file : kFiles) {
    const auto trouble = files::create(folder / file, filled_in(template_of(file), words.name));
    if (!trouble.any()) continue;
    throw cli::ToolError(
        cli::kBadInput, fmt::format("{}: {} with --in", (folder / file).lexically_normal().string(),
                                    trouble.text()));
  }
  const std::string place = (fs::path(words.in) / words.name).lexically_normal().string();
  cli::answer(fmt::format("{}: laid out; {}/README.md says what is where\n", place, place));
  cli::answer(
      fmt::format("`verp walk --controller {0}` walks it; with --on mps2_an386 on an emulated "
                  "board, and `verp flash --controller {0}` writes it into one\n",
                  place));
  return cli::kGood;
}

cli::Subcommand add_new_controller(CLI::App& parent) {
  CLI::App* app = parent.add_subcommand(
      "controller",
      "a folder with a controller for the robots: walked, emulated and flashed by "
      "--controller");
  auto words = std::make_shared<NewControllerWords>();
  app->add_option("NAME", words->name, "of the controller, and of its folder")->required();
  app->add_option("--in", words->in, "folder (default: the working folder)");
  return {app, [words] { return new_controller(*words); }};
}

namespace fs = std::filesystem;

struct NewRobotWords {
  std::string name, from, in;
};

void write_text(const fs::path& file, const std::string& text) {
  const files::Trouble trouble = files::replace(file, text);
  if (trouble.any()) throw cli::ToolError(cli::kBadInput, file.string() + ": " + trouble.text());
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
