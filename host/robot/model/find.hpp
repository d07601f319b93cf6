#pragma once
#include <string>
#include <vector>

namespace verp::model {

/// A path, or NAME: NAME/robot.sdf in a folder of VERP_ROBOT_PATH (separated by ':'), in
/// common/robots below the current folder or the source tree, or in the current folder. Throws
/// LoadError with the existing names.
std::string find_model(const std::string& name_or_path);

/// Names in those places, sorted.
std::vector<std::string> model_names();

/// Folders for model:// addresses: VERP_MODEL_PATH (separated by ':'), by default ../shared/models
/// beside the source tree.
std::vector<std::string> model_path();
std::string model_path_text();

/// The file of `uri`: model://..., or relative to `from_file`; empty: not found.
std::string resolve_model_uri(const std::string& uri, const std::string& from_file);

}  // namespace verp::model
