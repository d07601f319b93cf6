#pragma once
#include <string>

namespace verp::cli {

/// Typed during a run; never waits.
class TypedLines {
 public:
  /// The next complete line, or empty; reads nothing while another program is in the foreground.
  std::string next();

 private:
  std::string begun_;
  bool open_ = true;
};

}  // namespace verp::cli
