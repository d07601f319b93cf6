#pragma once
#include <optional>
#include <string>

namespace verp::cli {

/// What a person types, or a script writes: standard input, line by line.
class Answers {
 public:
  /// The next line without its end; nothing when the input has ended or somebody interrupts.
  std::optional<std::string> line();
  /// Asks on standard error first.
  std::optional<std::string> line(const std::string& question);

 private:
  std::string read_;  ///< beyond the line given last
  bool ended_ = false;
};

}  // namespace verp::cli
