#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/boards/flash/plan.hpp"

namespace verp::flash {

struct FlashHooks {
  /// Called before each step and at its progress; share 0..1.
  std::function<void(const Step&, double)> progress = [](const Step&, double) {};
  std::function<bool()> stop = [] { return false; };
};

/// Runs the steps until one fails. Throws FlashError; unless it says otherwise, nothing was
/// written.
void run(const Job& job, const std::vector<Step>& steps, const FlashHooks& hooks);

/// $VERP_FLASH_DIR, or build/flash.
std::filesystem::path work_root();

/// One run's folder: work_root()/BOARD; at first it holds only contents that a failed run could not
/// write back.
class Workspace {
 public:
  /// Throws FlashError if it cannot be created or is in use.
  explicit Workspace(const std::string& board);
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Hands the lock to the program that this process becomes.
  void hand_over() const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace verp::flash
