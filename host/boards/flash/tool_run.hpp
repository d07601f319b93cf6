#pragma once
#include <functional>
#include <string>
#include <vector>

namespace verp::flash {

struct ToolRun {
  int status = 0;      ///< 128 + signal if killed
  std::string output;  ///< both streams, in order
  bool interrupted = false;
};

struct ToolHooks {
  /// Called with the output's last percentage, as a share.
  std::function<void(double)> share = [](double) {};
  /// Polled; true ends the tool, at first gracefully.
  std::function<bool()> stop = [] { return false; };
};

/// Runs without a terminal, shielded from our Ctrl-C. Throws FlashError if missing; `package`:
/// Debian's.
ToolRun run_tool(const std::vector<std::string>& command, const std::string& package,
                 const ToolHooks& hooks);

}  // namespace verp::flash
