#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/boards/flash/plan.hpp"

namespace verp::flash {

struct FlashHooks {
  /// Before each step and whenever its tool tells how far it is; share 0..1 of that step.
  std::function<void(const Step&, double)> progress = [](const Step&, double) {};
  std::function<bool()> stop = [] { return false; };
};

/// Looks at the port, then runs the steps one after the other, up to the first that fails. Throws
/// FlashError: then nothing was written, unless it says so.
void run(const Job& job, const std::vector<Step>& steps, const FlashHooks& hooks);

/// Where runs put their files: $VERP_FLASH_DIR, or build/flash.
std::filesystem::path work_root();

/// A folder for one run: in work_root() and of the board's name. Empty at
/// first, but for what an earlier run that failed could not write back.
class Workspace {
 public:
  /// Throws FlashError when it cannot be made, or another run is at work in it.
  explicit Workspace(const std::string& board);
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// The program that this process becomes has it next.
  void hand_over() const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace verp::flash
