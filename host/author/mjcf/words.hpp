#pragma once
#include <string>

#include "host/author/mjcf/mjcf.hpp"

/// What both writers need.
namespace verp::mjcf {

/// Exact to 1e-12 of the largest.
std::string numbers(const Vec3& v);
/// ".stl": with the dot, in small letters.
std::string ending_of(const std::string& file);
/// As a file in `folder` names it.
std::string path_from(const std::string& folder, const std::string& file);

}  // namespace verp::mjcf
