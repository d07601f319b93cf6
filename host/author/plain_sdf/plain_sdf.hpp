#pragma once
#include <string>

#include "host/author/mjcf/mjcf.hpp"

/// SDF files of other makers (Gazebo's), without elements of ours.
namespace verp::plain_sdf {

/// In a world, the model with most joints is the robot. Throws LoadError at the element that cannot
/// be understood.
mjcf::Robot read_robot(const std::string& path);

}  // namespace verp::plain_sdf
