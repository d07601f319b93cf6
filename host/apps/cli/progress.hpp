#pragma once
#include <chrono>
#include <string>

namespace verp::cli {

/// Silent under CI, if not wanted, and unless stderr is a terminal.
class Progress {
 public:
  explicit Progress(bool wanted);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// share 0..1; `label`: current work. Draws at most ten times a second.
  void show(double share, const std::string& label);
  void clear();

 private:
  bool active_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace verp::cli
