#pragma once
#include <filesystem>
#include <stdexcept>

namespace verp::files {

/// A file or folder could not be created; what() is one line with the remedy.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A new directory, removed with its contents: below TMPDIR, or below /tmp if TMPDIR is unusable.
/// Throws FileError if both fail.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace verp::files
