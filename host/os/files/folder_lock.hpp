#pragma once
#include <filesystem>

namespace verp::files {

/// Locks a folder against other programs; the constructor waits. Without file locks it does
/// nothing: files of two writers may then mix, but each is complete.
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
