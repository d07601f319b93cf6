#include "host/tool/setup_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "host/tool/exit_status.hpp"

namespace verp::tool {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw ToolError(kBadInput, fmt::format("{}: {}; choose another file with --report", file, why));
}

/// What line_of() and done() read has its types; returns what has not, or nothing.
std::string wrong_in(const Json& entry) {
  if (!entry.is_object()) return "it";
  for (const char* name : {"outcome", "todo"}) {
    if (entry.contains(name) && !entry.at(name).is_string()) return name;
  }
  if (!entry.contains("changes")) return "";
  const Json& changes = entry.at("changes");
  const auto sound = [](const Json& each) {
    return each.is_object() && each.contains("before") && each.contains("after") &&
           each.contains("register") && each.at("register").is_string();
  };
  const bool all = changes.is_array() && std::all_of(changes.begin(), changes.end(), sound);
  return all ? "" : "changes";
}

/// Known before a servo is written to, whose entry would then be lost.
void check_place(const std::string& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) refuse(file, "is a folder");
  const std::string part = file + ".part";
  if (!std::ofstream(part, std::ios::app)) {
    refuse(file, std::string("cannot be written: ") + std::strerror(errno));
  }
  std::filesystem::remove(part, error);
}

std::string line_of(const std::string& joint, const Json& entry) {
  const std::string outcome = entry.value("outcome", "not yet");
  std::string changes;
  for (const Json& each : entry.value("changes", Json::array())) {
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
      json_({{"robot", params.name}, {"baud", params.baud}, {"joints", Json::object()}}) {
  if (writes) check_place(file_);
  std::error_code error;
  if (!std::filesystem::exists(file_, error)) return;
  std::ifstream in(file_);
  if (!in) refuse(file_, std::string("cannot be read: ") + std::strerror(errno));
  Json read = Json::parse(in, nullptr, false);
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
  const Json& joints = json_.at("joints");
  return joints.contains(joint) && joints.at(joint).is_object() &&
         joints.at(joint).value("outcome", "") == "done";
}

void SetupReport::keep(const std::string& joint, const Json& entry) {
  json_["joints"][joint] = entry;
  if (!writes_) return;
  const std::string part = file_ + ".part";
  {
    std::ofstream out(part);
    out << json_.dump(2) << '\n';
    out.flush();
    if (!out) refuse(file_, std::string("cannot be written: ") + std::strerror(errno));
  }
  if (std::rename(part.c_str(), file_.c_str()) != 0) {
    refuse(file_, std::string("cannot be written: ") + std::strerror(errno));
  }
  written_ = true;
}

std::string SetupReport::text(const Params& params) const {
  std::string out =
      fmt::format("{}: servos set up on the bus of {} baud\n", params.name, params.baud);
  const Json& joints = json_.at("joints");
  for (int j = 0; j < params.joint_count; ++j) {
    const std::string name = params.joint[j].name;
    out += line_of(name, joints.contains(name) ? joints.at(name) : Json::object());
  }
  return out;
}

}  // namespace verp::tool
