#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/author/import/import.hpp"
#include "host/os/files/shell_line.hpp"
#include "host/os/files/whole.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;
using import::Imported;  // clang-format takes a line that begins with import for a module's

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
void refuse_existing(const fs::path& folder, const char* name) {
  std::error_code error;
  if (!fs::exists(folder / name, error)) return;
  throw cli::ToolError(cli::kBadInput, fmt::format("{}: is there already; remove it, or choose "
                                                   "another folder with -o",
                                                   (folder / name).string()));
}

/// Everything is made in a folder beside the wanted one, and moved when it is whole: an import that
/// was interrupted leaves nothing in the way of the next one.
class Workshop {
 public:
  explicit Workshop(const fs::path& folder)
      : wanted_(folder),
        folder_((fs::weakly_canonical(folder) / "").parent_path()),
        inside_(fmt::format("{}.part-{}", folder_.string(), ::getpid())) {
    std::error_code error;
    for (fs::path at = folder_.parent_path(); !fs::exists(at, error) && at.has_relative_path();
         at = at.parent_path()) {
      missing_.push_back(at);
    }
    fs::create_directories(inside_, error);
    const bool is_there = fs::is_directory(folder_);
    if (is_there && ::access(folder_.c_str(), W_OK) != 0)
      error = std::make_error_code(std::errc::permission_denied);
    else if (error && is_there)
      inside_ = folder_, error.clear();  // nothing may be made beside it
    if (error) refuse(error);
  }
  ~Workshop() { clear(); }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  const fs::path& folder() const { return inside_; }
  /// With the place where the files will be.
  std::string as_delivered(std::string text) const {
    const std::string inside = inside_.string(), outside = wanted_.string();
    for (auto at = text.find(inside); at != std::string::npos;) {
      text.replace(at, inside.size(), outside);
      at = text.find(inside, at + outside.size());
    }
    return text;
  }

  void refuse_conflicts() const {
    for (const fs::path& each : made()) refuse_existing(wanted_, each.filename().c_str());
  }

  void deliver() {
    refuse_conflicts();
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) refuse(error);
    missing_.clear();
    std::vector<fs::path> delivered;
    for (const fs::path& each : made()) {
      const fs::path place = folder_ / each.filename();
      const std::optional<std::string> bytes = files::read(each);
      const files::Trouble trouble = bytes ? files::create(place, *bytes) : files::Trouble(errno);
      if (!trouble.any()) {
        delivered.push_back(place);
        continue;
      }
      for (const fs::path& one : delivered) fs::remove(one, error);
      throw cli::ToolError(cli::kBadInput, place.string() + ": " + trouble.text());
    }
  }

 private:
  std::vector<fs::path> made() const {
    std::vector<fs::path> out;
    if (inside_ == folder_) return out;
    for (const auto& each : fs::directory_iterator(inside_)) out.push_back(each.path());
    return out;
  }
  void clear() const {
    std::error_code error;
    if (inside_ != folder_) fs::remove_all(inside_, error);
    for (const fs::path& each : missing_) fs::remove(each, error);
  }
  [[noreturn]] void refuse(const std::error_code& error) const {
    clear();
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: cannot be made ({}); choose another place with -o",
                                     wanted_.string(), error.message()));
  }

  fs::path wanted_, folder_, inside_;
  std::vector<fs::path> missing_;  ///< of its parents; the innermost first
};

cli::Json json_of(const Imported& robot, const std::string& sdf) {
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

void tell(const Imported& robot, const std::string& sdf) {
  std::string text;
  for (const import::Finding& each : robot.findings) {
    const bool guess = each.sureness == import::Finding::Sureness::kGuessed;
    text += fmt::format("{:<8} {:<10} {}{}\n", guess ? "guessed" : "found", each.what, each.value,
                        guess && !each.check.empty() ? "; " + each.check : "");
  }
  for (const std::string& each : robot.left_out) text += "changed  " + each + "\n";
  cli::answer(text);
  if (robot.refusal.empty())
    cli::answer(fmt::format("{}: made; try `verp walk {}`\n", sdf, files::shell_word(sdf)));
}

/// Empty: the guess is right, or nothing was guessed.
std::string ask_servos(const Imported& robot) {
  for (const import::Finding& each : robot.findings) {
    if (each.what != "servos" || each.sureness != import::Finding::Sureness::kGuessed) continue;
    fmt::print(stderr, "Servos: {}.\nEnter takes this guess; else write the type: ", each.value);
    std::string type;
    std::getline(std::cin, type);
    return type;
  }
  return "";
}

Imported import_asking(import::Wish& wish, bool asks) {
  Imported robot = import::import_robot(wish);
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
}

/// A walk needs no picture, so no trouble with it ends the import.
void draw(Imported& robot, const fs::path& folder) {
  if (!robot.refusal.empty()) return;
  const std::string place = (folder / kPicture).string();
  robot.no_picture = cli::trouble_of_other(
      "shot", {(folder / "robot.sdf").string(), "-o", place, "--size", "640x480"});
  if (robot.no_picture.empty()) robot.picture = kPicture;
}

Imported make(import::Wish& wish, const Workshop& workshop, bool asks) {
  Imported robot;
  try {
    import::make_urdf(wish);
    workshop.refuse_conflicts();
    robot = import_asking(wish, asks);
  } catch (const model::LoadError& error) {
    throw model::LoadError(workshop.as_delivered(error.file), error.line,
                           workshop.as_delivered(error.message), workshop.as_delivered(error.fix));
  }
  robot.refusal = workshop.as_delivered(robot.refusal);
  write_beside(workshop.folder() / "robot.sdf", robot.sdf);
  draw(robot, workshop.folder());
  write_beside(workshop.folder() / "import.md", import::page_of(robot, wish));
  return robot;
}

int import_file(const ImportWords& words) {
  import::Wish wish = words.wish;
  std::error_code error;
  if (fs::is_directory(wish.file, error)) {
    throw cli::ToolError(cli::kBadInput, wish.file + ": is a folder; give the robot's file in it");
  }
  if (wish.folder.empty()) wish.folder = fs::path(wish.file).stem().string() + "_verp";
  const fs::path folder = wish.folder;
  for (const char* const name : {"robot.sdf", "import.md", kPicture}) refuse_existing(folder, name);
  const bool asks = !words.yes && !words.json && isatty(STDIN_FILENO) != 0;
  if (!asks) cli::catch_interrupts();
  Workshop workshop(folder);
  wish.folder = workshop.folder().string();
  const Imported robot = make(wish, workshop, asks);
  if (cli::interrupted())
    throw cli::ToolError(cli::kRunFailed, "verp import: interrupted; nothing is made");
  workshop.deliver();
  const std::string sdf = (folder / "robot.sdf").string();
  if (words.json) {
    cli::print_json(json_of(robot, sdf));
  } else {
    tell(robot, sdf);
  }
  if (robot.refusal.empty()) return cli::kGood;
  throw cli::ToolError(cli::kBadInput, robot.refusal);
}

}  // namespace

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
