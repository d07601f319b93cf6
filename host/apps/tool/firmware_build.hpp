#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/apps/cli/progress.hpp"

namespace verp::tool {

/// One target of a board's firmware.
struct FirmwareBuild {
  std::string board, target;
  std::filesystem::path tree;              ///< empty: that of the preset fw-<board>
  std::vector<std::string> settings = {};  ///< further words for CMake when it configures
  std::filesystem::path log;               ///< gets all that was said, if it fails
  std::filesystem::path lock = {};         ///< empty: ./verp's
};

/// One command of a build, alone as long as it holds the lock. `log` gets all that was said if it
/// fails. Throws ToolError with the compiler's words.
void run_build(const std::vector<std::string>& command, const std::filesystem::path& lock,
               const std::filesystem::path& log, cli::Progress& progress);

/// Builds it, one at a time with ./verp, whose lock this takes as well. Throws ToolError with the
/// compiler's words.
void build_firmware(const FirmwareBuild& build, cli::Progress& progress);

}  // namespace verp::tool
