#pragma once
#include <filesystem>

namespace verp::files {

/// While it lives, no other program holds the lock of this folder; waits for its turn. Where the
/// file system has no locks it holds nothing: then files of two writers may stand side by side,
/// each whole.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace verp::files
