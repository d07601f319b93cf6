#include "host/apps/tool/robot/setup_report.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/os/files/whole.hpp"

namespace verp::tool {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{}: {}; choose another file with --report", file, why));
}

/// The first field of wrong type, or "".
std::string wrong_in(const cli::Json& entry) {
  if (!entry.is_object()) return "it";
  for (const char* name : {"outcome", "todo"}) {
    if (entry.contains(name) && !entry.at(name).is_string()) return name;
  }
  if (!entry.contains("changes")) return "";
  const cli::Json& changes = entry.at("changes");
  const auto sound = [](const cli::Json& each) {
    return each.is_object() && each.contains("before") && each.contains("after") &&
           each.contains("register") && each.at("register").is_string();
  };
  const bool all = changes.is_array() && std::all_of(changes.begin(), changes.end(), sound);
  return all ? "" : "changes";
}

constexpr std::size_t kMost = 1 << 20;      // longer than any report
constexpr std::size_t kRoomOfEntry = 2048;  // more than a joint needs

[[noreturn]] void refuse_place(const std::string& file, const files::Trouble& trouble) {
  refuse(file, trouble.what());
}

/// Checked before a servo changes: its entry would be lost. `now`: present content; `room`: bytes
/// to add.
void check_place(const std::string& file, const std::string& now, std::size_t room) {
  const std::string trial = file + "." + std::to_string(::getpid()) + ".trial";
  files::Trouble trouble = files::create(trial, now + std::string(room, ' '));
  if (!trouble.any()) ::unlink(trial.c_str());
  if (!trouble.any() && !now.empty()) trouble = files::replace(file, now);
  if (trouble.any()) refuse_place(file, trouble);
}

std::string contents(const std::string& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) refuse(file, "is a folder");
  if (!std::filesystem::is_regular_file(file, error)) refuse(file, "is no file");
  std::ifstream in(file, std::ios::binary);
  std::string text(kMost, '\0');
  if (in) in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in && !in.eof()) refuse(file, std::string("cannot be read: ") + std::strerror(errno));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::string line_of(const std::string& joint, const cli::Json& entry) {
  const std::string outcome = entry.value("outcome", "not yet");
  std::string changes;
  for (const cli::Json& each : entry.value("changes", cli::Json::array())) {
    changes += fmt::format("{}{} {} to {}", changes.empty() ? "" : ", ",
                           each.at("register").get<std::string>(), each.at("before").dump(),
                           each.at("after").dump());
  }
  const std::string todo = entry.value("todo", "");
  return fmt::format("  {:<18}{:<10}{}{}\n", joint, outcome, changes,
                     todo.empty() ? "" : (changes.empty() ? "" : "; ") + ("to do: " + todo));
}

}  // namespace

SetupReport::SetupReport(std::string file, const Params& params, bool writes)
    : file_(std::move(file)),
      writes_(writes),
      json_({{"robot", params.name}, {"baud", params.baud}, {"joints", cli::Json::object()}}) {
  std::error_code error;
  if (std::filesystem::exists(file_, error)) read(params);
  const std::size_t room = kRoomOfEntry * static_cast<std::size_t>(params.servo_count());
  if (writes) check_place(file_, written_ ? json_.dump(2) + '\n' : "", room);
}

void SetupReport::read(const Params& params) {
  cli::Json read = cli::Json::parse(contents(file_), nullptr, false);
  if (!read.is_object() || !read.contains("robot") || !read.contains("joints") ||
      !read.at("joints").is_object()) {
    refuse(file_, "is no report of `verp bus setup`");
  }
  if (read.at("robot") != params.name) {
    refuse(file_,
           fmt::format("is the report of {}, not of {}", read.at("robot").dump(), params.name));
  }
  for (const auto& [joint, entry] : read.at("joints").items()) {
    const std::string wrong = wrong_in(entry);
    if (wrong.empty()) continue;
    refuse(file_, fmt::format("is damaged: {} of joint '{}' is not what `verp bus setup` writes",
                              wrong, joint));
  }
  json_ = std::move(read);
  written_ = true;
}

bool SetupReport::done(const std::string& joint) const {
  const cli::Json& joints = json_.at("joints");
  return joints.contains(joint) && joints.at(joint).is_object() &&
         joints.at(joint).value("outcome", "") == "done";
}

cli::Json SetupReport::of(const std::string& joint) const {
  return json_.at("joints").value(joint, cli::Json::object());
}

void SetupReport::keep(const std::string& joint, const cli::Json& entry) {
  json_["joints"][joint] = entry;
  if (!writes_) return;
  const files::Trouble trouble = files::replace(file_, json_.dump(2) + '\n');
  if (trouble.any()) {
    cli::complain("  not in the report: " + cli::Json{{joint, entry}}.dump());
    refuse_place(file_, trouble);
  }
  written_ = true;
}

std::string SetupReport::text(const Params& params) const {
  std::string out =
      fmt::format("{}: servos set up on the bus of {} baud\n", params.name, params.baud);
  const cli::Json& joints = json_.at("joints");
  for (int j = 0; j < params.servo_count(); ++j) {
    const std::string name = params.joint[j].name;
    out += line_of(name, joints.contains(name) ? joints.at(name) : cli::Json::object());
  }
  return out;
}

}  // namespace verp::tool
