#pragma once
#include <filesystem>
#include <vector>

#include "host/study/tune/tune.hpp"

namespace verp::tune {

/// The robot's file with these numbers as <verp:tuning>. All other bytes stay. Throws
/// model::LoadError.
void write(const std::vector<Number>& numbers, const std::filesystem::path& robot_file,
           const std::filesystem::path& file);

}  // namespace verp::tune
