#pragma once
#include <sdf/Link.hh>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Looks in the folders of the robot's file and above, of each included file, and in
/// VERP_MODEL_PATH; for ROS packages by name.
class PictureFiles {
 public:
  explicit PictureFiles(std::vector<std::string> from_files) : from_(std::move(from_files)) {}
  /// Empty: not found.
  std::string find(const std::string& uri) const;

 private:
  std::vector<std::string> from_;
};

/// Poses in the SDF link's frame. Omits unsupported shapes: only pictures need them.
std::vector<Visual> read_visuals(const sdf::Link& link, const PictureFiles& files);

}  // namespace verp::model
