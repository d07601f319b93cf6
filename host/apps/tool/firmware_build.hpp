#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/apps/cli/progress.hpp"

namespace verp::tool {

struct FirmwareBuild {
  std::string board, target;
  std::filesystem::path tree;              ///< build tree; empty: the preset fw-<board>
  std::vector<std::string> settings = {};  ///< further CMake arguments at configure time
  std::filesystem::path log;               ///< receives all output after a failure
  std::filesystem::path lock = {};         ///< empty: the lock of ./verp
};

/// Runs one build command while it holds the lock. After a failure, `log` receives all output.
/// Throws ToolError with the compiler's messages.
void run_build(const std::vector<std::string>& command, const std::filesystem::path& lock,
               const std::filesystem::path& log, cli::Progress& progress);

/// Builds the target under the lock that ./verp also takes. Throws ToolError with the compiler's
/// messages.
void build_firmware(const FirmwareBuild& build, cli::Progress& progress);

}  // namespace verp::tool
