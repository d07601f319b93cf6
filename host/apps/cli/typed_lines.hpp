#pragma once
#include <string>

namespace verp::cli {

/// Lines that a person types during a run. Never waits.
class TypedLines {
 public:
  /// The next complete line, or empty; reads nothing while another program is in the foreground.
  std::string next();

 private:
  std::string begun_;
  bool open_ = true;
};

}  // namespace verp::cli
