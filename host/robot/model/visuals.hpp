#pragma once
#include <sdf/Link.hh>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Where the files are that a robot's file names: its own folder and those above it, that of each
/// file it includes, VERP_MODEL_PATH. ROS packages lie there by their name.
class PictureFiles {
 public:
  explicit PictureFiles(std::vector<std::string> from_files) : from_(std::move(from_files)) {}
  /// Empty: there is no such file.
  std::string find(const std::string& uri) const;

 private:
  std::vector<std::string> from_;
};

/// What a link looks like, poses in the SDF link's own frame. Shapes that nobody draws are left
/// out: nothing that is seen is worth refusing a robot for.
std::vector<Visual> read_visuals(const sdf::Link& link, const PictureFiles& files);

}  // namespace verp::model
