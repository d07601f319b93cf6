#include <tinyxml2.h>

#include <algorithm>
#include <filesystem>

#include "host/files/places.hpp"
#include "host/model/load_world.hpp"
#include "host/model/not_found.hpp"

namespace verp::model {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> world_folders() {
  return {fs::path("common/worlds"), files::source_dir() / "common/worlds"};
}

bool is_a_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool has_world(const std::string& path) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(path.c_str()) != tinyxml2::XML_SUCCESS) return false;
  const auto* root = document.RootElement();
  return root != nullptr && root->FirstChildElement("world") != nullptr;
}

}  // namespace

std::vector<std::string> world_names() {
  std::vector<std::string> names;
  for (const fs::path& folder : world_folders()) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (is_a_file(entry.path() / "world.sdf")) names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string find_world(const std::string& name_or_path) {
  if (is_a_file(name_or_path)) return name_or_path;
  const bool looks_like_path =
      name_or_path.ends_with(".sdf") || name_or_path.find('/') != std::string::npos;
  if (!looks_like_path) {
    for (const fs::path& folder : world_folders()) {
      const fs::path candidate = folder / name_or_path / "world.sdf";
      if (is_a_file(candidate)) return candidate.string();
    }
  }
  std::string list;
  for (const std::string& name : world_names()) list += (list.empty() ? "" : ", ") + name;
  throw LoadError(name_or_path, 0, why_not_found(name_or_path, "world"),
                  "give the path of an .sdf file, or one of: " + list);
}

bool is_world(const std::string& name_or_path) {
  if (is_a_file(name_or_path)) return has_world(name_or_path);
  const std::vector<std::string> names = world_names();
  return std::find(names.begin(), names.end(), name_or_path) != names.end();
}

}  // namespace verp::model
