#pragma once
#include <functional>
#include <string>
#include <vector>

namespace verp::flash {

struct ToolRun {
  int status = 0;      ///< exit status; 128 + signal if it was killed
  std::string output;  ///< both streams, as they came
  bool interrupted = false;
};

struct ToolHooks {
  /// The last percentage in what the tool printed, as a share.
  std::function<void(double)> share = [](double) {};
  /// Looked at often; true ends the tool, in its own way first.
  std::function<bool()> stop = [] { return false; };
};

/// Runs a command without a terminal and without our Ctrl-C, and waits for its end. Throws
/// FlashError when there is no such program; `package` is the Debian package that has it.
ToolRun run_tool(const std::vector<std::string>& command, const std::string& package,
                 const ToolHooks& hooks);

}  // namespace verp::flash
