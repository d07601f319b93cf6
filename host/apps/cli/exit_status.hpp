#pragma once
#include <stdexcept>
#include <string>

namespace verp::cli {

enum ExitStatus : int {
  kGood = 0,
  kRunFailed = 1,  ///< fell, diverged, interrupted
  kBadInput = 2,   ///< usage or a file
  kNoDevice = 3,   ///< device or link
};

/// A failure that the user can act on. The line gives problem, place and remedy.
class ToolError : public std::runtime_error {
 public:
  ToolError(ExitStatus status, const std::string& line)
      : std::runtime_error(line), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

}  // namespace verp::cli
