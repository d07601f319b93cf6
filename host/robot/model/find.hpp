#pragma once
#include <string>
#include <vector>

namespace verp::model {

/// SDF file of a robot given as a path or as a NAME. NAME means NAME/robot.sdf in a folder of
/// VERP_ROBOT_PATH (separated by ':'), in common/robots below the current folder or the source
/// tree, or in the current folder. Throws LoadError with the existing names.
std::string find_model(const std::string& name_or_path);

/// Names of the robots in those places, sorted.
std::vector<std::string> model_names();

/// Search path for model:// addresses: VERP_MODEL_PATH (separated by ':'), by default the folder of
/// third-party robots beside the source tree (../shared/models).
std::vector<std::string> model_path();
std::string model_path_text();

/// File of `uri` (model://..., or a path relative to `from_file`); empty: not found.
std::string resolve_model_uri(const std::string& uri, const std::string& from_file);

}  // namespace verp::model
