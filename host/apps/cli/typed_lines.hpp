#pragma once
#include <string>

namespace verp::cli {

/// What a person types beside a run that goes on: lines of the standard input. Never waits.
class TypedLines {
 public:
  /// The next whole line; empty: there is none. Of a terminal that another program has in its
  /// foreground nothing is taken.
  std::string next();

 private:
  std::string begun_;
  bool open_ = true;
};

}  // namespace verp::cli
