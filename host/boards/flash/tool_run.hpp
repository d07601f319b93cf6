#pragma once
#include <functional>
#include <string>
#include <vector>

namespace verp::flash {

struct ToolRun {
  int status = 0;      ///< exit status; 128 + signal if killed
  std::string output;  ///< both streams, in order of arrival
  bool interrupted = false;
};

struct ToolHooks {
  /// Called with the last percentage in the tool's output, as a share.
  std::function<void(double)> share = [](double) {};
  /// Polled often; true ends the tool, at first gracefully.
  std::function<bool()> stop = [] { return false; };
};

/// Runs a command without a terminal, shielded from our Ctrl-C, and waits for its end. Throws
/// FlashError if the program is missing; `package` is its Debian package.
ToolRun run_tool(const std::vector<std::string>& command, const std::string& package,
                 const ToolHooks& hooks);

}  // namespace verp::flash
