#include "host/robot/model/find.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "host/os/files/places.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/named_files.hpp"

namespace verp::model {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> folders_in(const char* variable) {
  std::vector<std::string> folders;
  std::string rest = variable == nullptr ? "" : variable;
  while (!rest.empty()) {
    const auto colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) folders.push_back(rest.substr(0, colon));
    rest.erase(0, std::min(colon + 1, rest.size()));
  }
  return folders;
}

/// "." is last: a file there must not replace the project's robot.
std::vector<fs::path> robot_folders() {
  std::vector<fs::path> folders;
  for (const std::string& each : folders_in(std::getenv("VERP_ROBOT_PATH")))
    folders.push_back(each);
  folders.insert(folders.end(), {"common/robots", files::source_dir() / "common/robots", "."});
  return folders;
}

NamedFiles robots() {
  return {"robot", robot_folders()};
}

std::string why_not_found(const std::string& name_or_path, bool looks_like_path,
                          const std::string& kind) {
  std::error_code ignored;
  if (fs::is_directory(name_or_path, ignored)) return "is a folder, not a " + kind + "'s file";
  if (fs::exists(name_or_path, ignored)) return "is not a regular file";
  return looks_like_path ? "there is no such file" : "there is no " + kind + " of this name";
}

}  // namespace

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::vector<std::string> NamedFiles::names() const {
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (is_file(entry.path() / (kind + ".sdf"))) names.insert(entry.path().filename().string());
    }
  }
  return {names.begin(), names.end()};
}

std::string NamedFiles::find(const std::string& name_or_path) const {
  if (is_file(name_or_path)) return name_or_path;
  const bool looks_like_path =
      name_or_path.ends_with(".sdf") || name_or_path.find('/') != std::string::npos;
  for (const fs::path& folder : folders) {
    const fs::path candidate = folder / name_or_path / (kind + ".sdf");
    if (!looks_like_path && is_file(candidate)) return candidate.string();
  }
  throw LoadError(
      name_or_path, 0, why_not_found(name_or_path, looks_like_path, kind),
      fmt::format("give the path of an .sdf file, or one of: {}", fmt::join(names(), ", ")));
}

std::vector<std::string> model_names() {
  return robots().names();
}

std::string find_model(const std::string& name_or_path) {
  return robots().find(name_or_path);
}

std::vector<std::string> model_path() {
  const char* variable = std::getenv("VERP_MODEL_PATH");
  if (!variable || !*variable) {
    return {(files::source_dir() / "../shared/models").lexically_normal().string()};
  }
  return folders_in(variable);
}

std::string model_path_text() {
  return fmt::format("{}", fmt::join(model_path(), ":"));
}

std::string resolve_model_uri(const std::string& uri, const std::string& from_file) {
  constexpr std::string_view kScheme = "model://";
  if (!uri.starts_with(kScheme)) {
    const fs::path candidate = fs::path(from_file).parent_path() / uri;
    return !uri.empty() && is_file(candidate) ? candidate.string() : std::string();
  }
  for (const std::string& folder : model_path()) {
    const fs::path candidate = fs::path(folder) / uri.substr(kScheme.size());
    if (is_file(candidate)) return candidate.string();
  }
  return {};
}

}  // namespace verp::model
