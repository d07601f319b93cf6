#pragma once
#include <string>
#include <vector>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/world.hpp"

namespace verp::model {

/// Loads and checks the <world> of an SDF file. Nothing is guessed: what the twin could not make of
/// it throws LoadError with file, line and remedy. Not thread-safe, as load_robot().
World load_world(const std::string& path);

/// The file of a world given as a path, or as a name NAME that stands for
/// common/worlds/NAME/world.sdf, where find_model() looks for robots. Throws LoadError with the
/// names that exist.
std::string find_world(const std::string& name_or_path);
/// Whether find_world() would find a world: the name of one, or a file with a <world> in it.
bool is_world(const std::string& name_or_path);
/// Names of the worlds in common/worlds, sorted.
std::vector<std::string> world_names();

/// What `verp check` says of a world. For people, or as one JSON object.
std::string describe(const World& world);
std::string describe_json(const World& world);

}  // namespace verp::model
