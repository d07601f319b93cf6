#pragma once
#include <sdf/Link.hh>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Finds the files that a robot's file names: in its own folder and those above, in those of each
/// included file, and in VERP_MODEL_PATH. ROS packages are found by name.
class PictureFiles {
 public:
  explicit PictureFiles(std::vector<std::string> from_files) : from_(std::move(from_files)) {}
  /// Empty: not found.
  std::string find(const std::string& uri) const;

 private:
  std::vector<std::string> from_;
};

/// Visuals of a link, with poses in the SDF link's own frame. Unsupported shapes are omitted, not
/// errors, because they only affect pictures.
std::vector<Visual> read_visuals(const sdf::Link& link, const PictureFiles& files);

}  // namespace verp::model
