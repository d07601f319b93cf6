#pragma once
#include <filesystem>
#include <vector>

#include "host/study/tune/tune.hpp"

namespace verp::tune {

/// A copy of the robot's file with these numbers as its <verp:tuning>. All else stays, byte for
/// byte. Throws model::LoadError.
void write(const std::vector<Number>& numbers, const std::filesystem::path& robot_file,
           const std::filesystem::path& file);

}  // namespace verp::tune
