#pragma once
#include <string>
#include <vector>

namespace verp::xacro {

struct Expanded {
  std::string urdf;
  std::vector<std::string> left_out;  ///< one line each
};

/// Expands xacro: properties, arguments with their defaults, macros with blocks, includes,
/// conditions, expressions. `folder`: where the URDF will be, for paths of meshes. A package is
/// looked for beside the file and above it. Throws LoadError at the element.
Expanded expand(const std::string& file, const std::string& folder);

}  // namespace verp::xacro
