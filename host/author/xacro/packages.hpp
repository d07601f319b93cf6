#pragma once
#include <optional>
#include <string>

namespace verp::xacro {

/// Folder of a ROS package: beside the file or above it, by its name or its package.xml.
std::optional<std::string> find_package(const std::string& name, const std::string& file);

/// A mesh's name from a file in `from`, as a file in `to` names it; as it is, if it is in no
/// package that can be found.
std::string moved_path(const std::string& name, const std::string& file, const std::string& to);

}  // namespace verp::xacro
