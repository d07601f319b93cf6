#pragma once
#include <string>
#include <vector>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/world.hpp"

namespace verp::model {

/// Loads and checks a <world>. Content that the twin cannot simulate throws LoadError with file,
/// line and remedy. Not thread-safe, like load_robot().
World load_world(const std::string& path);

/// A path or NAME: common/worlds/NAME/world.sdf, searched as find_model() does. Throws LoadError
/// with the existing names.
std::string find_world(const std::string& name_or_path);
/// A world's name, or a file with a <world>.
bool is_world(const std::string& name_or_path);
/// Sorted names.
std::vector<std::string> world_names();

/// `verp check` of a world: text or one JSON object.
std::string describe(const World& world);
std::string describe_json(const World& world);

}  // namespace verp::model
