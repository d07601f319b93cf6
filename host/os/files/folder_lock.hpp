#pragma once
#include <filesystem>

namespace verp::files {

/// Lock of a folder against other programs while this object lives; the constructor waits for it.
/// On a file system without locks it does nothing. Files of two writers may then be mixed in the
/// folder, but each file is complete.
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
