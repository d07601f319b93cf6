#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/apps/cli/progress.hpp"

namespace verp::tool {

struct FirmwareBuild {
  std::string board, target;
  std::filesystem::path tree;              ///< empty: the preset fw-<board>
  std::vector<std::string> settings = {};  ///< further CMake settings
  std::filesystem::path log;               ///< all output of a failed build
  std::filesystem::path lock = {};         ///< empty: the lock of ./verp
};

/// One build command under the lock. Throws ToolError with the compiler's messages.
void run_build(const std::vector<std::string>& command, const std::filesystem::path& lock,
               const std::filesystem::path& log, cli::Progress& progress);

/// Builds under the lock that ./verp also takes.
void build_firmware(const FirmwareBuild& build, cli::Progress& progress);

}  // namespace verp::tool
