#pragma once
#include <string>
#include <vector>

namespace verp::model {

/// The SDF file of a robot given as a path to one, or as a name NAME that stands for
/// NAME/robot.sdf in a folder of VERP_ROBOT_PATH (separated by ':'), in common/robots below the
/// current folder or below the source tree this program was built from, or in the current folder.
/// Throws LoadError with the names that exist.
std::string find_model(const std::string& name_or_path);

/// Names of the robots in those places, sorted.
std::vector<std::string> model_names();

/// Folders searched for model:// addresses: VERP_MODEL_PATH (separated by ':'), by default the
/// folder of third-party robots beside the source tree (../shared/models).
std::vector<std::string> model_path();
std::string model_path_text();

/// The file that `uri` (model://..., or a path relative to `from_file`) names; empty when there is
/// none.
std::string resolve_model_uri(const std::string& uri, const std::string& from_file);

}  // namespace verp::model
