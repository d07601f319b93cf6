#include <tinyxml2.h>

#include <algorithm>

#include "host/os/files/places.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/robot/model/named_files.hpp"

namespace verp::model {
namespace {

NamedFiles worlds() {
  return {"world", {"common/worlds", files::source_dir() / "common/worlds"}};
}

bool has_world(const std::string& path) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(path.c_str()) != tinyxml2::XML_SUCCESS) return false;
  const auto* root = document.RootElement();
  return root != nullptr && root->FirstChildElement("world") != nullptr;
}

}  // namespace

std::vector<std::string> world_names() {
  return worlds().names();
}

std::string find_world(const std::string& name_or_path) {
  return worlds().find(name_or_path);
}

bool is_world(const std::string& name_or_path) {
  if (is_file(name_or_path)) return has_world(name_or_path);
  const std::vector<std::string> names = world_names();
  return std::find(names.begin(), names.end(), name_or_path) != names.end();
}

}  // namespace verp::model
