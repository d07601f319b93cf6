#pragma once
#include <filesystem>
#include <string>

#include "host/study/identify/identify.hpp"

namespace verp::identify {

/// Writes the numbers into the robot's file. A <verp:servo_type> of the file's own is changed in
/// place; for a shipped type, a type derived from it is added and its servos refer to that. All
/// other bytes stay. Returns the type's name in the file. Throws model::LoadError.
std::string write(const Result& result, const std::filesystem::path& robot_file,
                  const std::filesystem::path& file, const std::string& source);

}  // namespace verp::identify
