#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/boards/flash/plan.hpp"

namespace verp::flash {

struct FlashHooks {
  /// Called before each step and at each progress report of its tool; share 0..1 of the step.
  std::function<void(const Step&, double)> progress = [](const Step&, double) {};
  std::function<bool()> stop = [] { return false; };
};

/// Checks the port, then runs the steps until one fails. Throws FlashError; unless it says
/// otherwise, nothing was written.
void run(const Job& job, const std::vector<Step>& steps, const FlashHooks& hooks);

/// Folder for runs: $VERP_FLASH_DIR, or build/flash.
std::filesystem::path work_root();

/// Folder for one run: work_root()/BOARD. At first it holds only what an earlier failed run could
/// not write back.
class Workspace {
 public:
  /// Throws FlashError if the folder cannot be created or another run uses it.
  explicit Workspace(const std::string& board);
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Keeps the lock for the program that this process becomes by exec.
  void hand_over() const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace verp::flash
