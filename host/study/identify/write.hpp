#pragma once
#include <filesystem>
#include <string>

#include "host/study/identify/identify.hpp"

namespace verp::identify {

/// Changes the file's own <verp:servo_type>; for a shipped type it adds a derived one and lets the
/// servos refer to that. All other bytes stay. Returns the type's name. Throws model::LoadError.
std::string write(const Result& result, const std::filesystem::path& robot_file,
                  const std::filesystem::path& file, const std::string& source);

}  // namespace verp::identify
