#pragma once
#include <string>
#include <utility>
#include <vector>

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

}  // namespace verp::model
