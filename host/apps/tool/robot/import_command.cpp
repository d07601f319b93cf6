#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/author/import/import.hpp"
#include "host/os/files/whole.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPicture = "import.png";

struct ImportWords {
  import::Wish wish;
  bool json = false, yes = false;
};

void write_beside(const fs::path& file, const std::string& text) {
  const files::Trouble trouble = files::replace(file, text);
  if (trouble.any()) throw cli::ToolError(cli::kBadInput, file.string() + ": " + trouble.text());
}

/// Work of the owner is kept.
void refuse_existing(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / "robot.sdf", error)) return;
  throw cli::ToolError(cli::kBadInput, fmt::format("{}: is there already; remove it, or choose "
                                                   "another folder with -o",
                                                   (folder / "robot.sdf").string()));
}

/// Those that were missing, the innermost first.
std::vector<fs::path> make_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path at = fs::absolute(folder, error); !fs::exists(at, error) && at.has_relative_path();
       at = at.parent_path()) {
    missing.push_back(at);
  }
  fs::create_directories(folder, error);
  if (!error) return missing;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{}: cannot be made ({}); choose another place with -o",
                                   folder.string(), error.message()));
}

cli::Json json_of(const import::Imported& robot, const std::string& sdf) {
  cli::Json findings = cli::Json::array();
  for (const import::Finding& each : robot.findings) {
    const bool guess = each.sureness == import::Finding::Sureness::kGuessed;
    findings.push_back(
        {{"what", each.what}, {"value", each.value}, {"guessed", guess}, {"check", each.check}});
  }
  return {{"name", robot.name},       {"robot", sdf},
          {"findings", findings},     {"left_out", robot.left_out},
          {"picture", robot.picture}, {"no_picture", robot.no_picture},
          {"refusal", robot.refusal}};
}

void tell(const import::Imported& robot, const std::string& sdf) {
  std::string text;
  for (const import::Finding& each : robot.findings) {
    const bool guess = each.sureness == import::Finding::Sureness::kGuessed;
    text += fmt::format("{:<8} {:<10} {}{}\n", guess ? "guessed" : "found", each.what, each.value,
                        guess && !each.check.empty() ? "; " + each.check : "");
  }
  for (const std::string& each : robot.left_out) text += "changed  " + each + "\n";
  cli::answer(text);
  if (robot.refusal.empty())
    cli::answer(fmt::format("{}: made; `verp walk {}` walks it\n", sdf, sdf));
}

/// Empty: the guess is right, or nothing was guessed.
std::string ask_servos(const import::Imported& robot) {
  for (const import::Finding& each : robot.findings) {
    if (each.what != "servos" || each.sureness != import::Finding::Sureness::kGuessed) continue;
    fmt::print(stderr, "Servos: {}.\nEnter takes this guess; else write the type: ", each.value);
    std::string type;
    std::getline(std::cin, type);
    return type;
  }
  return "";
}

import::Imported import_asking(import::Wish& wish,
                               bool asks){import::Imported robot = import::import_robot(wish);
if (!asks || !wish.servo_type.empty()) return robot;
for (std::string type = ask_servos(robot); !type.empty(); type = ask_servos(robot)) {
  wish.servo_type = type;
  try {
    return import::import_robot(wish);
  } catch (const model::LoadError& error) {
    fmt::print(stderr, "{}\n", error.what());
  }
}
return robot;
}  // namespace

/// A walk needs no picture, so no trouble with it ends the import.
void draw(import::Imported& robot, const fs::path& folder) {
  if (!robot.refusal.empty()) return;
  const std::string place = (folder / kPicture).string();
  robot.no_picture = cli::trouble_of_other(
      "shot", {(folder / "robot.sdf").string(), "-o", place, "--size", "640x480"});
  if (robot.no_picture.empty()) robot.picture = kPicture;
}

int import_file(const ImportWords& words) {
  import::Wish wish = words.wish;
  std::error_code error;
  if (fs::is_directory(wish.file, error)) {
    throw cli::ToolError(cli::kBadInput, wish.file + ": is a folder; give the robot's file in it");
  }
  if (wish.folder.empty()) wish.folder = fs::path(wish.file).stem().string() + "_verp";
  const fs::path folder = wish.folder, sdf = folder / "robot.sdf";
  refuse_existing(folder);
  const std::vector<fs::path> made = make_folders(folder);
  import::Imported robot;
  try {
    import::make_urdf(wish);
    const bool asks = !words.yes && !words.json && isatty(STDIN_FILENO) != 0;
    robot = import_asking(wish, asks);
  } catch (...) {
    if (!wish.maker_file.empty()) fs::remove(wish.file, error);
    for (const fs::path& each : made) fs::remove(each, error);
    throw;
  }
  write_beside(sdf, robot.sdf);
  draw(robot, folder);
  write_beside(folder / "import.md", import::page_of(robot, wish));
  if (words.json) {
    cli::print_json(json_of(robot, sdf.string()));
  } else {
    tell(robot, sdf.string());
  }
  if (robot.refusal.empty()) return cli::kGood;
  throw cli::ToolError(cli::kBadInput, robot.refusal);
}

}  // namespace verp::tool

cli::Subcommand add_import(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "import");
  auto words = std::make_shared<ImportWords>();
  app->add_option("FILE", words->wish.file,
                  "URDF, xacro, SDF or MJCF of a robot; it is not changed")
      ->required();
  app->add_option("-o,--output", words->wish.folder, "folder (default: FILE's name and _verp)");
  app->add_option("--name", words->wish.name, "of the robot (default: the file's)");
  app->add_option("--servos", words->wish.servo_type,
                  "type of its servos (default: the weakest that carries it)");
  app->add_flag("-y,--yes", words->yes, "take the guesses; without it, a terminal is asked");
  cli::add_json_flag(*app, words->json);
  return {app, [words] { return import_file(*words); }};
}

}  // namespace verp::tool
