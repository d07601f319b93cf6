#pragma once
#include <string>
#include <vector>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/world.hpp"

namespace verp::model {

/// Loads and checks the <world> of an SDF file. It guesses nothing: what the twin cannot simulate
/// throws LoadError with file, line and remedy. Not thread-safe, like load_robot().
World load_world(const std::string& path);

/// File of a world given as a path or as a NAME, which means common/worlds/NAME/world.sdf; searched
/// where find_model() searches. Throws LoadError with the existing names.
std::string find_world(const std::string& name_or_path);
/// True for the name of a world, or a file with a <world> in it.
bool is_world(const std::string& name_or_path);
/// Names of the worlds in common/worlds, sorted.
std::vector<std::string> world_names();

/// Output of `verp check` for a world. For people, or as one JSON object.
std::string describe(const World& world);
std::string describe_json(const World& world);

}  // namespace verp::model
