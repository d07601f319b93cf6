#pragma once
#include <optional>
#include <string>

namespace verp::cli {

/// Standard input, from a person or a script.
class Answers {
 public:
  /// The next line without its line break; nullopt: end of input, or interrupted.
  std::optional<std::string> line();
  /// Prints the question on standard error.
  std::optional<std::string> line(const std::string& question);

 private:
  std::string read_;  ///< bytes after the last returned line
  bool ended_ = false;
};

}  // namespace verp::cli
