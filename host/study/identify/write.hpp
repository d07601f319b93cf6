#pragma once
#include <filesystem>
#include <string>

#include "host/study/identify/identify.hpp"

namespace verp::identify {

/// Writes the numbers into the robot's file: its own <verp:servo_type> gets them; of a shipped type
/// one is added that is like it, and its servos are of that one. All else stays, byte for byte.
/// Returns the type's name there. Throws model::LoadError.
std::string write(const Result& result, const std::filesystem::path& robot_file,
                  const std::filesystem::path& file, const std::string& source);

}  // namespace verp::identify
