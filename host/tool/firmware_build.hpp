#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/tool/progress.hpp"

namespace verp::tool {

/// One target of a board's firmware.
struct FirmwareBuild {
  std::string board, target;
  std::filesystem::path tree;              ///< empty: that of the preset fw-<board>
  std::vector<std::string> settings = {};  ///< further words for CMake when it configures
  std::filesystem::path log;               ///< gets all that was said, if it fails
};

/// Builds it, one at a time with ./verp, whose lock this takes as well. Throws ToolError with the
/// compiler's words.
void build_firmware(const FirmwareBuild& build, Progress& progress);

}  // namespace verp::tool
